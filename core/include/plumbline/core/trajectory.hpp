// Recorded motion: every body at every step, in one contiguous buffer.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "plumbline/core/state.hpp"

namespace plumbline {

// Sample k belongs to t = k dt; sample 0 is the initial state. States are ordered by sample, then by body.
class Trajectory {
 public:
  Trajectory() = default;
  Trajectory(double dt, std::size_t bodies) : dt_(dt), bodies_(bodies) {}

  double dt() const { return dt_; }
  std::size_t bodies() const { return bodies_; }
  std::size_t samples() const { return bodies_ == 0 ? 0 : states_.size() / bodies_; }
  double time(std::size_t sample) const { return static_cast<double>(sample) * dt_; }

  const BodyState& at(std::size_t sample, std::size_t body) const { return states_[sample * bodies_ + body]; }
  BodyState& at(std::size_t sample, std::size_t body) { return states_[sample * bodies_ + body]; }

  // Room for that many samples, touched now so that no page fault falls into the stepping loop.
  void reserve(std::size_t samples);
  // Appends one sample and returns its block of `bodies()` states to fill.
  std::span<BodyState> append();

  std::span<const BodyState> states() const { return states_; }

 private:
  double dt_ = 0;
  std::size_t bodies_ = 0;
  std::vector<BodyState> states_;
};

}  // namespace plumbline
