#include "plumbline/core/broad_phase/enclosing_sphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plumbline/core/collision/time_of_impact.hpp"
#include "scattered_boxes.hpp"

namespace plumbline {
namespace {

// The promise of the header; the smallest radius depends on the points to first order, so 1e-9 leaves room for the
// supports that are nearly flat.
constexpr double kPromise = 1e-9;

// How far the largest distance to a point can be brought down by moving the centre: the function is convex, so a search
// along shrinking steps from any start finds the least. Knows nothing of Welzl's algorithm.
double least_radius(const std::vector<Vec3>& points, const Vec3& start, double step) {
  const auto radius = [&](const Vec3& c) {
    double largest = 0;
    for (const Vec3& p : points) largest = std::max(largest, (p - c).norm());
    return largest;
  };
  Dice dice(99);
  Vec3 best = start;
  double least = radius(best);
  for (int misses = 0; step > 1e-13 * least;) {
    const Vec3 next = best + step * dice.direction();
    const double there = radius(next);
    if (there < least) {
      least = there;
      best = next;
      misses = 0;
    } else if (++misses == 30) {
      step *= 0.5;
      misses = 0;
    }
  }
  return least;
}

TEST(EnclosingSphere, OfRegularBodiesIsTheirCircumscribedSphere) {
  const std::vector<Vec3> tetrahedron{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  EXPECT_NEAR(enclosing_sphere(tetrahedron).radius, std::sqrt(3), 1e-14);
  EXPECT_LE(enclosing_sphere(tetrahedron).centre.norm(), 1e-14);
  std::vector<Vec3> box;  // eight points on one sphere: any four of them would do
  for (int c = 0; c < 8; ++c) box.push_back(Vec3(10, 20, 30) + box_corner(Vec3(2, 3, 6), c));
  EXPECT_NEAR(enclosing_sphere(box).radius, 3.5, 1e-13);
  EXPECT_LE((enclosing_sphere(box).centre - Vec3(10, 20, 30)).norm(), 1e-13);
}

TEST(EnclosingSphere, OfAFlatTriangleRestsOnTwoOrThreePoints) {
  // Obtuse: the longest side is the diameter. Acute: the circumscribed circle, R = abc / 4A = 5 5 6 / (4 12).
  EXPECT_NEAR(enclosing_sphere(std::vector<Vec3>{{-5, 0, 0}, {5, 0, 0}, {0, 2, 0}}).radius, 5, 1e-14);
  EXPECT_NEAR(enclosing_sphere(std::vector<Vec3>{{-3, 0, 1}, {3, 0, 1}, {0, 4, 1}}).radius, 150.0 / 48, 1e-14);
}

TEST(EnclosingSphere, HoldsAllPointsAndNoSmallerOneDoes) {
  Dice dice(7);
  for (int k = 0; k < 200; ++k) {
    std::vector<Vec3> points;
    const std::size_t n = 1 + dice.below(60);
    const Vec3 stretch(1, dice.in(0, 1), k % 3 == 0 ? 0 : dice.in(0, 1));  // every third set is flat
    for (std::size_t i = 0; i < n; ++i) points.push_back(Vec3(3, 4, 5) + stretch.cwiseProduct(dice.vector(1)));
    const BoundingSphere sphere = enclosing_sphere(points);
    for (const Vec3& p : points) EXPECT_LE((p - sphere.centre).norm(), sphere.radius);
    EXPECT_LE(sphere.radius, least_radius(points, points[0], 1) * (1 + kPromise) + 1e-15) << k;
  }
}

// Jung's theorem (1901): points at most D apart fit into a sphere of radius D sqrt(3/8); and D/2 is needed.
TEST(EnclosingSphere, KeepsTheBoundsOfJung) {
  Dice dice(8);
  for (int k = 0; k < 100; ++k) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < 30; ++i) points.push_back(dice.direction());
    double diameter = 0;
    for (const Vec3& p : points) {
      for (const Vec3& q : points) diameter = std::max(diameter, (p - q).norm());
    }
    const double radius = enclosing_sphere(points).radius;
    EXPECT_GE(radius, 0.5 * diameter * (1 - kPromise));
    EXPECT_LE(radius, std::sqrt(3.0 / 8) * diameter * (1 + kPromise));
  }
}

TEST(EnclosingSphere, StandsRepeatedAndCollinearPointsAndManyOnOneSphere) {
  EXPECT_EQ(enclosing_sphere(std::vector<Vec3>(50, Vec3(1, 2, 3))).radius, 0);
  std::vector<Vec3> line, ball;
  for (int i = 0; i <= 1000; ++i) line.push_back(Vec3(1e6, 0, 0) + 1e-3 * i * Vec3(1, 2, 2));
  EXPECT_NEAR(enclosing_sphere(line).radius, 1.5, 1e-9);  // a coordinate of 1e6 is rounded by 1e-10
  Dice dice(9);
  for (int i = 0; i < 3000; ++i) ball.push_back(2 * dice.direction());
  EXPECT_NEAR(enclosing_sphere(ball).radius, 2, 2 * kPromise);
}

TEST(EnclosingSphere, NeedsFinitePoints) {
  EXPECT_THROW(enclosing_sphere(std::vector<Vec3>{}), std::invalid_argument);
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(enclosing_sphere(std::vector<Vec3>{{0, 0, 0}, {0, inf, 0}}), std::invalid_argument);
  EXPECT_THROW(enclosing_sphere(std::vector<Vec3>{{0, 0, inf - inf}}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
