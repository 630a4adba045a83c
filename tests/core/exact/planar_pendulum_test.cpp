#include "plumbline/core/exact/planar_pendulum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "independent_check.hpp"

namespace plumbline {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(PlanarPendulum, MatchesThePublishedSwing) {
  // IFToMM A01: l = 1 m, from the horizontal, g = 9.81.
  const PlanarPendulum pendulum(std::sqrt(9.81), {kPi / 2, 0});
  EXPECT_NEAR(pendulum.period(), 2.367841947576, 1e-12);
  const double angle = pendulum.at(1).angle;
  // The published one starts on the other side.
  EXPECT_NEAR(std::abs(std::sin(angle)), 0.98629175, 1e-8);
  EXPECT_NEAR(-std::cos(angle), -0.16501086, 1e-8);
}

TEST(PlanarPendulum, PeriodGrowsAsPublished) {
  const double small = 2 * kPi;
  const double ratios[][2] = {{5, 1.000476172}, {90, 1.180340599}, {170, 2.439362720}};
  for (const auto& [degrees, ratio] : ratios) {
    EXPECT_NEAR(PlanarPendulum(1, {degrees * kPi / 180, 0}).period() / small, ratio, 1e-9);
  }
}

TEST(PlanarPendulum, SatisfiesItsEquation) {
  std::mt19937_64 bits(1);
  for (int k = 0; k < 500; ++k) {
    const double w0 = 0.5 + uniform(bits);
    const PlanarPendulum pendulum(w0, {10 * uniform(bits) - 5, 6 * uniform(bits) - 3});
    const double t = 20 * uniform(bits) - 10;
    const auto both = [&](double x) {
      const PendulumState s = pendulum.at(x);
      return Eigen::Vector2d(s.angle, s.rate);
    };
    const Eigen::Vector2d here = both(t), slope = derivative(both, t, 0.02);
    // h = 0.02: truncation < 0.02^8 x 9!/630 x 10 = 1e-10 for poles at 1/w0 and more; rounding 1e-14/0.02.
    EXPECT_NEAR(slope(0), here(1), 1e-10);
    EXPECT_NEAR(slope(1), -w0 * w0 * std::sin(here(0)), 1e-10);
  }
}

TEST(PlanarPendulum, StartsWhereItIsPutAndKeepsItsEnergy) {
  std::mt19937_64 bits(2);
  for (int k = 0; k < 2000; ++k) {
    const PendulumState start{14 * uniform(bits) - 7, 8 * uniform(bits) - 4};
    const PlanarPendulum pendulum(1, start);
    EXPECT_NEAR(pendulum.at(0).angle, start.angle, 2e-14);
    EXPECT_NEAR(pendulum.at(0).rate, start.rate, 2e-14);
    const PendulumState later = pendulum.at(100 * uniform(bits));
    const auto energy = [](const PendulumState& s) { return 0.5 * s.rate * s.rate - std::cos(s.angle); };
    EXPECT_NEAR(energy(later), energy(start), 2e-13);  // angles to 400 rad, rounded by 1e-13
  }
}

TEST(PlanarPendulum, RepeatsAfterItsPeriod) {
  const PlanarPendulum swing(1, {2, 0.5}), rotation(1, {2, -3});
  EXPECT_NEAR(swing.at(swing.period() + 0.3).angle, swing.at(0.3).angle, 1e-14);
  EXPECT_TRUE(rotation.rotates());
  EXPECT_NEAR(rotation.at(rotation.period() + 0.3).angle, rotation.at(0.3).angle - 2 * kPi, 1e-14);
}

TEST(PlanarPendulum, CreepsTowardsTheTopOnTheSeparatrix) {
  // From hanging with rate 2 w0: sin(theta/2) = tanh(w0 t).
  const PlanarPendulum pendulum(1, {0, 2}), back(1, {0, -2});
  EXPECT_TRUE(std::isinf(pendulum.period()));
  EXPECT_NEAR(pendulum.at(3).angle, 2 * std::atan(std::sinh(3.0)), 4e-15);
  EXPECT_NEAR(back.at(3).angle, -2 * std::atan(std::sinh(3.0)), 4e-15);
  // A little less and a little more energy: the same motion as long as it does not come near the top.
  EXPECT_NEAR(PlanarPendulum(1, {0, 2 - 1e-13}).at(3).angle, pendulum.at(3).angle, 1e-11);
  EXPECT_NEAR(PlanarPendulum(1, {0, 2 + 1e-13}).at(3).angle, pendulum.at(3).angle, 1e-11);
}

TEST(PlanarPendulum, FallsFromNextToTheTop) {
  // 1e-8 from the top: theta = pi - 1e-8 cosh(w0 t) as long as that is small.
  const PlanarPendulum pendulum(1, {kPi - 1e-8, 0});
  const double left = 1e-8;
  EXPECT_NEAR((kPi - pendulum.at(5).angle) / (left * std::cosh(5.0)), 1, 1e-7);  // pi itself is rounded by 1e-16
}

TEST(PlanarPendulum, RefusesWhatIsNone) {
  EXPECT_THROW(PlanarPendulum(0, {}), std::invalid_argument);
  EXPECT_THROW(PlanarPendulum(1, {std::nan(""), 0}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
