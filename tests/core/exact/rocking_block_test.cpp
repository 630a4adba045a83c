#include "plumbline/core/exact/rocking_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "independent_check.hpp"

namespace plumbline {
namespace {

// A homogeneous block of half-width 0.1 m and half-height 0.4 m, which starts at 0.4 of the tilt at which it falls
// over.
struct Slender {
  double alpha = std::atan(0.25), p = std::sqrt(3 * 9.81 / (4 * std::hypot(0.1, 0.4)));
  double ratio = 1 - 1.5 * std::pow(std::sin(alpha), 2);
  RockingBlock block(double duration) const { return {p, alpha, ratio, 0.4 * alpha, duration}; }
};

TEST(RockingBlock, StrikesWhenTheQuadratureSaysSo) {
  const Slender s;
  EXPECT_NEAR(s.ratio, 0.911765, 5e-7);  // published, six digits
  const RockingBlock block = s.block(0.75);
  ASSERT_EQ(block.impacts().size(), 2U);
  // The energy integral by quadrature with 30 digits.
  EXPECT_NEAR(block.impacts()[0], 0.260659962680012824, 2e-14);
  EXPECT_NEAR(block.impacts()[1], 0.701178254753574519, 4e-14);
  EXPECT_NEAR(block.at(0.480919108716793671).tilt, -0.077446404349804404, 1e-14);
}

TEST(RockingBlock, FallsInTheTimeOfHousnerForSmallAngles) {
  // sin(x) = x is off by alpha^2/6 of the acceleration.
  const double alpha = 1e-3, p = 2;
  const RockingBlock block(p, alpha, 1, 0.3 * alpha, 1);
  EXPECT_NEAR(block.impacts().at(0), std::acosh(1 / 0.7) / p, alpha * alpha / 6);
}

TEST(RockingBlock, SatisfiesItsEquationBetweenImpacts) {
  const Slender s;
  const RockingBlock block = s.block(0.75);
  const auto both = [&](double t) {
    const RockingState now = block.at(t);
    return Eigen::Vector2d(now.tilt, now.rate);
  };
  int checked = 0;
  for (double t = 0.02; t < 0.73; t += 0.01) {
    if (std::abs(t - block.impacts()[0]) < 0.01 || std::abs(t - block.impacts()[1]) < 0.01) continue;
    const Eigen::Vector2d slope = derivative(both, t, 0.002), now = both(t);
    const double side = block.at(t).impacts % 2 == 0 ? 1 : -1;
    // Rounding 1e-15/0.002; the ninth derivative is about p^9 = 4e5, times 0.002^8/630 far less.
    EXPECT_NEAR(slope(0), now(1), 1e-11);
    EXPECT_NEAR(slope(1), -side * s.p * s.p * std::sin(s.alpha - side * now(0)), 1e-11);
    ++checked;
  }
  EXPECT_GT(checked, 60);
}

TEST(RockingBlock, LosesTheRatioAtEveryImpactAndKeepsTurningTheSameWay) {
  const Slender s;
  const RockingBlock block = s.block(2);
  ASSERT_GT(block.impacts().size(), 5U);
  double amplitude = 0.4 * s.alpha;
  for (const double t : block.impacts()) {
    const RockingState before = block.at(t - 1e-11), after = block.at(t);
    EXPECT_NEAR(after.rate / before.rate, s.ratio, 1e-9);
    EXPECT_NEAR(after.tilt, 0, 1e-13);
    EXPECT_EQ(after.impacts, before.impacts + 1);
    // Energy before the impact is that of the last turning point.
    const double energy = s.p * s.p * (std::cos(s.alpha - amplitude) - std::cos(s.alpha));
    EXPECT_NEAR(0.5 * before.rate * before.rate, energy, 1e-9);
    amplitude = s.alpha - std::acos(std::cos(s.alpha) + s.ratio * s.ratio * energy / (s.p * s.p));
  }
}

TEST(RockingBlock, WithoutLossComesBack) {
  const RockingBlock block(3, 0.3, 1, -0.1, 20);
  const double quarter = block.impacts().at(0);
  EXPECT_NEAR(block.at(4 * quarter).tilt, -0.1, 1e-13);
  EXPECT_NEAR(block.at(2 * quarter).tilt, 0.1, 1e-13);
  EXPECT_NEAR(block.at(16 * quarter).rate, 0, 1e-12);
}

TEST(RockingBlock, RefusesWhatItCannotSolve) {
  EXPECT_THROW(RockingBlock(1, 0.2, 0.9, 0.2, 1), std::invalid_argument);  // falls over
  EXPECT_THROW(RockingBlock(1, 0.2, 0.9, 0, 1), std::invalid_argument);    // stands
  EXPECT_THROW(RockingBlock(1, 0.2, 1.1, 0.1, 1), std::invalid_argument);
  EXPECT_THROW(RockingBlock(1, 0.2, 0.9, std::nan(""), 1), std::invalid_argument);
  EXPECT_THROW(RockingBlock(4, 0.2, 0.5, 0.1, 100), std::invalid_argument);  // comes to rest before
}

}  // namespace
}  // namespace plumbline
