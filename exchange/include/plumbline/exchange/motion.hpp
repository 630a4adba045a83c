// A motion to hand out: the exact one of a reference, or one that a run has recorded.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

struct Motion {
  std::string title;               // "particle/drag_ship/v0=0, exact, closed_form"
  std::string source;              // citation, or the file that it was read from
  std::vector<std::string> names;  // of the bodies
  std::vector<double> times;       // of the samples [s]
  std::vector<BodyState> states;   // by sample, then by body

  const BodyState& at(std::size_t sample, std::size_t body) const { return states[sample * names.size() + body]; }
};

// The exact motion at 0, dt, 2 dt, ... up to the duration, a step that misses by rounding included. Throws
// std::invalid_argument where the reference does not know the motion, or knows it at some times only.
Motion exact_motion(const Scenario& scenario, const Reference& reference, double dt);

// Reads what runs write: t,body,x,y,z,qw,...; a row per sample and body. Throws std::invalid_argument, "file:line:
// ...".
Motion read_motion_csv(const std::filesystem::path& file);

}  // namespace plumbline
