// [reference]: its kind says who reads the rest.
#pragma once

#include <memory>

#include "document.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// Throws ScenarioError. What the reference does not know of the motion is noted in the scenario (pointwise, known_at).
std::shared_ptr<const Reference> read_reference(const Node& root, const Parameters& constants, Scenario& scenario);

}  // namespace plumbline
