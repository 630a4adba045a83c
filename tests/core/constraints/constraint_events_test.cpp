#include "plumbline/core/constraints/constraint_events.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "particle_scenes.hpp"
#include "plumbline/core/constraints/bounded_coordinate.hpp"
#include "plumbline/core/constraints/first_crossing.hpp"

namespace plumbline {
namespace {

using namespace particles;

TEST(FirstCrossing, FindsTheFirstFallThroughZero) {
  // (t - 1)(t - 2)(t - 3) rises through 1, falls through 2; its negative falls through 1.
  const std::array<double, 4> rises{-6, 11, -6, 1}, falls{6, -11, 6, -1};
  EXPECT_NEAR(*first_crossing(rises, 10), 2, 1e-15);
  EXPECT_NEAR(*first_crossing(falls, 10), 1, 1e-15);
  EXPECT_FALSE(first_crossing(rises, 1.9));
  // Touches at 1 and turns back; falls at 3: (t - 1)^2 (3 - t).
  const std::array<double, 4> touches{3, -7, 5, -1};
  EXPECT_NEAR(*first_crossing(touches, 10), 3, 1e-15);
  EXPECT_FALSE(first_crossing(std::array{1.0}, 10));
  EXPECT_FALSE(first_crossing(std::array{std::numeric_limits<double>::quiet_NaN(), -1.0}, 10));
  EXPECT_EQ(*first_crossing(std::array{2.0, -1.0}, 2), 2);
  EXPECT_GE(zeros_bound(falls), 3);
}

TEST(FirstCrossing, AgreesWithTheRootsThatPolynomialsAreMadeOf) {
  Random random(41);
  for (int trial = 0; trial < 2000; ++trial) {
    // Degree 4 with real roots at distances of at least 0.1, from -1 to 3.
    std::array<double, 4> roots{};
    double at = random.in(-1, 0.5);
    for (double& root : roots) {
      root = at;
      at += random.in(0.1, 0.8);
    }
    std::array<double, 5> c{1, 0, 0, 0, 0};
    const double sign = trial % 2 == 0 ? 1 : -1;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t j = 4; j > 0; --j) c[j] = c[j - 1] - roots[k] * c[j];
      c[0] *= -roots[k];
    }
    for (double& value : c) value *= sign;
    // Positive beyond the last root if the sign is +: falls at roots 0 and 2, else at 1 and 3.
    double expected = -1;
    for (std::size_t k = trial % 2 == 0 ? 0 : 1; k < 4 && expected < 0; k += 2)
      if (roots[k] > 0) expected = roots[k];
    const auto found = first_crossing(c, zeros_bound(c));
    ASSERT_EQ(found.has_value(), expected > 0) << trial;
    // Coefficients below 30 at t < 3: values rounded to 1e-13; the slope is at least 0.1^3 there.
    EXPECT_NEAR(found.value_or(expected), expected, 1e-10);
  }
}

TEST(ConstraintEvents, OfParabolasAndSpheresAreOnTheSphereAndTheFirstOnes) {
  Random random(42);
  int entered = 0, left = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 centre = random.vector(1);
    const double radius = random.in(0.3, 1.5);
    const Flight flight{centre + random.vector(2), random.vector(3), random.vector(5)};
    const bool inside = (flight.p_W - centre).norm() < radius;
    const auto time =
        inside ? flight_leaves_sphere(flight, centre, radius) : flight_enters_sphere(flight, centre, radius);
    (inside ? left : entered) += time.has_value();
    const double end = time.value_or(4);
    // Every look before stays on its own side.
    for (int k = 1; k < 200; ++k) {
      const Flight then = after(flight, end * k / 200);
      EXPECT_EQ((then.p_W - centre).norm() < radius, inside) << trial;
    }
    if (!time) {
      EXPECT_FALSE(inside);  // an accelerated particle leaves every ball
      continue;
    }
    const Flight there = after(flight, *time);
    const Vec3 r = there.p_W - centre;
    // The time is exact to the rounding of the quartic over its slope: in distance, the rounding of coordinates.
    const double rounding = 100 * kEps * (1 + flight.v_W.norm() * end + 3 * end * end) * (1 + r.norm());
    EXPECT_NEAR(r.norm(), radius, rounding) << trial;
    EXPECT_EQ(r.dot(there.v_W) > 0, inside);
  }
  EXPECT_GT(entered, 100);
  EXPECT_GT(left, 100);
}

