// Named solutions of bodies that turn.
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// One symmetric body on a ball joint, in gravity along -z: "heavy_top".
std::shared_ptr<const Reference> solve_heavy_top(const Scenario& scenario, std::string citation);

}  // namespace plumbline
