#include "plumbline/harness/recording.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plumbline {

namespace {

Recording record_motion(const Engine& engine, const Scenario& scenario, const Settings& settings, double dt) {
  const auto world = engine.build(scenario, settings);
  const std::size_t steps = scenario.step_count(dt);

  Recording result;
  result.trajectory = Trajectory(dt, scenario.bodies.size());
  Trajectory& trajectory = result.trajectory;
  trajectory.reserve(steps + 1);
  std::vector<Wrench> wrenches(scenario.bodies.size());
  const FeatureSet& native = engine.info().features;
  const bool pushed = has_forces(scenario, native);

  // The first sample is what the engine says, not what the scenario says: an adapter that sets a state wrongly shows.
  world->read(trajectory.append());
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < steps; ++k) {
    if (pushed) {
      evaluate_forces(scenario, trajectory.time(k), trajectory.states().last(scenario.bodies.size()), wrenches, native);
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

// Bisection. An engine whose answer is the same at both ends of the range has its critical value beyond one of them:
// the bracket is then that end, on the side where the answer fits the truth's order.
Recording search(const Engine& engine, const Scenario& scenario, const Settings& settings, double dt) {
  const Threshold& threshold = *scenario.threshold;
  Recording shown;
  double spent = 0;
  bool shown_is_yes = false;
  const auto ask = [&](double value) {
    Recording run = record_motion(engine, *threshold.with(value), settings, dt);
    spent += run.wall_seconds;
    // A run that leaves the numbers is no answer: it must show as what it is.
    const bool yes = !run.not_finite_at && threshold.answer(run.trajectory);
    if (yes || !shown_is_yes || run.not_finite_at) shown = std::move(run);
    shown_is_yes = shown_is_yes || yes;
    return yes;
  };
  double no = threshold.exact_above ? threshold.low : threshold.high;
  double yes = threshold.exact_above ? threshold.high : threshold.low;
  Bracket bracket{no, yes};
  if (ask(no)) {
    bracket = {no, no};
  } else if (!shown.not_finite_at && !ask(yes)) {
    bracket = {yes, yes};
  } else {
    while (std::abs(yes - no) > threshold.resolution && !shown.not_finite_at) {
      const double middle = no + 0.5 * (yes - no);
      if (middle == no || middle == yes) break;
      (ask(middle) ? yes : no) = middle;
    }
    bracket = {no, yes};
  }
  shown.critical = bracket;
  shown.wall_seconds = spent;
  return shown;
}

}  // namespace

Recording record(const Engine& engine, const Scenario& scenario, const Settings& settings, double dt) {
  return scenario.threshold ? search(engine, scenario, settings, dt) : record_motion(engine, scenario, settings, dt);
}

}  // namespace plumbline
