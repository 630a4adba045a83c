#include "plumbline/core/trajectory.hpp"

namespace plumbline {

void Trajectory::reserve(std::size_t samples) {
  const std::size_t filled = states_.size();
  states_.resize(samples * bodies_);  // writes every page once: the first touch of a page costs microseconds
  states_.resize(filled);             // the capacity stays
}

std::span<BodyState> Trajectory::append() {
  const std::size_t first = states_.size();
  states_.resize(first + bodies_);
  return std::span(states_).subspan(first, bodies_);
}

}  // namespace plumbline
