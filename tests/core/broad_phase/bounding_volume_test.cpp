#include "plumbline/core/broad_phase/bounding_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "plumbline/core/collision/time_of_impact.hpp"
#include "scattered_boxes.hpp"

namespace plumbline {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kEps = std::numeric_limits<double>::epsilon();

// A corner in W is a sum of four numbers of at most |p| + |s|, computed twice in different ways.
double rounding(const BodyState& state, double size) { return 16 * kEps * (state.p_WB.norm() + size); }

TEST(BoundingVolume, OfABoxHoldsItsPointsAndTouchesItsCorners) {
  Dice dice(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 size(dice.in(0.1, 3), dice.in(0.1, 3), dice.in(0.1, 3));
    const BodyState state = dice.state(10);
    const Aabb box = bounding_box(Box{size}, state);
    const BoundingSphere sphere = bounding_sphere(Box{size}, state);
    const double slack = rounding(state, size.norm());
    Aabb corners{Vec3::Constant(kInf), Vec3::Constant(-kInf)};
    double reach = 0;
    for (int c = 0; c < 8; ++c) {
      const Vec3 corner = state.p_WB + state.q_WB * box_corner(size, c);
      corners = merged(corners, {corner, corner});
      reach = std::max(reach, (corner - sphere.centre).norm());
    }
    EXPECT_LE((corners.min - box.min).cwiseAbs().maxCoeff(), slack);  // tight: it is the box of the corners
    EXPECT_LE((corners.max - box.max).cwiseAbs().maxCoeff(), slack);
    EXPECT_NEAR(sphere.radius, reach, slack);
    for (int i = 0; i < 10; ++i) {
      const Vec3 inside = state.p_WB + state.q_WB * dice.vector(0.5).cwiseProduct(size);
      EXPECT_TRUE(contains(grown(box, slack), inside));
      EXPECT_TRUE(contains(BoundingSphere{sphere.centre, sphere.radius + slack}, inside));
    }
  }
}

TEST(BoundingVolume, OfASphereIsTheSphereAndItsCube) {
  BodyState state;
  state.p_WB = {1, 2, 3};
  const Aabb box = bounding_box(Sphere{0.5}, state);
  EXPECT_EQ(box.min, Vec3(0.5, 1.5, 2.5));
  EXPECT_EQ(box.max, Vec3(1.5, 2.5, 3.5));
  EXPECT_EQ(bounding_sphere(Sphere{0.5}, state).radius, 0.5);
  EXPECT_EQ(bounding_sphere(Sphere{0.5}, state).centre, state.p_WB);
}

TEST(BoundingVolume, OfAHalfSpaceEndsAtItsPlaneOnlyAcrossAnAxis) {
  BodyState state;
  state.p_WB = {1, 2, 3};
  const Aabb floor = bounding_box(HalfSpace{Vec3::UnitZ()}, state);
  EXPECT_EQ(floor.min, Vec3::Constant(-kInf));
  EXPECT_EQ(floor.max, Vec3(kInf, kInf, 3));
  const Aabb wall = bounding_box(HalfSpace{-Vec3::UnitX()}, state);
  EXPECT_EQ(wall.min, Vec3(1, -kInf, -kInf));
  EXPECT_EQ(wall.max, Vec3::Constant(kInf));
  const Aabb slope = bounding_box(HalfSpace{Vec3(0.6, 0, 0.8)}, state);
  EXPECT_EQ(slope.min, Vec3::Constant(-kInf));
  EXPECT_EQ(slope.max, Vec3::Constant(kInf));
  EXPECT_EQ(bounding_sphere(HalfSpace{Vec3::UnitZ()}, state).radius, kInf);
}

// The lowest of the eight corners against the formula that looks at one.
TEST(BoundingVolume, ReachesIntoAHalfSpaceWithItsLowestCorner) {
  Dice dice(2);
  int inside = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3 at = dice.vector(2), size(dice.in(0, 2), dice.in(0, 2), dice.in(0, 2)), p = dice.vector(2);
    const HalfSpace half_space{dice.direction()};
    double lowest = kInf;
    for (int c = 0; c < 8; ++c) {
      lowest = std::min(lowest, half_space.normal.dot(at + 0.5 * size + box_corner(size, c) - p));
    }
    if (std::abs(lowest) < 1e-14) continue;  // closer than rounding can tell
    const bool reaches = overlap({at, at + size}, half_space, p);
    EXPECT_EQ(reaches, lowest < 0);
    inside += reaches ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(inside, 4000);
}

// Each answer against points of both volumes: a common point proves overlap, a separating direction proves a gap.
TEST(BoundingVolume, OverlapsIfAndOnlyIfPointsAreShared) {
  Dice dice(3);
  int apart = 0, together = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 low_a = dice.vector(1), low_b = dice.vector(1);
    const Aabb a{low_a, low_a + dice.vector(1).cwiseAbs()}, b{low_b, low_b + dice.vector(1).cwiseAbs()};
    const BoundingSphere s{dice.vector(2), dice.in(0, 1)}, t{dice.vector(2), dice.in(0, 1)};
    const Vec3 common = a.min.cwiseMax(b.min);
    EXPECT_EQ(overlap(a, b), contains(a, common) && contains(b, common));
    EXPECT_EQ(overlap(a, b), overlap(b, a));
    // The gap of two spheres along the line of centres.
    EXPECT_EQ(overlap(s, t), (s.centre - t.centre).norm() - s.radius - t.radius <= 0);
    // Distance from a centre to a box, by its three parts.
    const Vec3 outside = (a.min - s.centre).cwiseMax(s.centre - a.max).cwiseMax(0.0);
    EXPECT_EQ(overlap(s, a), outside.norm() <= s.radius);
    (overlap(a, b) ? together : apart) += 1;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(together, 500);
}

TEST(BoundingVolume, TouchesAsClosedSetsDo) {
  const BoundingSphere s{Vec3::Zero(), 1}, t{Vec3(3, 0, 0), 2};
  EXPECT_TRUE(overlap(s, t));
  EXPECT_FALSE(overlap(s, BoundingSphere{Vec3(std::nextafter(3.0, 4.0), 0, 0), 2}));
  EXPECT_TRUE(overlap(s, Aabb{Vec3(1, 0, 0), Vec3(2, 1, 1)}));
  EXPECT_FALSE(overlap(s, Aabb{Vec3(1, 0.1, 0), Vec3(2, 1, 1)}));
  EXPECT_TRUE(overlap(Aabb{Vec3::Zero(), Vec3::Ones()}, Aabb{Vec3::Ones(), Vec3::Ones()}));
}

TEST(BoundingVolume, WithNanOverlapsNothing) {
  const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const Aabb all{Vec3::Constant(-kInf), Vec3::Constant(kInf)};
  EXPECT_FALSE(overlap(all, Aabb{nan, nan}));
  EXPECT_FALSE(overlap(BoundingSphere{nan, 1}, BoundingSphere{Vec3::Zero(), kInf}));
  EXPECT_FALSE(overlap(BoundingSphere{Vec3::Zero(), nan.x()}, all));
  EXPECT_FALSE(overlap(BoundingSphere{nan, 1}, all));
}

TEST(BoundingVolume, OfPointsIsTheirRangeAndNeedsOne) {
  const std::vector<Vec3> points{{1, 5, -2}, {0, 7, 3}, {2, 6, 0}};
  EXPECT_EQ(bounding_box(points).min, Vec3(0, 5, -2));
  EXPECT_EQ(bounding_box(points).max, Vec3(2, 7, 3));
  EXPECT_THROW(bounding_box(std::span<const Vec3>()), std::invalid_argument);
  const std::vector<Vec3> bad{{1, 5, -2}, {0, std::numeric_limits<double>::quiet_NaN(), 3}};
  EXPECT_THROW(bounding_box(bad), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