TEST(ConstraintEvents, ReboundTurnsOnlyTheApproachRound) {
  EXPECT_EQ(rebound(Vec3(1, 2, -4), Vec3::UnitZ(), 0.5), Vec3(1, 2, 2));
  EXPECT_EQ(rebound(Vec3(1, 2, 4), Vec3::UnitZ(), 0.5), Vec3(1, 2, 4));
  EXPECT_EQ(rebound(Vec3(1, 2, -4), Vec3::UnitZ(), 0), Vec3(1, 2, 0));
}

TEST(BoundedCoordinate, BouncesBetweenItsLimitsAtTheTimesOfTheEquations) {
  // Without acceleration, x in [0, 100] from 20 with 10 m/s: at 8 s, then each 100/(10 e^k) later.
  const double e = 0.8;
  BoundedCoordinate x(0, 100, e, 20, 10, 0);
  x.advance_to(100);
  double time = 8, speed = 10;
  for (const LimitImpact& impact : x.impacts()) {
    EXPECT_NEAR(impact.time, time, 1e-12);
    EXPECT_NEAR(impact.approach, speed, 1e-13);
    speed *= e;
    time += 100 / speed;
  }
  EXPECT_EQ(x.impacts().size(), 5u);  // at 8, 20.5, 36.1, 55.7, 80.1 s
  EXPECT_TRUE(x.impacts()[0].at_high);
  EXPECT_FALSE(x.impacts()[1].at_high);
}

TEST(BoundedCoordinate, ComesToRestWhenTheSeriesOfItsBouncesEnds) {
  // Dropped from h: first impact t0 = sqrt(2h/g), rest at t0 (1 + e)/(1 - e).
  const double h = 1, g = 9.81, t0 = std::sqrt(2 * h / g);
  for (const double e : {0.0, 0.2, 0.5, 0.9}) {
    BoundedCoordinate x(0, std::numeric_limits<double>::infinity(), e, h, 0, -g);
    x.advance_to(100);
    EXPECT_TRUE(x.rests());
    EXPECT_NEAR(x.rest_time(), t0 * (1 + e) / (1 - e), 1e-12) << e;
    EXPECT_EQ(x.position(), 0);
    EXPECT_EQ(x.velocity(), 0);
    for (std::size_t k = 0; k < x.impacts().size(); ++k) {
      const double power = std::pow(e, static_cast<double>(k));
      EXPECT_NEAR(x.impacts()[k].time, e == 0 ? t0 : t0 * (1 + 2 * e * (1 - power) / (1 - e)), 1e-12);
      EXPECT_NEAR(x.impacts()[k].approach, power * std::sqrt(2 * g * h), 1e-12);
    }
  }
  // Published for e = 1/2: 1.354570923 s.
  BoundedCoordinate x(0, 10, 0.5, h, 0, -g);
  x.advance_to(2);
  EXPECT_NEAR(x.rest_time(), 1.354570923, 5e-10);
}

TEST(BoundedCoordinate, NeverRestsWhenElastic) {
  const double period = 2 * std::sqrt(2 / 9.81);
  BoundedCoordinate x(0, 10, 1, 1, 0, -9.81);
  x.advance_to(1000 * period);
  EXPECT_FALSE(x.rests());
  EXPECT_EQ(x.impacts().size(), 1000u);
  // Energy is kept to 1000 roundings, and so the apex; times add 1000 roundings of up to 900 s.
  EXPECT_NEAR(x.position(), 1, 1e-9);
  EXPECT_NEAR(x.impacts().back().time, 999.5 * period, 1e-10);
}

TEST(BoundedCoordinate, RefusesNonsense) {
  EXPECT_THROW(BoundedCoordinate(1, 0, 0, 0, 0, 0), std::invalid_argument);
  EXPECT_THROW(BoundedCoordinate(0, 1, 0, 2, 0, 0), std::invalid_argument);
  EXPECT_THROW(BoundedCoordinate(0, 1, 1.1, 0.5, 0, 0), std::invalid_argument);
  EXPECT_THROW(BoundedCoordinate(0, 1, 1, 0.5, std::numeric_limits<double>::quiet_NaN(), 0), std::invalid_argument);
  BoundedCoordinate x(0, 1, 1, 0.5, 0, 0);
  x.advance_to(1);
  EXPECT_THROW(x.advance_to(0.5), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
