// A scenario as a scenario file: numbers only, no parameters, every number in the shortest form that reads back as it
// is.
#pragma once

#include <string>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

// What is said of the world, with comments on top, one a line. Nothing is known of its motion but what mechanics says
// of every world: where nothing takes energy away a gate asks that it stays, and where there are joints that they hold.
// Force laws, drives, thresholds, events and gates of the scenario are not written: their expressions are gone.
std::string scenario_text(const Scenario& scenario, const std::vector<std::string>& comments);

}  // namespace plumbline
