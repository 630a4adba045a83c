#include "plumbline/core/collision/segment_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "plumbline/core/collision/polynomial_roots.hpp"
#include "random_scenes.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kHorizon = 2;  // [s]
#if defined(__SANITIZE_ADDRESS__)
constexpr int kTrials = 300;
#else
constexpr int kTrials = 3000;
#endif

// The least of a convex function on [0, 1], by cutting off thirds.
double least(const std::function<double(double)>& f) {
  double low = 0, high = 1;
  for (int k = 0; k < 100; ++k) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    (f(left) < f(right) ? high : low) = f(left) < f(right) ? right : left;
  }
  return f(0.5 * (low + high));
}

// The first interval of `resolution` in which a distance may close that changes no faster than `speed`: its left end.
std::optional<double> may_close(const std::function<double(double)>& distance, double speed, double resolution,
                                double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  if (distance(middle) > half * speed) return std::nullopt;
  if (to - from < resolution) return from;
  const auto early = may_close(distance, speed, resolution, from, middle);
  return early ? early : may_close(distance, speed, resolution, middle, to);
}

// A point that passes `at` at that time, at a random velocity.
MovingPoint passing(SceneRandom& random, const Vec3& at, double time) {
  MovingPoint p;
  p.v_W = random.vector(1.5);
  p.p_W = at - time * p.v_W;
  return p;
}

struct Made {
  double time, slope;  // when they are made to meet, and how fast the volume that they span changes for its area [m/s]
};

// Two segments that cross at a known time, up to a gap along their common normal.
Made make_crossing(SceneRandom& random, double gap, MovingSegment& a, MovingSegment& b) {
  const double time = random.in(0.1, kHorizon);
  const Vec3 u = random.in(0.3, 2) * random.direction(), v = random.in(0.3, 2) * random.direction();
  const Vec3 point = random.vector(2), n = u.cross(v).normalized();
  const double s = random.in(0.02, 0.98), r = random.in(0.02, 0.98);
  a = {passing(random, point - s * u, time), passing(random, point + (1 - s) * u, time)};
  b = {passing(random, point - r * v + gap * n, time), passing(random, point + (1 - r) * v + gap * n, time)};
  const Vec3 v_a = (1 - s) * a.tail.v_W + s * a.head.v_W, v_b = (1 - r) * b.tail.v_W + r * b.head.v_W;
  return {time, std::abs(n.dot(v_a - v_b)) * n.dot(u.cross(v)) / (u.norm() * v.norm())};
}

TEST(SegmentImpact, FindsTheFirstCrossing) {
  SceneRandom random(24);
  int hits = 0, misses = 0, at_the_made_time = 0;
  double worst = 0;
  for (int k = 0; k < kTrials; ++k) {
    MovingSegment a, b;
    const bool apart = k % 3 == 0;
    const Made made = make_crossing(random, apart ? random.in(0.01, 0.1) : 0, a, b);
    const auto distance = [&](double t) {
      const Segment now = a.at(t), other = b.at(t);
      return least([&](double s) {
        const Vec3 p = now.tail + s * (now.head - now.tail);
        return (p - nearest_on_segment(p, other)).norm();
      });
    };
    double speed = 0;
    for (const MovingPoint& end_a : {a.tail, a.head}) {
      for (const MovingPoint& end_b : {b.tail, b.head}) speed = std::max(speed, (end_a.v_W - end_b.v_W).norm());
    }
    const auto found = segment_meets_segment(a, b, kHorizon);
    if (!apart) {
      ASSERT_TRUE(found.has_value()) << k;
    }
    const double resolution = 1e-7;
    const auto expected = may_close(distance, speed, resolution, 0, found ? found->time : kHorizon);
    if (!found) {
      ++misses;
      // An interval that may close is one in which the distance is next to nothing, but it must not be nothing.
      if (expected) {
        EXPECT_GT(distance(*expected), 1e-9) << k;
      }
      continue;
    }
    ++hits;
    ASSERT_LE(distance(found->time), 1e-12) << k;  // they do touch, to some roundings over the sine of their angle
    // Not before: an earlier interval in which they may is on the slope that leads to this touch.
    ASSERT_TRUE(expected.has_value()) << k;
    EXPECT_LE(distance(*expected), 2 * resolution * speed) << k;
    if (std::abs(found->time - made.time) < 1e-6) {
      ++at_the_made_time;
      const double error = std::abs(found->time - made.time);
      EXPECT_LE(error, 32 * kEps * 6 / made.slope) << k;  // coordinates of up to 6 m are rounded
      if (made.slope > 0.1) worst = std::max(worst, error);
    } else {
      EXPECT_LT(found->time, apart ? kHorizon : made.time) << k;
    }
    EXPECT_NEAR(found->normal_W.norm(), 1, 8 * kEps);
  }
  EXPECT_GT(at_the_made_time, kTrials / 2);
  EXPECT_GT(misses, kTrials / 20);
  EXPECT_LT(worst, 1e-12);
  RecordProperty("worst_error_fs", std::to_string(worst * 1e15));
}

