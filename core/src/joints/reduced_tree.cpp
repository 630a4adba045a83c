#include "plumbline/core/joints/reduced_tree.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

Vec6 pair(const Vec3& angular, const Vec3& linear) {
  Vec6 result;
  result << angular, linear;
  return result;
}

// V x S: how a motion S that is carried along by V changes.
Vec6 motion_cross(const Vec6& V, const Vec6& S) {
  const Vec3 w = V.head<3>(), v = V.tail<3>();
  return pair(w.cross(S.head<3>()), w.cross(S.tail<3>()) + v.cross(S.head<3>()));
}

// V x* F: the same for a momentum or force.
Vec6 force_cross(const Vec6& V, const Vec6& F) {
  const Vec3 w = V.head<3>(), v = V.tail<3>();
  return pair(w.cross(F.head<3>()) + v.cross(F.tail<3>()), w.cross(F.tail<3>()));
}

[[noreturn]] void refuse(std::size_t joint, const char* why) {
  throw std::invalid_argument("reduced tree, joint " + std::to_string(joint) + ": " + why);
}

}  // namespace

ReducedTree::ReducedTree(const ArticulatedBody& body) : body_(body) {
  if (body.joints.size() != body.bodies.size()) {
    throw std::invalid_argument("a reduced tree has one joint for each body: close loops in maximal coordinates");
  }
  for (std::size_t k = 0; k < body.joints.size(); ++k) {
    const Joint& joint = body.joints[k];
    if (joint.b != k) refuse(k, "it must carry body k: sort the joints");
    if (joint.a != kWorld && joint.a >= k) refuse(k, "its parent must come before it: sort the bodies");
    if (joint.kind == JointKind::kDistance)
      refuse(k, "a distance joint is no tree: its rod has a ball joint at either end");
    if (joint.kind == JointKind::kBall) refuse(k, "a ball joint is three hinges with bodies of mass 0 between them");
    if (!(body.bodies[k].mass >= 0)) refuse(k, "the mass of its body must be >= 0");
    coordinate_.push_back(joint.kind == JointKind::kFixed ? -1 : freedoms_++);
  }
}

// Outwards: where the bodies are, how they move and accelerate.
std::vector<ReducedTree::Placed> ReducedTree::place(const Vector& q, const Vector& qd, const Vector& qdd,
                                                    const Vec3& base_acceleration) const {
  if (q.size() != freedoms_ || qd.size() != freedoms_ || qdd.size() != freedoms_) {
    throw std::invalid_argument("the tree has " + std::to_string(freedoms_) + " coordinates");
  }
  std::vector<Placed> all;
  for (std::size_t k = 0; k < body_.joints.size(); ++k) {
    const Joint& joint = body_.joints[k];
    const Placed world{Mat3::Identity(), Vec3::Zero(), Vec6::Zero(), Vec6::Zero(),
                       pair(Vec3::Zero(), base_acceleration)};
    const Placed& parent = joint.a == kWorld ? world : all[joint.a];
    const Mat3 E = parent.R * joint.on_a.attitude.toRotationMatrix();  // axes of the joint
    const Vec3 x = parent.p_W + parent.R * joint.on_a.anchor;
    const Vec3 z = E.col(2);
    const Eigen::Index at = coordinate_[k];

    Placed body{E, x, Vec6::Zero(), parent.V, parent.A};
    if (joint.kind == JointKind::kHinge) {
      body.R = E * Eigen::AngleAxisd(q[at], Vec3::UnitZ()).toRotationMatrix();
      body.S = pair(z, x.cross(z));  // a turn about the line through x moves the point at the origin by x cross z
    } else if (joint.kind == JointKind::kSlider) {
      body.p_W += q[at] * z;
      body.S = pair(Vec3::Zero(), z);
    }
    body.R = body.R * joint.on_b.attitude.toRotationMatrix().transpose();
    body.p_W -= body.R * joint.on_b.anchor;
    if (at >= 0) {
      body.V += body.S * qd[at];
      body.A += body.S * qdd[at] + motion_cross(body.V, body.S * qd[at]);
    }
    all.push_back(body);
  }
  return all;
}

