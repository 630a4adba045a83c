#include "plumbline/core/joints/rigid_doll.hpp"

#include <stdexcept>

#include "plumbline/core/body.hpp"

namespace plumbline {
namespace {

constexpr double kBend = 2.4, kOverstretch = 0.05;  // [rad]

struct Segment {
  double share;  // of the whole mass
  Vec3 size;     // [m]
  Vec3 centre;   // when standing [m]
};

void add(RigidDoll& doll, const Segment& segment, double mass) {
  const double m = segment.share * mass;
  doll.body.bodies.push_back({m, solid_inertia(Box{segment.size}, m).asDiagonal()});
  doll.states.push_back({segment.centre, Quat::Identity(), Vec3::Zero(), Vec3::Zero()});
}

// Ties the last segment to the one before it, or to the trunk.
void tie(RigidDoll& doll, JointKind kind, std::size_t to, const Vec3& at, const Vec3& axis, const JointRange& range) {
  doll.body.joints.push_back(joint_at(kind, to, doll.states.size() - 1, doll.states, at, axis));
  doll.body.joints.back().range = range;
}

void add_side(RigidDoll& doll, double mass, double side) {
  const Vec3 down = -Vec3::UnitZ(), across = Vec3::UnitY();  // a turn about +y swings what hangs backwards
  const Vec3 shoulder(0, 0.22 * side, 0.25), elbow(0, 0.22 * side, -0.05);
  add(doll, {0.0271, {0.08, 0.08, 0.30}, (shoulder + elbow) / 2}, mass);
  tie(doll, JointKind::kBall, kTrunk, shoulder, down, {0, 2.5});
  add(doll, {0.0223, {0.07, 0.07, 0.42}, elbow + Vec3(0, 0, -0.21)}, mass);
  tie(doll, JointKind::kHinge, doll.states.size() - 2, elbow, across, {-kBend, kOverstretch});

  const Vec3 hip(0, 0.10 * side, -0.30), knee(0, 0.10 * side, -0.72);
  add(doll, {0.1416, {0.14, 0.14, 0.42}, (hip + knee) / 2}, mass);
  tie(doll, JointKind::kBall, kTrunk, hip, down, {0, 1.2});
  add(doll, {0.0570, {0.11, 0.11, 0.45}, knee + Vec3(0, 0, -0.225)}, mass);
  tie(doll, JointKind::kHinge, doll.states.size() - 2, knee, across, {-kOverstretch, kBend});
}

}  // namespace

RigidDoll make_rigid_doll(double mass) {
  if (!(mass > 0)) throw std::invalid_argument("a rag doll needs a mass > 0");
  RigidDoll doll;
  add(doll, {0.4346, {0.20, 0.30, 0.60}, Vec3::Zero()}, mass);
  add(doll, {0.0694, {0.16, 0.16, 0.24}, {0, 0, 0.42}}, mass);
  tie(doll, JointKind::kBall, kTrunk, {0, 0, 0.30}, Vec3::UnitZ(), {0, 0.8});
  add_side(doll, mass, 1);
  add_side(doll, mass, -1);
  return doll;
}

}  // namespace plumbline
