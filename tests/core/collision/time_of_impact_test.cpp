#include "plumbline/core/collision/time_of_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr int kTrials = 10000;

class Random {
 public:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }

 private:
  std::mt19937_64 engine_{20240607};
};

// The root of a function that is positive at `low` and negative at `high`, to the last bit that bisection can give.
double bisect(const std::function<double(double)>& f, double low, double high) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) > 0 ? low : high) = middle;
  }
  return low;
}

TEST(TimeOfImpact, OfSpheresAgreesWithBisection) {
  Random random;
  int hits = 0;
  for (int k = 0; k < kTrials; ++k) {
    Motion a, b;
    a.start.p_WB = random.vector(5);
    b.start.p_WB = random.vector(5);
    // Aimed at each other, with a scatter that makes about half of them miss.
    a.start.v_WB = random.in(-0.2, 1) * (b.start.p_WB - a.start.p_WB) + random.vector(1);
    b.start.v_WB = random.vector(0.3);
    const double radius_a = random.in(0.1, 1.5), radius_b = random.in(0.1, 1.5), reach = radius_a + radius_b;
    const Vec3 d = a.start.p_WB - b.start.p_WB, v = a.start.v_WB - b.start.v_WB;
    const auto gap = [&](double t) { return (d + v * t).norm() - reach; };
    const double nearest = -d.dot(v) / v.squaredNorm();  // the gap falls until then
    const auto found = sphere_meets_sphere(a, radius_a, b, radius_b, 1e9);
    if (nearest <= 0 || gap(nearest) > 1e-12) {
      EXPECT_FALSE(found.has_value()) << k;
    } else if (gap(0) <= 0) {
      EXPECT_EQ(found, 0.0) << k;
    } else if (gap(nearest) < -1e-12) {
      ++hits;
      ASSERT_TRUE(found.has_value()) << k;
      const double t = bisect(gap, 0, nearest);
      // Some roundings of positions up to 20 m, turned into time by the rate at which the gap closes.
      const double rate = -(d + v * t).dot(v) / reach;
      EXPECT_NEAR(*found, t, 16 * kEps * (20 / rate + t)) << k;
    }
  }
  EXPECT_GT(hits, kTrials / 5);  // the test must not run empty
}

TEST(TimeOfImpact, WithAPlaneAgreesWithBisection) {
  Random random;
  int hits = 0, returns = 0;
  for (int k = 0; k < kTrials; ++k) {
    Motion m;
    m.start.p_WB = random.vector(3);
    m.start.v_WB = random.vector(3);
    if (k % 3 != 0) m.a_W = random.vector(10);
    const Plane plane{random.direction(), random.in(-3, 3)};
    const double radius = k % 2 == 0 ? 0 : random.in(0.1, 1);
    const auto gap = [&](double t) {
      return plane.normal_W.dot(m.start.p_WB + t * m.start.v_WB + 0.5 * t * t * m.a_W) - plane.offset - radius;
    };
    const double u = plane.normal_W.dot(m.start.v_WB), c = plane.normal_W.dot(m.a_W);
    const auto found = radius == 0 ? point_meets_plane(m, plane) : sphere_meets_plane(m, radius, plane);
    if (gap(0) <= 0) {
      if (u < 0) {
        EXPECT_EQ(found, 0.0) << k;
      }
      if (u > 0 && c >= 0) {
        EXPECT_FALSE(found.has_value()) << k;
      }
      continue;
    }
    // Where the gap is smallest (turning point ahead) or certainly closed (falling for good).
    double low = 0, high = 0;
    if (c > 0) high = -u / c;
    if (c == 0 && u < 0) high = -2 * gap(0) / u;
    if (c < 0) {
      low = u > 0 ? -u / c : 0;
      high = low + 2 * std::sqrt(2 * gap(low) / -c) + 1;
    }
    if (high <= low || gap(high) > 1e-12) {
      EXPECT_FALSE(found.has_value()) << k;
    } else if (gap(high) < -1e-12) {
      ++hits;
      returns += u > 0 ? 1 : 0;
      ASSERT_TRUE(found.has_value()) << k;
      const double t = bisect(gap, low, high);
      const double rate = -(u + c * t);
      const double reach = 10 + std::abs(u) * t + 10 * t * t;  // the largest number that is rounded [m]
      EXPECT_NEAR(*found, t, 16 * kEps * (reach / rate + t)) << k;
    }
  }
  EXPECT_GT(hits, kTrials / 5);
  EXPECT_GT(returns, kTrials / 20);
}

