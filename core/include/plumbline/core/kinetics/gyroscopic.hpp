// The gyroscopic term: what a free body's angular velocity does although nothing acts on it.
//
// M = dL/dt with L = I w in the world frame gives Euler's equation in the body frame, I dw/dt = M - w x (I w). The
// second term is missing on course slide 6 (M = I alpha); it vanishes only where I w is parallel to w. It is quadratic
// in w, so that a step must choose how to treat it, and engines choose differently:
//
//   none       w_B stays: |L| of a tumbling body changes, its energy in the body frame does not
//   explicit   w_B - h I^-1 (w_B x I w_B): the energy grows, without bound for long or fast spins
//   implicit   one Newton step for I (w' - w) + h w' x I w' = 0 from w' = w: the energy falls; stable for any h
//              (E. Catto, "Numerical Methods", Game Developers Conference 2015)
//   exact      Euler's equations and the attitude solved: neither energy nor angular momentum changes
#pragma once

#include <string_view>

#include "plumbline/core/state.hpp"

namespace plumbline {

enum class GyroscopicTerm { kExplicit, kNone, kImplicit, kExact };

// "explicit gyroscopic term", "no gyroscopic term", ...
std::string_view name(GyroscopicTerm term);

// Angular velocity in the body frame [rad/s] after a torque-free step of h [s] from w_B, for principal moments
// inertia_B [kg m^2] (0: the body does not turn about that axis).
Vec3 gyroscopic_step(GyroscopicTerm term, const Vec3& inertia_B, const Vec3& w_B, double h);

// Attitude and angular velocity of a torque-free body h [s] later; position and velocity are left alone.
//
// Exact to rounding: the angular momentum in W is kept, and Euler's equations are solved by their Taylor series (the
// right-hand side is quadratic, so every coefficient follows from those below it by a Cauchy product), over pieces of a
// quarter radian. Rounding grows with the number of pieces. The moments must obey the triangle inequality, as those of
// every real body do.
void turn_freely(const Vec3& inertia_B, double h, BodyState& state);

}  // namespace plumbline
