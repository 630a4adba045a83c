// The motions with elementary closed forms: ship, bouncing ball, sliding sphere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "independent_check.hpp"
#include "plumbline/core/exact/ship_with_drag.hpp"
#include "plumbline/core/exact/sliding_sphere.hpp"
#include "plumbline/core/exact/zeno_ball.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(ShipWithDrag, SatisfiesItsEquation) {
  const double m = 1000, thrust = 5000, c = 250;
  for (const double v0 : {0.0, 10.0, 30.0}) {
    const ShipWithDrag ship(m, thrust, c, v0);
    EXPECT_EQ(ship.position(0), 0);
    EXPECT_EQ(ship.velocity(0), v0);
    for (const double t : {0.5, 3.0, 20.0}) {
      const auto both = [&](double x) { return Eigen::Vector2d(ship.position(x), ship.velocity(x)); };
      const Eigen::Vector2d slope = derivative(both, t, 0.1);
      // ct/m changes by 0.025 per h: truncation 0.025^8 is nothing; rounding eps 400 m/0.1 s = 1e-12.
      EXPECT_NEAR(slope(0), ship.velocity(t), 1e-11);
      EXPECT_NEAR(m * slope(1), thrust - c * ship.velocity(t), 1e-8);
    }
  }
}

TEST(ShipWithDrag, IsTheSlidesFormula) {
  const double m = 1000, thrust = 5000, c = 250, v0 = 3, t = 12;
  const ShipWithDrag ship(m, thrust, c, v0);
  const double decay = std::exp(-c * t / m);
  EXPECT_NEAR(ship.velocity(t), thrust / c - (thrust / c - v0) * decay, 1e-13);
  EXPECT_NEAR(ship.position(t), thrust / c * t + (thrust / c - v0) * (m / c) * (decay - 1), 1e-12);
  EXPECT_NEAR(ship.velocity(1000), ship.terminal_velocity(), 1e-13);
  EXPECT_EQ(ship.terminal_velocity(), 20);
}

TEST(ShipWithDrag, KeepsItsDigitsWhereTheSlideLosesThem) {
  // Little drag: s = v0 t + a0 t^2/2 - c a0 t^3/(6 m), next term c^2 a0 t^4/(24 m^2) = 4e-18 of the second.
  const double m = 1, thrust = 1, c = 1e-8, t = 1, series = 0.5 - c / 6;
  EXPECT_NEAR(ShipWithDrag(m, thrust, c, 0).position(t), series, kEps);
  const double slide = thrust / c * t + thrust / c * (m / c) * (std::exp(-c * t / m) - 1);
  EXPECT_GT(std::abs(slide - series), 0.01);
  EXPECT_EQ(ShipWithDrag(m, thrust, 0, 2).position(3), 2 * 3 + 0.5 * 9);
  EXPECT_THROW(ShipWithDrag(0, 1, 1, 0), std::invalid_argument);
  EXPECT_THROW(ShipWithDrag(1, 1, -1, 0), std::invalid_argument);
}

TEST(ZenoBall, MatchesThePublishedStop) {
  const ZenoBall ball(1, 0.5, 9.81);
  EXPECT_NEAR(ball.stop_time(), 1.354570923, 1e-9);
  EXPECT_NEAR(ball.path_length(), 5.0 / 3, 4 * kEps);
  EXPECT_EQ(ball.apex_height(0), 0.25);
  EXPECT_EQ(ball.at(1.3546).impacts, -1);
}

TEST(ZenoBall, FliesFromImpactToImpact) {
  // The times, heights and path again, bounce by bounce from the law of free fall alone.
  for (const double e : {0.1, 0.5, 0.9, 0.999}) {
    const double g = 9.81, h = 1.7;
    const ZenoBall ball(h, e, g);
    double t = std::sqrt(2 * h / g), v = g * t, path = h;
    for (int n = 0; n < 60; ++n) {
      EXPECT_NEAR(ball.impact_time(n), t, 64 * kEps * t);
      v *= e;
      EXPECT_NEAR(ball.apex_height(n), v * v / (2 * g), 512 * kEps * h);
      const double middle = t + v / g;
      if (v > 1e-6) {
        EXPECT_EQ(ball.at(middle).impacts, n + 1);
        EXPECT_NEAR(ball.at(middle).height, v * v / (2 * g), 1e-14);
        EXPECT_NEAR(ball.at(middle).velocity, 0, 1e-12);
      }
      t += 2 * v / g;
      path += v * v / g;
    }
    if (e < 0.5) {
      EXPECT_NEAR(ball.stop_time(), t, 1e-14);
      EXPECT_NEAR(ball.path_length(), path, 1e-14);
    }
  }
}

