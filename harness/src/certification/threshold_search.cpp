// The critical value of a yes/no question, by bisection on the core's own motion.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plumbline/core/integration/integrated_reference.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "second_sources.hpp"

namespace plumbline {
namespace {

// A pile costs the square of its bodies.
double steps_for(const Scenario& scenario) {
  const auto moving =
      std::count_if(scenario.bodies.begin(), scenario.bodies.end(), [](const Body& body) { return !body.fixed; });
  return std::clamp(1600.0 / static_cast<double>(moving * moving), 100.0, 400.0);
}

// Only the states at the end are asked for.
Trajectory last_state(const Scenario& scenario, double dt) {
  if (!is_smooth(scenario)) return simulated(scenario, dt, SimulatorOptions{}.contact_tolerance);
  const IntegratedReference motion(scenario, "", 1e-10);
  return sample(motion, scenario.bodies.size(), scenario.duration, 2);
}

struct Search {
  double middle = 0;
  bool changes = false;  // the answer differs at the ends of the range, the right way round
};

// In a range at whose ends the answers differ.
Search search(const Scenario& scenario, double steps, double low, double high) {
  const Threshold& threshold = *scenario.threshold;
  const auto ask = [&](double value) {
    const auto with = threshold.with(value);
    return threshold.answer(last_state(*with, with->duration / steps));
  };
  double no = threshold.exact_above ? low : high;
  double yes = threshold.exact_above ? high : low;
  if (ask(no) || !ask(yes)) return {};
  while (std::abs(yes - no) > threshold.resolution) {
    const double middle = 0.5 * (no + yes);
    (ask(middle) ? yes : no) = middle;
  }
  return {0.5 * (no + yes), true};
}

// What the file itself grants for asking a question that can be answered within the duration.
double granted(const Scenario& scenario, double dt) {
  for (const Gate& gate : scenario.gates) {
    if (gate.metric != "threshold.error") continue;
    return gate.limit({dt, static_cast<double>(scenario.step_count(dt)), 0x1p-53});
  }
  return 0;
}

}  // namespace

void check_threshold(const Scenario& scenario, Certification& result) {
  const Threshold& threshold = *scenario.threshold;
  try {
    const auto problem = threshold.with(threshold.exact);
    const auto why = is_smooth(*problem) ? std::nullopt : why_not_simulated(*problem);
    if (why) {
      result.left_out.push_back("threshold: " + *why);
      return;
    }
    const double steps = steps_for(*problem), low = threshold.low, high = threshold.high;
    const Search coarse = search(scenario, steps, low, high);
    Search fine = coarse;
    if (!is_smooth(*problem) && coarse.changes) {
      const double room = 2 * threshold.resolution;  // most often the second answer is next to the first
      fine = search(scenario, 2 * steps, std::max(low, coarse.middle - room), std::min(high, coarse.middle + room));
      if (!fine.changes) fine = search(scenario, 2 * steps, low, high);
    }
    const double apart = std::abs(coarse.middle - fine.middle);
    const double bound = std::max(threshold.resolution + apart, granted(scenario, scenario.duration / (2 * steps)));
    const bool found = coarse.changes && fine.changes;
    result.rows.push_back({"threshold",
                           threshold.parameter + " at which '" + threshold.question + "' changes in the core's motion",
                           found ? std::abs(fine.middle - threshold.exact) : std::nan(""),
                           bound,
                           true,
                           {}});
  } catch (const std::exception& e) {
    result.left_out.push_back(std::string("threshold: ") + e.what());
  }
}

}  // namespace plumbline
