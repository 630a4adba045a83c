// Named solutions of the family collision.
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// A box that leans on one of its lower edges along y, at rest, on a rough half-space: core/exact/rocking_block.hpp.
// Throws std::invalid_argument for other scenarios, and when the friction does not hold the edge.
std::shared_ptr<const Reference> solve_rocking_block(const Scenario& scenario, std::string citation);

}  // namespace plumbline
