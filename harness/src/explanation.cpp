#include "plumbline/harness/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plumbline/core/kinetics/scheme.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {

std::vector<SchemeTrajectory> scheme_trajectories(const Scenario& scenario, double dt) {
  std::vector<SchemeTrajectory> all;
  if (!needs(scenario).without(simulator_features()).empty()) return all;
  for (const Scheme& scheme : candidate_schemes(scenario)) {
    try {
      all.push_back({name(scheme, scenario), simulate(scenario, scheme, dt)});
    } catch (const std::runtime_error&) {
      // A scheme that cannot finish this scenario (too many impacts in a step) explains nobody's error.
    }
  }
  return all;
}

Explanation explain(const Trajectory& actual, const std::vector<SchemeTrajectory>& candidates, double error,
                    double floor, bool in_plane) {
  Explanation best;
  if (!std::isfinite(error) || error <= floor) return best;
  for (const SchemeTrajectory& candidate : candidates) {
    const double distance = position_distance(actual, candidate.trajectory, in_plane);
    if (best.scheme.empty() || distance < best.distance) best = {candidate.scheme, distance, 0};
  }
  if (!best.scheme.empty()) best.share = std::clamp(1 - best.distance / error, 0.0, 1.0);
  return best;
}

}  // namespace plumbline
