// Named solutions of particles.
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// Bodies, each with one force law that pulls it to the origin as 1/r^2: "kepler_orbit".
std::shared_ptr<const Reference> solve_kepler_orbit(const Scenario& scenario, std::string citation);

}  // namespace plumbline
