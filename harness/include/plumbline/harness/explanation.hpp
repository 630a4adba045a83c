// Explained errors: which numerical scheme does a trajectory follow?
#pragma once

#include <string>
#include <vector>

#include "plumbline/core/run_result.hpp"
#include "plumbline/core/scenario.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

struct SchemeTrajectory {
  std::string scheme;
  Trajectory trajectory;
};

// The trajectories of the candidate schemes that the core can compute for that scenario; empty when it cannot.
std::vector<SchemeTrajectory> scheme_trajectories(const Scenario& scenario, double dt);

// The closest of them. `error` is the run's largest distance from the reference [m]; `floor` the distance [m] that
// rounding alone explains: an error below it is nobody's fault and gets no explanation.
Explanation explain(const Trajectory& actual, const std::vector<SchemeTrajectory>& candidates, double error,
                    double floor, bool in_plane);

}  // namespace plumbline
