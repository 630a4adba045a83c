#include "plumbline/harness/recording.hpp"

#include <algorithm>
#include <chrono>

namespace plumbline {

Recording record(const Engine& engine, const Scenario& scenario, const Settings& settings, double dt) {
  const auto world = engine.build(scenario, settings);
  const std::size_t steps = scenario.step_count(dt);

  Recording result;
  result.trajectory = Trajectory(dt, scenario.bodies.size());
  Trajectory& trajectory = result.trajectory;
  trajectory.reserve(steps + 1);
  std::vector<Wrench> wrenches(scenario.bodies.size());

  // The first sample is what the engine says, not what the scenario says: an adapter that sets a state wrongly shows.
  world->read(trajectory.append());
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < steps; ++k) {
    if (!scenario.forces.empty()) {
      evaluate_forces(scenario, trajectory.time(k), trajectory.states().last(scenario.bodies.size()), wrenches);
      world->apply(wrenches);
    }
    world->step(dt);
    const auto states = trajectory.append();
    world->read(states);
    if (!std::all_of(states.begin(), states.end(), is_finite)) {
      result.not_finite_at = k + 1;
      break;
    }
  }
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace plumbline
