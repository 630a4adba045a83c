#include "plumbline/core/collision/shape_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "random_scenes.hpp"

namespace plumbline {
namespace {

// Everything starts 10 m above the other thing, measured from surface to surface, falls at 1 m/s and 2 m/s^2, and so
// meets it when t + t^2 = 10. Boxes lie flat.
TEST(ShapeImpact, OfEveryPairIsThatOfTheGap) {
  const Shape sphere = Sphere{0.5}, box = Box{Vec3(1, 2, 1)}, ground = HalfSpace{Vec3::UnitZ()};
  const double exact = 0.5 * (std::sqrt(41.0) - 1);
  const auto half_height = [](const Shape& shape) { return std::holds_alternative<HalfSpace>(shape) ? 0.0 : 0.5; };
  for (const Shape& a : {sphere, box}) {
    for (const Shape& b : {sphere, box, ground}) {
      const std::string name = std::string(shape_name(a)) + " on " + std::string(shape_name(b));
      Motion up, down;
      down.start.p_WB = Vec3(3, 4, 5);
      up.start.p_WB = down.start.p_WB + Vec3(0, 0, 10 + half_height(a) + half_height(b));
      up.start.v_WB = Vec3(0, 0, -1);
      up.a_W = Vec3(0, 0, -2);
      const auto touch = shapes_meet(a, up, b, down, 10);
      ASSERT_TRUE(touch.has_value()) << name;
      EXPECT_NEAR(touch->time, exact, 1e-12) << name;
      EXPECT_LE((touch->normal_W - Vec3(0, 0, 1)).norm(), 1e-14) << name;
      EXPECT_LE((touch->point_W - Vec3(3, 4, 5 + half_height(b))).norm(), 1e-11) << name;
      const auto swapped = shapes_meet(b, down, a, up, 10);
      ASSERT_TRUE(swapped.has_value()) << name;
      EXPECT_NEAR(swapped->time, exact, 1e-12) << name;
      EXPECT_LE((swapped->normal_W + touch->normal_W).norm(), 1e-14) << name;
      EXPECT_LE((swapped->point_W - touch->point_W).norm(), 1e-11) << name;
      EXPECT_EQ(shapes_meet(a, up, b, down, exact - 0.01), std::nullopt) << name;
    }
  }
  EXPECT_EQ(shapes_meet(ground, Motion{}, ground, Motion{}, 10), std::nullopt);
}

// A cube holds the sphere through the middles of its faces and lies in the one through its corners: it cannot meet
// anything later than the one, nor earlier than the other. Boxes, spheres and their mixture are computed in different
// ways.
TEST(ShapeImpact, OfABoxLiesBetweenThoseOfItsInnerAndOuterSphere) {
  SceneRandom random(31);
  int hits = 0;
  for (int k = 0; k < 500; ++k) {
    const Shape cube = Box{Vec3(1, 1, 1)}, inner = Sphere{0.5}, outer = Sphere{0.5 * std::sqrt(3.0)};
    const Shape target = Box{Vec3(2, 0.5, 1)};
    Motion a, b;
    a.start.p_WB = 4 * random.direction();
    a.start.v_WB = -a.start.p_WB + random.vector(0.5);
    a.start.w_WB = random.vector(4);
    b.start.q_WB = random.attitude();
    b.start.w_WB = random.vector(3);
    const auto first = shapes_meet(outer, a, target, b, 3), last = shapes_meet(inner, a, target, b, 3);
    const auto touch = shapes_meet(cube, a, target, b, 3);
    if (last) {
      ASSERT_TRUE(touch.has_value()) << k;
      EXPECT_LE(touch->time, last->time + 1e-11) << k;
    }
    if (touch) {
      ++hits;
      ASSERT_TRUE(first.has_value()) << k;
      EXPECT_GE(touch->time, first->time - 1e-11) << k;
    }
  }
  EXPECT_GT(hits, 250);
}

}  // namespace
}  // namespace plumbline
