// Impulses: how velocities jump where bodies touch (course slides 19-23, with the angular part that they leave out).
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/collision/contact.hpp"

namespace plumbline {

// How a body answers an impulse J at the arm r from its centre of mass: v += J/m, w += I^-1 (r x J).
// Zero for bodies that never move.
struct Inertness {
  double inverse_mass = 0;                // [1/kg]
  Mat3 inverse_inertia_W = Mat3::Zero();  // about the centre of mass [1/(kg m^2)]
};

// At that attitude. A principal moment of 0 means that the body does not turn about that axis.
Inertness inertness_of(const Body& body, const Quat& q_WB);

// One point at which an impulse may act.
struct ImpactPoint {
  Contact contact;
  // Speed along the normal with which the bodies must at least part afterwards [m/s]: e times the approach speed for
  // Newton's restitution e, 0 for contacts that rest.
  double rebound_speed = 0;
  double friction = 0;  // Coulomb's mu >= 0
};

struct ImpulseReport {
  std::vector<Vec3> impulses_W;  // on body_a of each point, its opposite on body_b [N s]
  int sweeps = 0;
  bool converged = false;
};

// Whether the search may leap, see below.
enum class Leaps {
  kAllowed,
  kNever,  // sweeps alone: what leaps are measured against
};

// Changes the velocities in `states` by the impulses J = J_n n + J_t that satisfy, at all points at once:
//
//   along the normal   J_n >= 0,  v_n >= rebound_speed,  J_n (v_n - rebound_speed) = 0   (bodies push, never pull)
//   across it          |J_t| <= mu J_n,  and J_t = -mu J_n v_t/|v_t| while the point slides  (Coulomb's cone, round)
//
// with v the contact velocities afterwards. Found by projected Gauss-Seidel: point by point, each impulse is
// corrected by what its own velocity lacks and put back into the cone, until a sweep changes nothing by more than
// 1e-14 of the largest impulse, or 1000 sweeps are over (then an impulse that only rounding still moves has converged
// too). Velocities are computed once more from the final impulses, so that momentum is kept to rounding whatever the
// number of sweeps. NaN in, NaN out.
//
// Sweeps alone are slow where loads are handed on from body to body, a stack of n boxes takes about n^2 times as many,
// and where friction is all but used up. So every eighth sweep (ever fewer, where it does not help) may be preceded by
// a leap: the linear equations of the points that push are solved at once, as if it were known that these go on
// pushing, gripping and sliding as they do; the sweep then judges the outcome, and it is kept if there is less left to
// change. A stack of ten settles after 16 sweeps, which 1000 do not do alone. (M. Silcowitz, S. Niebe, K. Erleben,
// Projected Gauss-Seidel subspace minimization method for interactive rigid body dynamics, GRAPP 2010.)
ImpulseReport apply_impulses(std::span<const ImpactPoint> points, std::span<const Inertness> inertness,
                             std::span<BodyState> states, Leaps leaps = Leaps::kAllowed);

}  // namespace plumbline
