// The yes/no question of a scenario file.
#pragma once

#include <functional>
#include <optional>

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// The scenario of the same file with that value of a parameter.
using ScenarioWith = std::function<std::shared_ptr<const Scenario>(const std::string& parameter, double value)>;

// [threshold]; nothing when the table is absent.
std::optional<Threshold> read_threshold(const Node& root, const Parameters& constants, const Scenario& scenario,
                                        const ScenarioWith& scenario_with);

}  // namespace plumbline
