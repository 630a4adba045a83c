// The joints of a scenario file.
#pragma once

#include <vector>

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// [[joint]]: kind, the two bodies, and where it holds them at the start. Throws ScenarioError for joints that do not
// hold in the initial velocities.
std::vector<Joint> read_joints(const Node& root, const Parameters& constants, const Scenario& scenario);

}  // namespace plumbline
