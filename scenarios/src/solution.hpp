// References that are named solutions, written in C++ because no short expression states them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// A solution reads all it needs from the scenario itself, so that a file cannot contradict it.
struct Solution {
  std::string_view name;
  std::string_view citation;
  // Throws std::invalid_argument, with the reason, for a scenario that it does not solve.
  std::shared_ptr<const Reference> (*solve)(const Scenario& scenario, std::string citation);
};

// The whole table.
const std::vector<Solution>& solutions();

}  // namespace plumbline
