// Gates and events, read from a scenario file.
#pragma once

#include <vector>

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// [[event]], sorted by time; those later than the scenario's duration are left out.
std::vector<Event> read_events(const Node& root, const Parameters& constants, const Scenario& scenario);

// [[gate]]. Every limit must be finite and > 0 for each dt of the scenario in single and double precision.
std::vector<Gate> read_gates(const Node& root, const Parameters& constants, const Scenario& scenario);

}  // namespace plumbline