TEST(SegmentImpact, KnowsTheCrossingOfTwoRods) {
  // b falls onto a from 3 m at 2 m/s, across it, while it also slides along.
  const MovingSegment a{{Vec3(-1, 0, 0), Vec3::Zero()}, {Vec3(1, 0, 0), Vec3::Zero()}};
  const Vec3 fall(0.1, 0, -2);
  MovingSegment b{{Vec3(0.2, -1, 3), fall}, {Vec3(0.2, 1, 3), fall}};
  const auto touch = segment_meets_segment(a, b, 10);
  ASSERT_TRUE(touch.has_value());
  EXPECT_NEAR(touch->time, 1.5, 4 * kEps);
  EXPECT_LE((touch->point_W - Vec3(0.35, 0, 0)).norm(), 4 * kEps);
  EXPECT_LE((touch->normal_W - Vec3(0, 0, -1)).norm(), 4 * kEps);  // from b to a
  EXPECT_EQ(segment_meets_segment(a, b, 1.4), std::nullopt);
  b.tail.p_W.x() = b.head.p_W.x() = 0.9;  // the planes meet, but beyond a's end
  EXPECT_EQ(segment_meets_segment(a, b, 10), std::nullopt);
  b.tail.p_W.x() = b.head.p_W.x() = 0.85;  // at a's very end
  EXPECT_NEAR(segment_meets_segment(a, b, 10).value_or(Touch{}).time, 1.5, 4 * kEps);
}

// The double root: b's ends move so that F = c (t - 1)^2. They touch at 1 s and do not pass through each other.
TEST(SegmentImpact, DoesNotMissAGrazingTouch) {
  const MovingSegment a{{Vec3(-1, 0, 0), Vec3::Zero()}, {Vec3(1, 0, 0), Vec3::Zero()}};
  MovingSegment b{{Vec3(0, -2, -1), Vec3(0, 1, 0)}, {Vec3(0, 1, 0), Vec3(0, 0, 1)}};
  const auto touch = segment_meets_segment(a, b, 1.9);
  ASSERT_TRUE(touch.has_value());
  EXPECT_NEAR(touch->time, 1, 8 * std::sqrt(kEps));  // a root of F to eps in a curve of order 1
  // Moved by 1e-9 m: F = (t - 1)^2 + 2e-9 up to its third digit, in which way depends on the sign.
  b.tail.p_W.z() = -1 + 1e-9;
  b.head.p_W.z() = 1e-9;
  const auto through = segment_meets_segment(a, b, 1.9);
  b.tail.p_W.z() = -1 - 1e-9;
  b.head.p_W.z() = -1e-9;
  const auto past = segment_meets_segment(a, b, 1.9);
  ASSERT_NE(through.has_value(), past.has_value());
  EXPECT_NEAR((through ? through : past)->time, 1 - std::sqrt(2e-9), 1e-8);
}

