#include "plumbline/core/exact/zeno_ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline {

ZenoBall::ZenoBall(double height, double restitution, double gravity)
    : height_(height), e_(restitution), gravity_(gravity), fall_(std::sqrt(2 * height / gravity)) {
  if (!(height > 0 && gravity > 0 && std::isfinite(height) && std::isfinite(gravity) && e_ >= 0 && e_ <= 1)) {
    throw std::invalid_argument("a bouncing ball needs height > 0, gravity > 0 and a restitution in [0, 1]");
  }
}

double ZenoBall::impact_time(std::int64_t n) const {
  if (n < 0) throw std::invalid_argument("impacts count from 0");
  const double count = static_cast<double>(n);
  if (e_ == 1) return fall_ * (1 + 2 * count);
  if (e_ == 0) return fall_;
  // 1 - e^n by expm1: for e close to 1 the difference would have few digits.
  return fall_ * (1 + 2 * e_ * -std::expm1(count * std::log(e_)) / (1 - e_));
}

double ZenoBall::apex_height(std::int64_t n) const {
  if (n < 0) throw std::invalid_argument("impacts count from 0");
  return height_ * std::pow(e_, 2 * static_cast<double>(n + 1));
}

double ZenoBall::stop_time() const { return fall_ * (1 + e_) / (1 - e_); }

double ZenoBall::path_length() const { return height_ * (1 + e_ * e_) / ((1 - e_) * (1 + e_)); }

ZenoState ZenoBall::at(double t) const {
  if (!(t >= 0)) throw std::invalid_argument("the ball is dropped at t = 0; there is no earlier state");
  if (t < fall_) return {height_ - 0.5 * gravity_ * t * t, -gravity_ * t, 0};
  if (t >= stop_time()) return {0, 0, -1};
  // t_n is solved for n, and rounding put right by comparison with the times themselves.
  const double guess =
      e_ == 1 ? 0.5 * (t / fall_ - 1) : std::log((stop_time() - t) / (stop_time() - fall_)) / std::log(e_);
  auto n = static_cast<std::int64_t>(std::max(0.0, std::floor(guess)));
  while (n > 0 && t < impact_time(n)) --n;
  while (t >= impact_time(n + 1) && impact_time(n + 1) > impact_time(n)) ++n;
  const double up = gravity_ * fall_ * std::pow(e_, static_cast<double>(n + 1)), since = t - impact_time(n);
  return {std::max(0.0, since * (up - 0.5 * gravity_ * since)), up - gravity_ * since, n + 1};
}

}  // namespace plumbline
