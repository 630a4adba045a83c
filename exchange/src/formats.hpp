// One function a format, and what they share.
#pragma once

#include "plumbline/exchange/world_export.hpp"

namespace plumbline {

ExportedWorld to_mjcf(const Scenario& scenario);
ExportedWorld to_sdf(const Scenario& scenario);
ExportedWorld to_urdf(const Scenario& scenario);

// What none of the formats has: force laws, drives, questions.
std::vector<std::string> losses_of_every_format(const Scenario& scenario);

// As names stand in a list of losses.
std::string quoted(const std::string& name);

}  // namespace plumbline
