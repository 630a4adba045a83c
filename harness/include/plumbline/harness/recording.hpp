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
  std::optional<Bracket> critical;           // where the answer to the scenario's question changes, if it has one
};

// Runs scenario.step_count(dt) steps of dt [s]. Force laws, drives, and springs that the engine does not compute itself
// are evaluated once at the beginning of each step, on the state the engine reports. Throws what the engine throws.
// For a scenario with a threshold the run is repeated with other values of its parameter until the bracket is as narrow
// as asked; the trajectory is then the last one whose answer was yes (or the last of all), the time that of all runs.
Recording record(const Engine& engine, const Scenario& scenario, const Settings& settings, double dt);

}  // namespace plumbline
