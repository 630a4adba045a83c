#include "extended_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline::extended {
namespace {

constexpr Real kRounding = std::numeric_limits<Real>::epsilon();

const Placed kStill;

auto place_of(const Slice& x, std::size_t body) { return x.segment<3>(static_cast<Eigen::Index>(7 * body)); }
auto attitude_of(const Slice& x, std::size_t body) { return x.segment<4>(static_cast<Eigen::Index>(7 * body) + 3); }
auto velocity_of(const Slice& u, std::size_t body) { return u.segment<3>(static_cast<Eigen::Index>(6 * body)); }
auto spin_of(const Slice& u, std::size_t body) { return u.segment<3>(static_cast<Eigen::Index>(6 * body) + 3); }

Quaternion quaternion(const Eigen::Matrix<Real, 4, 1>& q) { return Quaternion(q[0], q[1], q[2], q[3]).normalized(); }

// q (0, w), w in body axes
Eigen::Matrix<Real, 4, 1> times(const Eigen::Matrix<Real, 4, 1>& q, const Vector3& w) {
  Eigen::Matrix<Real, 4, 1> product;
  product[0] = -q[1] * w[0] - q[2] * w[1] - q[3] * w[2];
  product[1] = q[0] * w[0] + q[2] * w[2] - q[3] * w[1];
  product[2] = q[0] * w[1] + q[3] * w[0] - q[1] * w[2];
  product[3] = q[0] * w[2] + q[1] * w[1] - q[2] * w[0];
  return product;
}

std::vector<std::size_t> moving_bodies(const Scenario& scenario) {
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    if (!scenario.bodies[i].fixed) bodies.push_back(i);
  }
  return bodies;
}

const Scenario& smooth(const Scenario& scenario) {
  if (scenario.contact) throw std::invalid_argument("its motion is not smooth: remove [contact]");
  for (const Joint& joint : scenario.joints) {
    if (joint.range) throw std::invalid_argument("its motion is not smooth: '" + joint.name + "' has a range");
  }
  return scenario;
}

std::vector<Joint> renumbered(std::vector<Joint> joints, const std::vector<std::size_t>& index) {
  for (Joint& joint : joints) {
    if (joint.a != kWorld) joint.a = index[joint.a];
    joint.b = index[joint.b];
  }
  return joints;
}

std::vector<std::size_t> inverse(const std::vector<std::size_t>& bodies, std::size_t size) {
  std::vector<std::size_t> index(size, kWorld);
  for (std::size_t k = 0; k < bodies.size(); ++k) index[bodies[k]] = k;
  return index;
}

}  // namespace

Motion::Motion(const Scenario& scenario)
    : scenario_(smooth(scenario)),
      bodies_(moving_bodies(scenario)),
      index_(inverse(bodies_, scenario.bodies.size())),
      placed_(bodies_.size()),
      force_(bodies_.size()),
      torque_(bodies_.size()),
      rounded_(scenario.bodies.size()),
      joints_(renumbered(scenario.joints, index_)),
      free_(6 * moving()),
      step_(6 * moving()) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = scenario_.bodies[bodies_[i]];
    inertia_.push_back(body.inertia.cast<Real>());
    placed_[i].inverse_mass = 1 / static_cast<Real>(body.mass);
    placed_[i].inverse_inertia = inertia_[i].cwiseInverse();
  }
}

void Motion::place(const Slice& x, const Slice& u) {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    Placed& body = placed_[i];
    body.p = place_of(x, i);
    body.R = quaternion(attitude_of(x, i)).toRotationMatrix();
    body.v = velocity_of(u, i);
    body.w_B = spin_of(u, i);
    body.w_W = body.R * body.w_B;
  }
}

