#include "plumbline/core/exact/falling_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "plumbline/core/integration/dormand_prince.hpp"

namespace plumbline {
namespace {

constexpr std::size_t kIntervals = 64;

}  // namespace

FallingLadder::FallingLadder(double length, double thickness, double inertia_over_mass, double gravity, double angle,
                             double duration)
    : reach_(0.5 * std::hypot(length, thickness)),
      delta_(std::atan2(thickness, length)),
      inertia_(inertia_over_mass),
      gravity_(gravity),
      leaving_time_(std::numeric_limits<double>::infinity()),
      interval_(duration / kIntervals) {
  constexpr double kFlat = std::numbers::pi / 2;
  if (!(length > thickness && thickness >= 0 && inertia_ > 0 && gravity > 0 && duration > 0 && angle > 0 &&
        angle < kFlat && std::isfinite(length * inertia_ * gravity * duration))) {
    throw std::invalid_argument(
        "a ladder needs length > thickness >= 0, inertia and gravity > 0, 0 < angle < pi/2 and a duration > 0");
  }
  start_ << angle, 0, reach_ * std::sin(angle + delta_), 0;
  leaving_ = start_;
  before_.push_back(start_);
  for (std::size_t k = 1; k <= kIntervals; ++k) {
    const double t0 = static_cast<double>(k - 1) * interval_, t1 = static_cast<double>(k) * interval_;
    const State next = advance(t0, before_.back(), t1, true);
    if (push_of_wall(next) < 0) {
      double low = t0, high = t1;  // the push falls through zero between these
      for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high)) {
        (push_of_wall(advance(t0, before_.back(), middle, true)) < 0 ? high : low) = middle;
      }
      leaving_time_ = high;
      leaving_ = advance(t0, before_.back(), high, true);
      break;
    }
    before_.push_back(next);
  }
  after_.push_back(leaving_);
  for (double t = leaving_time_; t < duration; t += interval_) {
    after_.push_back(advance(0, after_.back(), interval_, false));
  }
  if (!(state_at(duration)(0) < kFlat)) {
    throw std::invalid_argument("the ladder lies flat before the end; shorten the duration");
  }
}

FallingLadder::State FallingLadder::rates(const State& y, bool at_wall) const {
  const double x_theta = reach_ * std::cos(y(0) + delta_), z_theta = -reach_ * std::sin(y(0) - delta_);
  const double x_bend = -reach_ * std::sin(y(0) + delta_), z_bend = -reach_ * std::cos(y(0) - delta_);
  const double wall = at_wall ? 1 : 0, square = y(1) * y(1);
  const double mass = wall * x_theta * x_theta + z_theta * z_theta + inertia_;
  const double turn = -(gravity_ * z_theta + (wall * x_theta * x_bend + z_theta * z_bend) * square) / mass;
  return {y(1), turn, y(3), wall * (x_theta * turn + x_bend * square)};
}

double FallingLadder::push_of_wall(const State& y) const { return rates(y, true)(3); }

FallingLadder::State FallingLadder::advance(double from, const State& y, double to, bool at_wall) const {
  if (to == from) return y;
  DormandPrince<State> solver({.relative = 1e-15, .absolute = 1e-15});
  solver.start(from, y);
  solver.advance_to([&](double, const State& now, State& slope) { slope = rates(now, at_wall); }, to);
  return solver.state();
}

FallingLadder::State FallingLadder::state_at(double t) const {
  const bool at_wall = t <= leaving_time_;
  const double since = at_wall ? t : t - leaving_time_;
  const auto& nodes = at_wall ? before_ : after_;
  const auto node = std::min(static_cast<std::size_t>(since / interval_), nodes.size() - 1);
  return advance(static_cast<double>(node) * interval_, nodes[node], since, at_wall);
}

LadderState FallingLadder::at(double t) const {
  if (!(t >= 0 && t <= interval_ * (kIntervals + 1))) throw std::invalid_argument("t lies outside the ladder's fall");
  const State y = state_at(t);
  const double vz = -reach_ * std::sin(y(0) - delta_) * y(1);
  return {y(0), y(1), y(2), reach_ * std::cos(y(0) - delta_), y(3), vz};
}

}  // namespace plumbline
