// Energy and momenta of a set of bodies: what a closed system keeps.
#pragma once

#include <span>

#include "plumbline/core/scenario.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

// Sums over the bodies that move. With `in_plane`, only the motion in the x-z plane counts.
// Kinetic energy plus potential energy in uniform gravity, zero at the origin [J].
double energy(const Scenario& scenario, std::span<const BodyState> states, bool in_plane = false);
// Linear momentum [kg m/s].
Vec3 momentum(const Scenario& scenario, std::span<const BodyState> states, bool in_plane = false);
// Angular momentum about the origin of W: sum of p x m v + I w [kg m^2/s].
Vec3 angular_momentum(const Scenario& scenario, std::span<const BodyState> states, bool in_plane = false);

}  // namespace plumbline
