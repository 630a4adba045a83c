// One run in this process: build the world, step it, record every state.
#pragma once

#include <optional>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

struct Recording {
  Trajectory trajectory;
  double wall_seconds = 0;                   // stepping and reading; building the world is not counted
  std::optional<std::size_t> not_finite_at;  // first sample with a NaN or infinity; the trajectory ends there
};

// Runs scenario.step_count(dt) steps of dt [s]. Force laws are evaluated once at the beginning of each step, on the
// state the engine reports. Throws what the engine throws.
Recording record(const Engine& engine, const Scenario& scenario, const Settings& settings, double dt);

}  // namespace plumbline