// The first of all: nothing of the box is below the plane before, and something is on it then.
TEST(TimeOfImpact, OfATurningBoxIsTheFirstTouch) {
  Random random;
  int hits = 0;
  constexpr int kSamples = 200;
  for (int k = 0; k < kTrials / 5; ++k) {
    Motion m;
    m.start.q_WB = rotation_by(random.vector(3));
    m.start.v_WB = random.vector(2);
    m.start.w_WB = random.vector(k % 4 == 0 ? 0 : 15);
    if (k % 2 == 0) m.a_W = random.vector(10);
    const Vec3 size(random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1));
    const Plane plane{random.direction(), -random.in(0.4, 1.5) * size.norm()};
    const double horizon = 1;
    const auto lowest = [&](double t) {
      const Vec3 p = m.start.p_WB + t * m.start.v_WB + 0.5 * t * t * m.a_W;
      const Quat q = rotation_by(t * m.start.w_WB) * m.start.q_WB;
      double gap = std::numeric_limits<double>::infinity();
      for (int c = 0; c < 8; ++c) gap = std::min(gap, plane.normal_W.dot(p + q * box_corner(size, c)) - plane.offset);
      return gap;
    };
    if (lowest(0) <= 0) continue;
    const auto found = box_meets_plane(m, size, plane, horizon);
    // Heights are sums of a dozen products of numbers up to 10 m.
    const double rounding = 100 * kEps * 10;
    const double until = found.value_or(horizon);
    if (found) {
      ++hits;
      EXPECT_NEAR(lowest(*found), 0, kImpactTolerance * size.norm() + rounding) << k;
    }
    for (int j = 0; j <= kSamples; ++j) {
      ASSERT_GE(lowest(until * j / kSamples), -rounding) << "trial " << k << ", found " << until;
    }
  }
  EXPECT_GT(hits, kTrials / 50);
}

TEST(TimeOfImpact, OfAcceleratedSpheresIsTheFirstTouch) {
  Random random;
  int hits = 0;
  for (int k = 0; k < kTrials / 5; ++k) {
    Motion a, b;
    a.start.p_WB = random.direction() * 2.5;
    a.start.v_WB = random.vector(3);
    a.a_W = random.vector(8);
    b.a_W = random.vector(8);
    const double horizon = 2, reach = 2;
    const auto gap = [&](double t) {
      return (a.start.p_WB + t * a.start.v_WB + 0.5 * t * t * (a.a_W - b.a_W)).norm() - reach;
    };
    const auto found = sphere_meets_sphere(a, 1.25, b, 0.75, horizon);
    const double rounding = 32 * kEps * 50;
    const double until = found.value_or(horizon);
    if (found) {
      ++hits;
      EXPECT_NEAR(gap(*found), 0, kImpactTolerance * reach + rounding) << k;
    }
    for (int j = 0; j <= 200; ++j) ASSERT_GE(gap(until * j / 200), -rounding) << k;
  }
  EXPECT_GT(hits, kTrials / 50);
}

TEST(TimeOfImpact, KeepsItsDigitsForGrazingSpheres) {
  // Passing at 1 - 1e-12 of the reach 1 m: half of the chord is sqrt(1 - (1 - d)^2) = sqrt(2d - d^2) with d as the
  // double nearest to it has it. The textbook's b^2 - a c would lose 12 of 16 digits of the radicand.
  const double d = 1e-12, pass = 1 - d, exact_d = 1 - pass;
  Motion a, b;
  a.start.p_WB = Vec3(-10, pass, 0);
  a.start.v_WB = Vec3(1, 0, 0);
  const auto t = sphere_meets_sphere(a, 0.5, b, 0.5, 100);
  ASSERT_TRUE(t.has_value());
  // One rounding of |d x v| = 1 is kEps/2 of the radicand 2d: relative 1e-4, halved by the root, times 1.4e-6 s.
  const double half_chord = std::sqrt(2 * exact_d - exact_d * exact_d);
  EXPECT_NEAR(*t, 10 - half_chord, half_chord * kEps / exact_d + 8 * kEps * 10);
}

TEST(TimeOfImpact, IsZeroForTouchingBodiesThatApproachAndNothingForThoseThatPart) {
  Motion a, b;
  a.start.p_WB = Vec3(0, 0, 1);
  const Plane floor{Vec3::UnitZ(), 0};
  for (const double v : {-1.0, 1.0}) {
    a.start.v_WB = Vec3(0, 0, v);
    const std::optional<double> wanted = v < 0 ? std::optional(0.0) : std::nullopt;
    EXPECT_EQ(sphere_meets_plane(a, 1, floor), wanted);
    EXPECT_EQ(sphere_meets_sphere(a, 0.5, b, 0.5, 1), wanted);
    EXPECT_EQ(box_meets_plane(a, Vec3(2, 2, 2), floor, 1), wanted);
    EXPECT_EQ(point_meets_plane(a, Plane{Vec3::UnitZ(), 1}), wanted);
  }
}

TEST(TimeOfImpact, IsNothingForNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Plane floor{Vec3::UnitZ(), 0};
  for (const bool in_position : {true, false}) {
    Motion a, b;
    a.start.p_WB = Vec3(0, 0, 3);
    a.start.v_WB = Vec3(0, 0, -1);
    a.start.w_WB = Vec3(1, 0, 0);
    (in_position ? a.start.p_WB : a.start.v_WB).z() = nan;
    EXPECT_EQ(point_meets_plane(a, floor), std::nullopt);
    EXPECT_EQ(sphere_meets_plane(a, 1, floor), std::nullopt);
    EXPECT_EQ(sphere_meets_sphere(a, 1, b, 1, 10), std::nullopt);
    EXPECT_EQ(box_meets_plane(a, Vec3(1, 1, 1), floor, 10), std::nullopt);
  }
}

}  // namespace
}  // namespace plumbline
