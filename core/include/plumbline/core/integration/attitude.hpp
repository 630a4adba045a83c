// Attitudes that stay on the group: how an integrator adds an angle to a rotation.
//
// A position moves by addition, x + v dt. Rotations cannot be added: q + q' dt is no unit quaternion any more. They are
// multiplied, q <- exp(phi) q, by the rotation about the small vector phi = w dt [rad], here expressed in the world
// frame. What an integrator for vectors does to x it may do to phi; on the way from phi to q nothing is lost.
//
// For an integrator of order 3 and more it matters that a rate of phi is not an angular velocity: as soon as the axis
// turns, w and dphi/dt differ. With R(t) = exp([phi(t)]x) R_0 and R' = [w]x R they are tied by
//
//   w = dexp_phi(phi'),   phi' = dexp_phi^-1(w) = w - 1/2 phi x w + c(|phi|) phi x (phi x w),
//   c(x) = (1 - x/2 cot(x/2))/x^2 = 1/12 + x^2/720 + ...
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed. 2006, sections III.4.2 and IV.8
// (theorem 8.5: Munthe-Kaas methods keep the order of the classical method). The exponential itself is rotation_by() in
// spatial.hpp.
#pragma once

#include "plumbline/core/spatial.hpp"

namespace plumbline {

// exp(phi_W) q_WB, unit again: the attitude after a turn by phi_W [rad, axis in W]. Valid for every length of phi_W.
// The product of two unit quaternions is off unit length by a rounding or two; taking that out at each step keeps it
// from growing over millions of them.
Quat turned(const Quat& q_WB, const Vec3& phi_W);

// dphi/dt [rad/s] of the turn phi [rad] whose angular velocity is w [rad/s], both in W. Needs |phi| < 2 pi, where the
// formula has its pole; a step should stay far below.
Vec3 dexp_inverse(const Vec3& phi, const Vec3& w);

}  // namespace plumbline
