// Named solutions of motions in contact that ends or changes: taking off, sliding down, sliding to rest.
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// All throw std::invalid_argument for scenarios that they are not for.

// A ball on a fixed ball, in the x-z plane, from rest or rolling: exact/leaving_sphere.hpp.
std::shared_ptr<const Reference> solve_leaving_sphere(const Scenario& scenario, std::string citation);
// A box between the ground z = 0 and the wall x = 0, without friction, from rest: exact/falling_ladder.hpp.
std::shared_ptr<const Reference> solve_falling_ladder(const Scenario& scenario, std::string citation);
// An upright cylinder that slides along x and spins on the ground z = 0, taken as thin: exact/curling_disc.hpp.
std::shared_ptr<const Reference> solve_curling_disc(const Scenario& scenario, std::string citation);

}  // namespace plumbline