// All in one plane all the time: F is zero identically.
TEST(SegmentImpact, WorksInThePlane) {
  SceneRandom random(25);
  for (int k = 0; k < 100; ++k) {
    const Quat turn = k == 0 ? rotation_by(Vec3::Zero()) : random.attitude();
    const Vec3 shift = k == 0 ? Vec3(Vec3::Zero()) : random.vector(1);
    const auto at = [&](double x, double y, double vx, double vy) {
      return MovingPoint{shift + turn * Vec3(x, y, 0), turn * Vec3(vx, vy, 0)};
    };
    const MovingSegment floor{at(-1, 0, 0, 0), at(1, 0, 0, 0)};
    const double rounding = 64 * kEps * 6;  // coordinates of up to 6 m, at 1 m/s or more
    // A slanting rod whose lower end comes down on the floor.
    const auto end = segment_meets_segment({at(0.2, 1, 0.1, -1), at(0.5, 2, 0.1, -1)}, floor, 5);
    ASSERT_TRUE(end.has_value()) << k;
    EXPECT_NEAR(end->time, 1, rounding);
    EXPECT_LE((end->point_W - floor.tail.p_W - turn * Vec3(1.3, 0, 0)).norm(), rounding);
    EXPECT_LE((end->normal_W - turn * Vec3(0, 1, 0)).norm(), rounding);
    // Past the end of the floor.
    EXPECT_EQ(segment_meets_segment({at(1.2, 1, 0, -1), at(1.5, 2, 0, -1)}, floor, 5), std::nullopt);
    // Parallel: they meet along a part of their length.
    const auto flat = segment_meets_segment({at(0, 1, 0, -2), at(3, 1, 0, -2)}, floor, 5);
    ASSERT_TRUE(flat.has_value()) << k;
    EXPECT_NEAR(flat->time, 0.5, rounding);
    EXPECT_LE((flat->normal_W - turn * Vec3(0, 1, 0)).norm(), rounding);
    // Parallel, side by side, never meeting.
    EXPECT_EQ(segment_meets_segment({at(0, 1, 2, 0), at(3, 1, 2, 0)}, floor, 5), std::nullopt);
    // On one line: end to end.
    const auto line = segment_meets_segment({at(4, 0, -2, 0), at(6, 0, -2, 0)}, floor, 5);
    ASSERT_TRUE(line.has_value()) << k;
    EXPECT_NEAR(line->time, 1.5, rounding);
    EXPECT_LE((line->normal_W - turn * Vec3(1, 0, 0)).norm(), 1e-8);
    EXPECT_EQ(segment_meets_segment({at(4, 0, 2, 0), at(6, 0, 2, 0)}, floor, 5), std::nullopt);
    // They lie across each other from the start.
    EXPECT_EQ(segment_meets_segment({at(0, -1, 1, 1), at(0, 1, 1, 1)}, floor, 5).value_or(Touch{-1}).time, 0);
  }
}

