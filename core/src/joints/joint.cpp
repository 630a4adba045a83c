#include "plumbline/core/joints/joint.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace plumbline {
namespace {

[[noreturn]] void refuse(const char* what, std::size_t number, const char* why) {
  throw std::invalid_argument(std::string(what) + " " + std::to_string(number) + ": " + why);
}

bool usable(const JointFrame& frame) { return frame.anchor.allFinite() && std::abs(frame.attitude.norm() - 1) < 1e-9; }

void require_range(const Joint& joint, std::size_t k) {
  const double low = joint.range->low, high = joint.range->high;
  if (!(low < high)) refuse("joint", k, "a range needs low < high: use a fixed joint to hold one value");
  switch (joint.kind) {
    case JointKind::kHinge:
      if (!(low > -std::numbers::pi && high < std::numbers::pi)) {
        refuse("joint", k, "a hinge's range must lie within (-pi, pi): turn one of its frames");
      }
      break;
    case JointKind::kBall:
      if (!(low == 0 && high < std::numbers::pi)) {
        refuse("joint", k, "a ball joint's range is that of the angle between its axes: 0 <= angle <= high < pi");
      }
      break;
    case JointKind::kSlider:
      break;
    case JointKind::kFixed:
      refuse("joint", k, "a fixed joint has no coordinate: leave its range out");
    case JointKind::kDistance:
      refuse("joint", k, "a distance joint holds one length: leave its range out");
  }
}

// A frame given in W, in the axes of that body.
JointFrame seen_from(std::size_t body, const std::vector<BodyState>& states, const JointFrame& in_W) {
  if (body == kWorld) return in_W;
  const BodyState& s = states.at(body);
  const Quat q_BW = s.q_WB.conjugate();
  return {q_BW * (in_W.anchor - s.p_WB), (q_BW * in_W.attitude).normalized()};
}

Mat3 inertia_W(const BodyInertia& body, const Quat& q_WB) {
  const Mat3 R = q_WB.toRotationMatrix();
  return R * body.inertia_B * R.transpose();
}

}  // namespace

std::string_view joint_name(JointKind kind) {
  static constexpr std::string_view kNames[] = {"ball", "hinge", "slider", "fixed", "distance"};
  return kNames[static_cast<std::size_t>(kind)];
}

JointFrame frame_along(const Vec3& anchor, const Vec3& axis) {
  if (!(axis.norm() > 0)) throw std::invalid_argument("a joint's axis must have a length: give a direction");
  return {anchor, Quat(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis))};
}

Joint joint_at(JointKind kind, std::size_t a, std::size_t b, const std::vector<BodyState>& states, const Vec3& anchor_W,
               const Vec3& axis_W) {
  const JointFrame in_W = frame_along(anchor_W, axis_W);
  return {kind, a, b, seen_from(a, states, in_W), seen_from(b, states, in_W), std::nullopt, 0, {}};
}

Joint rod_between(std::size_t a, std::size_t b, const std::vector<BodyState>& states, const Vec3& end_a_W,
                  const Vec3& end_b_W) {
  const double length = (end_b_W - end_a_W).norm();
  if (!(length > 0)) throw std::invalid_argument("a distance joint needs two different points, its length is not > 0");
  return {JointKind::kDistance, a,      b, seen_from(a, states, {end_a_W}), seen_from(b, states, {end_b_W}),
          std::nullopt,         length, {}};
}

Joint reversed(const Joint& joint) {
  Joint other = joint;
  std::swap(other.a, other.b);
  std::swap(other.on_a, other.on_b);
  // The angle of a hinge from x_B to x_A about the common z, and the travel of A along it, count the other way.
  if (joint.range && joint.kind != JointKind::kBall) other.range = JointRange{-joint.range->high, -joint.range->low};
  return other;
}

void require_valid(const ArticulatedBody& body) {
  for (std::size_t i = 0; i < body.bodies.size(); ++i) {
    const BodyInertia& part = body.bodies[i];
    if (!(part.mass > 0 && std::isfinite(part.mass))) refuse("body", i, "the mass must be > 0");
    if (!part.inertia_B.allFinite() || Eigen::LLT<Mat3>(part.inertia_B).info() != Eigen::Success) {
      refuse("body", i, "every moment of inertia must be > 0; for point masses use reduced coordinates");
    }
  }
  for (std::size_t k = 0; k < body.joints.size(); ++k) {
    const Joint& joint = body.joints[k];
    if (joint.b >= body.bodies.size()) refuse("joint", k, "there is no body b; the world can only be a");
    if (joint.a != kWorld && joint.a >= body.bodies.size()) refuse("joint", k, "there is no body a");
    if (joint.a == joint.b) refuse("joint", k, "it ties a body to itself");
    if (!usable(joint.on_a) || !usable(joint.on_b)) refuse("joint", k, "frames need finite anchors, unit attitudes");
    if (joint.range) require_range(joint, k);
    if (joint.kind == JointKind::kDistance && !(joint.length > 0 && std::isfinite(joint.length))) {
      refuse("joint", k, "a distance joint needs a length > 0");
    }
  }
}

double mechanical_energy(const ArticulatedBody& body, const std::vector<BodyState>& states) {
  double sum = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    const double m = body.bodies[i].mass;
    sum += m * s.v_WB.squaredNorm() / 2 + s.w_WB.dot(inertia_W(body.bodies[i], s.q_WB) * s.w_WB) / 2 -
           m * body.gravity_W.dot(s.p_WB);
  }
  return sum;
}

Vec3 linear_momentum(const ArticulatedBody& body, const std::vector<BodyState>& states) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) sum += body.bodies[i].mass * states[i].v_WB;
  return sum;
}

Vec3 angular_momentum(const ArticulatedBody& body, const std::vector<BodyState>& states) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    sum += body.bodies[i].mass * s.p_WB.cross(s.v_WB) + inertia_W(body.bodies[i], s.q_WB) * s.w_WB;
  }
  return sum;
}

}  // namespace plumbline