void Motion::start(Column& x, Column& u) {
  x.resize(7 * moving());
  u.resize(6 * moving());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyState& s = scenario_.bodies[bodies_[i]].initial;
    const Quaternion q = Quaternion(s.q_WB.cast<Real>()).normalized();
    x.segment<7>(static_cast<Eigen::Index>(7 * i)) << s.p_WB.cast<Real>(), q.w(), q.vec();
    u.segment<6>(static_cast<Eigen::Index>(6 * i)) << s.v_WB.cast<Real>(), q.conjugate() * s.w_WB.cast<Real>();
  }
  project(x, u);
}

void Motion::rates(const Slice& x, const Slice& u, Eigen::Ref<Column> dx) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(7 * i);
    dx.segment<3>(at) = velocity_of(u, i);
    dx.segment<4>(at + 3) = times(attitude_of(x, i), spin_of(u, i)) / 2;
  }
}

void Motion::accelerations(Real t, const Slice& x, const Slice& u, Eigen::Ref<Column> du) {
  place(x, u);
  if (evaluates_in_double()) read(x, u, rounded_);
  apply_forces(t);
  const Vector3 gravity = scenario_.gravity.cast<Real>();
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const Placed& body = placed_[i];
    const Vector3 momentum = inertia_[i].cwiseProduct(body.w_B);
    free_.segment<3>(static_cast<Eigen::Index>(6 * i)) = gravity + body.inverse_mass * force_[i];
    free_.segment<3>(static_cast<Eigen::Index>(6 * i) + 3) =
        body.inverse_inertia.cwiseProduct(torque_[i] - body.w_B.cross(momentum));
  }
  joints_.accelerate(placed_, free_);
  du = free_;
}

void Motion::apply_forces(Real t) {
  std::fill(force_.begin(), force_.end(), Vector3::Zero());
  std::fill(torque_.begin(), torque_.end(), Vector3::Zero());
  const auto time = static_cast<double>(t);
  for (const ForceLaw& law : scenario_.forces) {
    const std::size_t i = index_[law.body];
    if (i == kWorld) continue;
    const Wrench wrench = law.evaluate(time, rounded_[law.body]);
    force_[i] += wrench.f_W.cast<Real>();
    torque_[i] += placed_[i].R.transpose() * wrench.tau_W.cast<Real>();
  }
  for (const Spring& spring : scenario_.springs) apply(spring);
  const auto end = [&](std::size_t body) -> const Placed& { return body == kWorld ? kStill : placed_[index_[body]]; };
  for (const JointSpring& spring : scenario_.joint_springs) {
    const Joint& joint = scenario_.joints[spring.joint];
    const Condition on = joints_.coordinate(spring.joint, placed_);
    const Real rate = JointSystem::rate(on, end(joint.a), end(joint.b));
    const Real stretch = on.value - static_cast<Real>(spring.rest);
    apply(spring.joint, -(static_cast<Real>(spring.stiffness) * stretch + static_cast<Real>(spring.damping) * rate),
          on);
  }
  for (const JointDrive& drive : scenario_.drives) {
    const Joint& joint = scenario_.joints[drive.joint];
    const Condition on = joints_.coordinate(drive.joint, placed_);
    const Real rate = JointSystem::rate(on, end(joint.a), end(joint.b));
    apply(drive.joint, drive.effort(time, static_cast<double>(on.value), static_cast<double>(rate)), on);
  }
}

void Motion::apply(std::size_t joint, Real effort, const Condition& on) {
  const auto act = [&](std::size_t body, Real sign, const Vector3& torque) {
    if (body == kWorld) return;
    force_[index_[body]] += sign * effort * on.force;
    torque_[index_[body]] += effort * torque;
  };
  act(scenario_.joints[joint].b, 1, on.torque_B);
  act(scenario_.joints[joint].a, -1, on.torque_A);
}

