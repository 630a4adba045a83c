#include "plumbline/core/exact/rocking_block.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plumbline {
namespace {

using std::numbers::pi;

constexpr std::size_t kMostImpacts = 1000;

// Time from the turning point to upright. It lies between those of s'' = -p^2 (alpha - s), which is too fast a fall,
// and of the same with sin(alpha)/alpha, which is too slow.
double time_of_fall(const PlanarPendulum& motion, double p, double alpha, double tilt) {
  double low = std::acosh(alpha / (alpha - tilt)) / p;
  double high = low / std::sqrt(std::sin(alpha) / alpha);
  low *= 1 - 1e-12;  // of small tilts both are the same but for rounding
  high *= 1 + 1e-12;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (motion.at(middle).angle > pi - alpha ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The next tilt at rest, s', from cos(alpha - s') = cos(alpha) + gain. The sine of s' is written so that no digits are
// lost when it is small.
double next_turn(double ratio, double alpha, double tilt) {
  const double gain = ratio * ratio * 2 * std::sin(alpha - tilt / 2) * std::sin(tilt / 2);
  const double rise = gain * (2 * std::cos(alpha) + gain);  // cos(alpha - s')^2 - cos(alpha)^2
  const double cosine = std::cos(alpha) + gain, sine = std::sqrt(std::pow(std::sin(alpha), 2) - rise);
  return std::asin(rise / (std::sin(alpha) * cosine + std::cos(alpha) * sine));
}

}  // namespace

RockingBlock::RockingBlock(double p, double alpha, double ratio, double tilt, double duration)
    : alpha_(alpha), side_(tilt < 0 ? -1 : 1) {
  const bool makes_sense = p > 0 && std::isfinite(p) && alpha > 0 && alpha < pi / 2 && ratio > 0 && ratio <= 1 &&
                           std::abs(tilt) > 0 && std::abs(tilt) < alpha && duration >= 0 && std::isfinite(duration);
  if (!makes_sense) {
    throw std::invalid_argument(
        "a rocking block needs p > 0, a tilt between 0 and alpha < 90 degrees, and a ratio in (0, 1]");
  }
  double now = 0, s = std::abs(tilt);
  for (bool first = true; now <= duration; first = false) {
    if (impacts_.size() > kMostImpacts) {
      throw std::invalid_argument(
          "the block comes to rest before the end: its impacts accumulate; shorten the duration");
    }
    const PlanarPendulum motion(p, {pi - alpha + s, 0});
    const double fall = time_of_fall(motion, p, alpha, s);
    swings_.push_back({first ? 0 : now + fall, motion});
    now += first ? fall : 2 * fall;
    impacts_.push_back(now);
    s = next_turn(ratio, alpha, s);
  }
  impacts_.pop_back();
}

RockingState RockingBlock::at(double t) const {
  const auto next = std::upper_bound(impacts_.begin(), impacts_.end(), t);
  const auto done = static_cast<std::size_t>(next - impacts_.begin());
  const Swing& swing = swings_[done];
  const PendulumState state = swing.motion.at(t - swing.turn);
  const double side = done % 2 == 0 ? side_ : -side_;
  return {side * (state.angle - pi + alpha_), side * state.rate, done};
}

}  // namespace plumbline
