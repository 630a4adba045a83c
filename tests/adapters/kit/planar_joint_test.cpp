// A planar engine that puts these joints where it is told must find them where the scenario has them.
#include "plumbline/adapters/planar_joint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plumbline/adapters/planar_frame.hpp"

namespace plumbline {
namespace {

// A few roundings of numbers of the size of 1.
constexpr double kRounding = 1e-15;

Body body_at(const Vec3& p_WB, const Quat& q_WB, Shape shape) {
  Body body;
  body.shape = shape;
  body.mass = 1;
  body.inertia = Vec3(1, 1, 1);
  body.initial.p_WB = p_WB;
  body.initial.q_WB = q_WB;
  return body;
}

Scenario two_bodies(JointKind kind, const Vec3& anchor_W, const Vec3& axis_W) {
  Scenario s;
  s.bodies = {body_at(Vec3(1, 0, 2), rotation_by(Vec3(0, 0.7, 0)), Box{Vec3(1, 1, 1)}),
              // A ball may have any attitude: only its turn about y is known to the plane.
              body_at(Vec3(2, 0, 1), rotation_by(Vec3(0.3, -1.1, 0.5)), Sphere{0.5})};
  s.joints = {joint_at(kind, 0, 1, {s.bodies[0].initial, s.bodies[1].initial}, anchor_W, axis_W)};
  return s;
}

// A vector of a body's planar axes, turned as a planar engine turns it.
Vec3 turned(const BodyState& state, const PlanarVector& v) {
  const double angle = in_plane(state).angle;
  return {std::cos(angle) * v.x - std::sin(angle) * v.z, 0, std::sin(angle) * v.x + std::cos(angle) * v.z};
}

TEST(PlanarFrame, TurnsXTowardsZ) {
  BodyState state;
  state.q_WB = rotation_by(Vec3(0, -0.5, 0));  // about +y it would be z towards x
  state.w_WB = Vec3(0, -2, 0);
  EXPECT_NEAR(in_plane(state).angle, 0.5, kRounding);
  EXPECT_EQ(in_plane(state).w, 2);
  EXPECT_EQ(planar_torque(Vec3(0, -3, 0)), 3);
  EXPECT_FALSE(std::signbit(planar_torque(Vec3::Zero())));
  EXPECT_LT(geodesic_angle(in_space(in_plane(state)).q_WB, state.q_WB), 4 * kRounding);
  EXPECT_EQ(in_space(in_plane(state)).w_WB, state.w_WB);
}

TEST(PlanarJoint, AnchorsAndAxisStandWhereTheyAreStated) {
  const Vec3 anchor_W(1.4, 0, 1.7), axis_W = Vec3(0.6, 0, -0.8);
  const Scenario s = two_bodies(JointKind::kSlider, anchor_W, axis_W);
  const BodyState &a = s.bodies[0].initial, &b = s.bodies[1].initial;
  const PlanarJoint joint = planar_joint(s, s.joints[0]);
  EXPECT_LT((a.p_WB + turned(a, joint.on_a) - anchor_W).norm(), 4 * kRounding);
  EXPECT_LT((b.p_WB + turned(b, joint.on_b) - anchor_W).norm(), 4 * kRounding);
  EXPECT_LT((turned(a, joint.axis) - axis_W).norm(), 4 * kRounding);
  EXPECT_EQ(joint.turn, in_plane(b).angle - in_plane(a).angle);
}

TEST(PlanarJoint, OfTheWorldIsAnchoredInW) {
  Scenario s = two_bodies(JointKind::kBall, Vec3(1, 0, 1), Vec3::UnitY());
  s.joints = {joint_at(JointKind::kBall, kWorld, 0, {s.bodies[0].initial}, Vec3(3, 0, -4))};
  const PlanarJoint joint = planar_joint(s, s.joints[0]);
  EXPECT_EQ(joint.on_a.x, 3);
  EXPECT_EQ(joint.on_a.z, -4);
  EXPECT_EQ(joint.turn, in_plane(s.bodies[0].initial).angle);
}

}  // namespace
}  // namespace plumbline