// I_W + m (p.p - p p^T) about the origin, and the coupling of rotation and translation by m p.
Mat6 ReducedTree::inertia_at_origin(std::size_t body, const Placed& placed) const {
  const BodyInertia& part = body_.bodies[body];
  const Mat3 P = cross_matrix(placed.p_W);
  Mat6 I;
  I.topLeftCorner<3, 3>() = placed.R * part.inertia_B * placed.R.transpose() + part.mass * P * P.transpose();
  I.topRightCorner<3, 3>() = part.mass * P;
  I.bottomLeftCorner<3, 3>() = part.mass * P.transpose();
  I.bottomRightCorner<3, 3>() = part.mass * Mat3::Identity();
  return I;
}

Eigen::MatrixXd ReducedTree::mass_matrix(const Vector& q) const {
  const Vector still = Vector::Zero(freedoms_);
  const std::vector<Placed> placed = place(q, still, still, Vec3::Zero());
  std::vector<Mat6> composite;
  for (std::size_t k = 0; k < placed.size(); ++k) composite.push_back(inertia_at_origin(k, placed[k]));

  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(freedoms_, freedoms_);
  for (std::size_t k = placed.size(); k-- > 0;) {  // inwards: children are complete before their parents
    const std::size_t parent = body_.joints[k].a;
    if (parent != kWorld) composite[parent] += composite[k];
    if (coordinate_[k] < 0) continue;
    const Vec6 F = composite[k] * placed[k].S;
    for (std::size_t j = k; j != kWorld; j = body_.joints[j].a) {
      if (coordinate_[j] < 0) continue;
      const double entry = placed[j].S.dot(F);
      M(coordinate_[j], coordinate_[k]) = entry;
      M(coordinate_[k], coordinate_[j]) = entry;
    }
  }
  return M;
}

ReducedTree::Vector ReducedTree::inverse_dynamics(const Vector& q, const Vector& qd, const Vector& qdd) const {
  // Gravity acts on all bodies as if the world accelerated the other way.
  const std::vector<Placed> placed = place(q, qd, qdd, -body_.gravity_W);
  std::vector<Vec6> force;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const Mat6 I = inertia_at_origin(k, placed[k]);
    force.push_back(I * placed[k].A + force_cross(placed[k].V, I * placed[k].V));
  }
  Vector tau(freedoms_);
  for (std::size_t k = placed.size(); k-- > 0;) {
    if (coordinate_[k] >= 0) tau[coordinate_[k]] = placed[k].S.dot(force[k]);
    const std::size_t parent = body_.joints[k].a;
    if (parent != kWorld) force[parent] += force[k];
  }
  return tau;
}

ReducedTree::Vector ReducedTree::accelerations(const Vector& q, const Vector& qd, const Vector& tau) const {
  if (tau.size() != freedoms_) throw std::invalid_argument("one joint force per coordinate is needed");
  const Eigen::LLT<Eigen::MatrixXd> factor(mass_matrix(q));
  if (factor.info() != Eigen::Success) throw std::runtime_error("reduced tree: some joint moves no inertia");
  return factor.solve(tau - inverse_dynamics(q, qd, Vector::Zero(freedoms_)));
}

void ReducedTree::operator()(double, const Vector& y, Vector& dy) const {
  const Vector q = y.head(freedoms_), qd = y.tail(freedoms_);
  dy.resize(2 * freedoms_);
  dy << qd, accelerations(q, qd);
}

std::vector<BodyState> ReducedTree::states(const Vector& q, const Vector& qd) const {
  std::vector<BodyState> result;
  for (const Placed& body : place(q, qd, Vector::Zero(freedoms_), Vec3::Zero())) {
    const Vec3 w = body.V.head<3>();
    result.push_back({body.p_W, Quat(body.R).normalized(), body.V.tail<3>() + w.cross(body.p_W), w});
  }
  return result;
}

// The field gives the rate of the velocity seen at a fixed point; the centre of mass moves through it: + w x v.
std::vector<Acceleration> ReducedTree::body_accelerations(const Vector& q, const Vector& qd, const Vector& qdd) const {
  std::vector<Acceleration> result;
  for (const Placed& body : place(q, qd, qdd, Vec3::Zero())) {
    const Vec3 w = body.V.head<3>(), alpha = body.A.head<3>();
    const Vec3 v = body.V.tail<3>() + w.cross(body.p_W);
    result.push_back({body.A.tail<3>() + alpha.cross(body.p_W) + w.cross(v), alpha});
  }
  return result;
}

double ReducedTree::energy(const Vector& q, const Vector& qd) const { return mechanical_energy(body_, states(q, qd)); }

}  // namespace plumbline
