// What the two rows of this adapter are made of.
#pragma once

#include <memory>
#include <vector>

#include "plumbline/core/engine.hpp"

namespace plumbline {

// Rigid unilateral contact and a semi-implicit Euler step.
std::vector<Setting> simbody_rigid_settings();
std::unique_ptr<World> make_simbody_rigid(const Scenario& scenario, const Settings& settings);

// Elastic contact with Hunt and Crossley's dissipation, integrated to an accuracy within the step.
std::vector<Setting> simbody_compliant_settings();
std::unique_ptr<World> make_simbody_compliant(const Scenario& scenario, const Settings& settings);

}  // namespace plumbline
