// References written as expressions of time.
#pragma once

#include <memory>

#include "document.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// A [reference] with kind = "closed_form". A component that is not stated keeps its initial value. At t = 0 the
// reference must be the initial state of `scenario`, and at its end it must be finite: throws ScenarioError.
// Evaluating writes into variables of the reference: one thread at a time.
std::shared_ptr<const Reference> read_closed_form(const Node& table, const Parameters& constants,
                                                  const Scenario& scenario);

}  // namespace plumbline
