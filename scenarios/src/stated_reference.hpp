// References that are no formula of time: a table of published states, invariants, an exact critical value.
#pragma once

#include <memory>

#include "document.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// kind = "table": [[reference.row]] with the time and what is known of the bodies then; what is not stated of a body
// keeps its initial value. Fills scenario.known_at.
std::shared_ptr<const Reference> read_table(const Node& table, const Parameters& constants, Scenario& scenario);

// kind = "invariants" and kind = "threshold": nothing is known of the motion, so the states are the initial ones.
// Clears scenario.pointwise.
std::shared_ptr<const Reference> read_without_motion(const Node& table, Scenario& scenario);

}  // namespace plumbline
