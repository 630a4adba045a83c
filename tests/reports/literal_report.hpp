// Reports and motions written down by hand, for the tests of every reporter.
#pragma once

#include "plumbline/core/run_result.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline::testing {

// Three cases on three engines under both profiles; every verdict, NaN and infinity, and names that a careless
// writer would trip over.
Report literal_report();

// As large as a full comparison: 7 engines, 2 profiles, 11 cases, 4 dt's, curves of 200 points.
Report large_report();

// Two bodies, three samples, the second body with a hostile name and numbers that are none.
Scenario two_body_scenario();
Trajectory two_body_trajectory();

}  // namespace plumbline::testing
