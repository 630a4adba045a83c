// References that are computed: an integration to the last digits, or the event-exact simulator.
#pragma once

#include <memory>

#include "document.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// kind = "ode": smooth motions, joints and springs included; kind = "events": smooth spheres among themselves and on
// half-spaces. Throws ScenarioError for a scenario that the kind is not for.
std::shared_ptr<const Reference> read_computed(const Node& table, const Parameters& constants,
                                               const Scenario& scenario);

}  // namespace plumbline
