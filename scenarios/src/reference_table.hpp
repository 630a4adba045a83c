// [reference]: its kind says who reads the rest.
#pragma once

#include <memory>

#include "document.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// kind = "closed_form" or "solution". Throws ScenarioError.
std::shared_ptr<const Reference> read_reference(const Node& root, const Parameters& constants,
                                                const Scenario& scenario);

}  // namespace plumbline