TEST(SegmentImpact, PointMeetsTriangle) {
  SceneRandom random(26);
  int at_the_made_time = 0, misses = 0;
  for (int k = 0; k < kTrials; ++k) {
    const double time = random.in(0.1, kHorizon);
    const std::array<Vec3, 3> corners{random.vector(1), random.vector(1), random.vector(1)};
    const Vec3 twice_area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (twice_area.norm() < 0.1) continue;
    MovingTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = passing(random, corners[i], time);
    double s = random.in(0, 1), r = random.in(0, 1);
    if (s + r > 1) s = 1 - s, r = 1 - r;
    const bool apart = k % 3 == 0;  // as much beside the opposite side as it would be inside
    const Vec3 mid = corners[0] + (apart ? 2 - s : s) * (corners[1] - corners[0]) + r * (corners[2] - corners[0]);
    const MovingPoint point = passing(random, mid, time);
    const auto found = point_meets_triangle(point, triangle, kHorizon);
    if (found) {
      const double t = found->time;
      const Vec3 on = nearest_on_triangle(point.at(t), {triangle[0].at(t), triangle[1].at(t), triangle[2].at(t)});
      EXPECT_LE((on - point.at(t)).norm(), 1e-12) << k;
      const Vec3 v = (1 - s - r) * triangle[0].v_W + s * triangle[1].v_W + r * triangle[2].v_W - point.v_W;
      if (std::abs(t - time) < 1e-6) {
        ++at_the_made_time;
        const double slope = std::abs(twice_area.normalized().dot(v));
        EXPECT_LE(std::abs(t - time), 64 * kEps * 6 / (slope * std::min(1.0, twice_area.norm()))) << k;
      } else {
        EXPECT_LT(t, apart ? kHorizon : time) << k;
      }
    } else {
      EXPECT_TRUE(apart) << k;
      ++misses;
    }
  }
  EXPECT_GT(at_the_made_time, kTrials / 3);
  EXPECT_GT(misses, kTrials / 10);

  // In the plane of a resting triangle: the hypotenuse x + y = 1 is hit from outside.
  const MovingTriangle flat{MovingPoint{Vec3(0, 0, 0)}, MovingPoint{Vec3(1, 0, 0)}, MovingPoint{Vec3(0, 1, 0)}};
  const auto touch = point_meets_triangle({Vec3(2.4, 2.6, 0), Vec3(-1, -1, 0)}, flat, 10);
  ASSERT_TRUE(touch.has_value());
  EXPECT_NEAR(touch->time, 2, 8 * kEps);
  EXPECT_LE((touch->normal_W - Vec3(1, 1, 0) / std::sqrt(2.0)).norm(), 8 * kEps);
}

TEST(SegmentImpact, IsNothingForNan) {
  MovingSegment a{{Vec3(-1, 0, 0), Vec3::Zero()}, {Vec3(1, 0, 0), Vec3::Zero()}};
  const MovingSegment b{{Vec3(0, -1, 3), Vec3(0, 0, -2)}, {Vec3(0, 1, 3), Vec3(0, 0, -2)}};
  a.head.p_W.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(segment_meets_segment(a, b, 10), std::nullopt);
  EXPECT_EQ(segment_meets_segment(b, a, 10), std::nullopt);
  EXPECT_EQ(point_meets_triangle(a.head, {a.tail, b.tail, b.head}, 10), std::nullopt);
}

TEST(PolynomialRoots, AreFoundWithTheirMultiplicity) {
  const std::array<double, 4> simple{-6, 11, -6, 1};  // (t-1)(t-2)(t-3)
  const auto three = polynomial_roots(simple, 0, 10);
  ASSERT_EQ(three.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(three[k], static_cast<double>(k + 1), 32 * kEps * 24);
  EXPECT_EQ(polynomial_roots(simple, 1.5, 2.5).size(), 1u);
  EXPECT_TRUE(polynomial_roots(simple, 3.5, 9).empty());

  const std::array<double, 4> touching{-4, 8, -5, 1};  // (t-1)(t-2)^2
  const auto roots = polynomial_roots(touching, 0, 10);
  ASSERT_GE(roots.size(), 2u);
  EXPECT_NEAR(roots.front(), 1, 32 * kEps * 18);
  EXPECT_NEAR(roots.back(), 2, 1e-6);  // the value is uncertain by 24 eps * 72, its curve is (t-2)^2

  const std::array<double, 3> none{1, 0, 1};
  EXPECT_TRUE(polynomial_roots(none, -5, 5).empty());
  const std::array<double, 3> nothing{0, 0, 0};
  EXPECT_FALSE(polynomial_roots(nothing, 2, 5).empty());
  const std::array<double, 3> nan{1, std::numeric_limits<double>::quiet_NaN(), 1};
  EXPECT_TRUE(polynomial_roots(nan, -5, 5).empty());
}

}  // namespace
}  // namespace plumbline
