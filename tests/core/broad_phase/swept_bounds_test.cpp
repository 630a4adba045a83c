#include "plumbline/core/broad_phase/swept_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "scattered_boxes.hpp"

namespace plumbline {
namespace {

BodyState state_at(const Motion& m, double t) {
  BodyState s = m.start;
  s.p_WB += t * m.start.v_WB + 0.5 * t * t * m.a_W;
  s.q_WB = rotation_by(t * m.start.w_WB) * m.start.q_WB;
  return s;
}

Motion random_motion(Dice& dice, double spin) {
  Motion m;
  m.start = dice.state(5);
  m.start.v_WB = dice.vector(3);
  m.start.w_WB = spin * dice.direction();
  m.a_W = dice.vector(10);
  return m;
}

// Random points of the body at random times of the step; spins up to more than a whole turn.
TEST(SweptBounds, HoldTheBodyAllTheWay) {
  Dice dice(1);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 size(dice.in(0.1, 3), dice.in(0.1, 3), dice.in(0.1, 3));
    const double duration = dice.in(0.01, 1), radius = dice.in(0.1, 2);
    const Motion m = random_motion(dice, dice.in(0, 8));
    const Aabb box = swept_box(Box{size}, m, duration), ball = swept_box(Sphere{radius}, m, duration);
    const BoundingSphere around_box = swept_sphere(Box{size}, m, duration);
    const BoundingSphere around_ball = swept_sphere(Sphere{radius}, m, duration);
    for (int i = 0; i < 60; ++i) {
      const BodyState s = state_at(m, dice.in(0, duration));
      const Vec3 corner = s.p_WB + s.q_WB * box_corner(size, static_cast<int>(dice.below(8)));
      ASSERT_TRUE(contains(box, corner)) << k;
      ASSERT_TRUE(contains(around_box, corner)) << k;
      const Vec3 surface = s.p_WB + radius * dice.direction();
      ASSERT_TRUE(contains(ball, surface)) << k;
      ASSERT_TRUE(contains(around_ball, surface)) << k;
    }
  }
}

// Against the box of 1000 instants. Without spin it is the swept box; with a spin of h = 0.2 rad a corner's arc bulges
// by (1 - cos 0.1) < 0.0051 of its arm, and the end that is left behind adds at most h arm.
TEST(SweptBounds, AreTightForSmallTurns) {
  Dice dice(2);
  for (int k = 0; k < 100; ++k) {
    const Vec3 size(dice.in(0.1, 3), dice.in(0.1, 3), dice.in(0.1, 3));
    const double spin = k % 2 == 0 ? 0 : 0.2, duration = 1;
    const Motion m = random_motion(dice, spin);
    Aabb seen = bounding_box(Box{size}, m.start);
    for (int i = 1; i <= 1000; ++i) seen = merged(seen, bounding_box(Box{size}, state_at(m, 1e-3 * i)));
    const Aabb box = swept_box(Box{size}, m, duration);
    const double arm = 0.5 * size.norm();
    // Within half of one of the 1000 intervals the turning point of the parabola lies |a| dt^2 / 8 beyond.
    const double allowed = spin * arm + 0.0051 * arm + m.a_W.cwiseAbs().maxCoeff() * 1e-6 / 8 + 1e-13;
    EXPECT_LE((seen.min - box.min).maxCoeff(), allowed) << k;
    EXPECT_LE((box.max - seen.max).maxCoeff(), allowed) << k;
  }
}

TEST(SweptBounds, FollowAThrownBallToItsTop) {
  Motion m;  // 10 m/s upwards under 10 m/s^2: the top is 5 m up after 1 s, within a step of 1.5 s that ends at 3.75 m
  m.start.v_WB = {2, 0, 10};
  m.a_W = {0, 0, -10};
  const Aabb box = swept_box(Sphere{0.5}, m, 1.5);
  EXPECT_NEAR(box.max.z(), 5.5, 1e-13);
  EXPECT_NEAR(box.min.z(), -0.5, 1e-13);
  EXPECT_NEAR(box.max.x(), 3.5, 1e-13);
}

TEST(SweptBounds, OfABoxThatTurnsHalfwayAreItsSphere) {
  Motion m;
  m.start.w_WB = {0, 0, std::numbers::pi};
  const Aabb box = swept_box(Box{Vec3(2, 3, 6)}, m, 1);
  EXPECT_NEAR(box.max.x(), 3.5, 1e-13);
  EXPECT_NEAR(box.min.z(), -3.5, 1e-13);
}

TEST(SweptBounds, OfAHalfSpaceAreWhatTheyWere) {
  Motion m;
  m.start.p_WB = {0, 0, 2};
  EXPECT_EQ(swept_box(HalfSpace{Vec3::UnitZ()}, m, 1).max.z(), 2);
  EXPECT_EQ(swept_sphere(HalfSpace{Vec3::UnitZ()}, m, 1).radius, std::numeric_limits<double>::infinity());
}

TEST(SweptBounds, NeedAFiniteMotionAndDuration) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Motion m;
  EXPECT_THROW(swept_box(Sphere{1}, m, -1), std::invalid_argument);
  EXPECT_THROW(swept_box(Sphere{1}, m, nan), std::invalid_argument);
  m.start.w_WB.x() = nan;
  EXPECT_THROW(swept_box(Box{Vec3::Ones()}, m, 1), std::invalid_argument);
  EXPECT_THROW(swept_sphere(Box{Vec3::Ones()}, m, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
