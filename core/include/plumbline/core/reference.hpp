// The truth that trajectories are measured against.
#pragma once

#include <string_view>

#include "plumbline/core/trajectory.hpp"

namespace plumbline {

class Reference {
 public:
  virtual ~Reference() = default;
  // State of a body at time t [s], t >= 0.
  virtual BodyState at(std::size_t body, double t) const = 0;
  // Bound on the error of each position component, relative to the scenario's length scale.
  virtual double uncertainty() const = 0;
  virtual std::string_view citation() const = 0;
  // "closed_form", ...: where the truth comes from.
  virtual std::string_view kind() const = 0;
  // How uncertainty() was obtained, in a few words.
  virtual std::string_view bound_source() const = 0;
};

// The reference at the sample times of a run, so that a dozen metrics evaluate it once.
Trajectory sample(const Reference& reference, std::size_t bodies, double dt, std::size_t samples);

}  // namespace plumbline
