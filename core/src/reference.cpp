#include "plumbline/core/reference.hpp"

namespace plumbline {

Trajectory sample(const Reference& reference, std::size_t bodies, double dt, std::size_t samples) {
  Trajectory result(dt, bodies);
  result.reserve(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const auto states = result.append();
    for (std::size_t b = 0; b < bodies; ++b) states[b] = reference.at(b, result.time(k));
  }
  return result;
}

}  // namespace plumbline