void Motion::apply(const Spring& spring) {
  const auto point = [&](std::size_t body, const Vec3& on_body) {
    const Placed& placed = body == kWorld ? kStill : placed_[index_[body]];
    const Vector3 arm = placed.R * on_body.cast<Real>();
    return std::pair<Vector3, Vector3>(placed.p + arm, placed.v + placed.w_W.cross(arm));
  };
  const auto [p_A, v_A] = point(spring.a, spring.on_a);
  const auto [p_B, v_B] = point(spring.b, spring.on_b);
  const Vector3 way = p_B - p_A;
  const Real length = way.norm();
  // The pull along the way, over its length; l0 = 0 needs no direction.
  Vector3 on_B = -static_cast<Real>(spring.stiffness) * way;
  if (length != 0) {
    const Vector3 n = way / length;
    on_B += (static_cast<Real>(spring.stiffness) * static_cast<Real>(spring.length) -
             static_cast<Real>(spring.damping) * n.dot(v_B - v_A)) *
            n;
  }
  const auto act = [&](std::size_t body, const Vec3& on_body, const Vector3& f) {
    if (body == kWorld) return;
    const std::size_t i = index_[body];
    force_[i] += f;
    torque_[i] += Vector3(on_body.cast<Real>()).cross(placed_[i].R.transpose() * f);
  };
  act(spring.b, spring.on_b, on_B);
  act(spring.a, spring.on_a, -on_B);
}

void Motion::displace(Column& x, const Column& displacement) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(7 * i);
    x.segment<3>(at) += velocity_of(displacement, i);
    const Eigen::Matrix<Real, 4, 1> q = attitude_of(x, i);
    x.segment<4>(at + 3) = (q + times(q, spin_of(displacement, i)) / 2).normalized();
  }
}

void Motion::project(Column& x, Column& u) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) x.segment<4>(static_cast<Eigen::Index>(7 * i) + 3).normalize();
  if (joints_.empty()) return;
  // Newton's method: done when a displacement is a rounding. Redundant joints whose frames disagree by the rounding of
  // the file never close completely, so that the displacements and not the gaps tell.
  constexpr int kMaxSweeps = 20;
  const Real length = static_cast<Real>(scenario_.scales.length);
  Real open = 0, moved = std::numeric_limits<Real>::infinity();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    place(x, u);
    step_.setZero();
    open = joints_.close_places(placed_, step_);
    displace(x, step_);
    const Real before = moved;
    moved = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      moved = std::max({moved, velocity_of(step_, i).norm() / length, spin_of(step_, i).norm()});
    }
    if (moved <= 4 * kRounding || (moved < 1e-15L && moved > before / 2)) break;
  }
  if (!(open <= 1e-9L * std::max<Real>(1, length) && step_.allFinite())) {
    throw std::runtime_error("the joints come apart and cannot be closed; is the motion singular or not finite?");
  }
  // Twice: the second removes what the first left to rounding.
  for (int sweep = 0; sweep < 2; ++sweep) {
    place(x, u);
    step_.setZero();
    joints_.close_velocities(placed_, step_);
    u += step_;
  }
}

Real Motion::distance(const Slice& x, const Slice& other) const {
  Real largest = 0;
  const auto take = [&](Real value) {
    if (value > largest || std::isnan(value)) largest = value;
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    take((place_of(x, i) - place_of(other, i)).norm() / static_cast<Real>(scenario_.scales.length));
    const Quaternion turn = quaternion(attitude_of(x, i)).conjugate() * quaternion(attitude_of(other, i));
    take(2 * std::atan2(turn.vec().norm(), std::abs(turn.w())));
  }
  return largest;
}

void Motion::read(const Slice& x, const Slice& u, std::span<BodyState> states) const {
  for (std::size_t b = 0; b < states.size(); ++b) {
    const std::size_t i = index_[b];
    if (i == kWorld) {
      states[b] = scenario_.bodies[b].initial;
      continue;
    }
    const Quaternion q = quaternion(attitude_of(x, i));
    states[b].p_WB = place_of(x, i).cast<double>();
    states[b].q_WB = q.cast<double>();
    states[b].v_WB = velocity_of(u, i).cast<double>();
    states[b].w_WB = (q * Vector3(spin_of(u, i))).cast<double>();
  }
}

}  // namespace plumbline::extended