TEST(ZenoBall, NeverStopsWhenElastic) {
  const ZenoBall ball(1, 1, 9.81);
  EXPECT_TRUE(std::isinf(ball.stop_time()));
  EXPECT_NEAR(ball.at(ball.impact_time(1000) + ball.impact_time(0)).height, 1, 1e-10);
  EXPECT_EQ(ZenoBall(1, 0, 9.81).stop_time(), ZenoBall(1, 0, 9.81).impact_time(0));
  EXPECT_THROW(ZenoBall(1, 1.1, 9.81), std::invalid_argument);
  EXPECT_THROW(ZenoBall(0, 0.5, 9.81), std::invalid_argument);
  EXPECT_THROW(ball.at(-1), std::invalid_argument);
}

TEST(SlidingSphere, MatchesThePublishedRoll) {
  const SlidingSphere ball(0.1, 0.3, 9.81, {Vec3::Zero(), Vec3(2, 0, 0), Vec3::Zero()});
  EXPECT_NEAR(ball.rolling_time(), 0.194165332, 1e-9);
  const SphereMotion rolls = ball.at(ball.rolling_time());
  EXPECT_NEAR(rolls.p_WB.x(), 0.332854855, 1e-9);
  EXPECT_NEAR(rolls.v_WB.x(), 10.0 / 7, 4 * kEps);
  EXPECT_NEAR(rolls.w_WB.y(), 10.0 / 7 / 0.1, 64 * kEps);
}

TEST(SlidingSphere, ObeysFrictionAndTorqueOnItsParabola) {
  const double r = 0.2, mu = 0.25, g = 9.81, mass = 3;
  const SlidingSphere ball(r, mu, g, {Vec3(1, 2, r), Vec3(2, 1, 0), Vec3(5, -20, 7)});
  const auto slip = [&](double t) { return (ball.at(t).v_WB - r * ball.at(t).w_WB.cross(Vec3::UnitZ())).eval(); };
  for (const double share : {0.2, 0.5, 0.8}) {
    const double t = share * ball.rolling_time(), h = 0.01 * ball.rolling_time();
    const Vec3 force = -mu * mass * g * slip(t).normalized();
    const Vec3 torque = (-r * Vec3::UnitZ()).cross(force);
    // Linear and quadratic in t: no truncation; rounding eps x 20/h with h > 1e-3.
    EXPECT_LT((derivative([&](double x) { return ball.at(x).p_WB; }, t, h) - ball.at(t).v_WB).norm(), 1e-11);
    EXPECT_LT((mass * derivative([&](double x) { return ball.at(x).v_WB; }, t, h) - force).norm(), 1e-11);
    const Vec3 alpha = derivative([&](double x) { return ball.at(x).w_WB; }, t, h);
    EXPECT_LT((0.4 * mass * r * r * alpha - torque).norm(), 1e-10);
    EXPECT_LT((slip(t).normalized() - ball.slip_velocity().normalized()).norm(), 32 * kEps);
  }
  EXPECT_LT(slip(ball.rolling_time()).norm(), 32 * kEps);
  EXPECT_LT(slip(5).norm(), 32 * kEps);
  EXPECT_EQ(ball.at(5).w_WB.z(), 7);
  // Angular momentum about any point of the track stays: (7/5) v of rolling, from v0 and w0.
  const Vec3 rolling = 5.0 / 7 * Vec3(2, 1, 0) + 2.0 / 7 * r * Vec3(5, -20, 7).cross(Vec3::UnitZ());
  EXPECT_LT((ball.at(9).v_WB - rolling).norm(), 32 * kEps);
}

TEST(SlidingSphere, RollsOnWhenItRolls) {
  const SlidingSphere ball(0.5, 0.3, 9.81, {Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 2, 0)});
  EXPECT_EQ(ball.rolling_time(), 0);
  EXPECT_EQ(ball.at(3).p_WB.x(), 3);
  EXPECT_THROW(SlidingSphere(0.5, 0.3, 9.81, {Vec3::Zero(), Vec3(0, 0, 1), Vec3::Zero()}), std::invalid_argument);
  EXPECT_THROW(SlidingSphere(0.5, 0, 9.81, {}), std::invalid_argument);
  EXPECT_THROW(ball.at(-1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
