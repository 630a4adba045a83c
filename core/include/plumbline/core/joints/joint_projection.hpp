// Back onto the joints: the least motion that closes what an integrator has let drift apart (course slide 36).
//
//   positions    J x = -C   the displacement x with least sum of m |dp|^2 + dphi.I dphi; repeated, since C bends
//   velocities   J x = -J v   with least sum of m |dv|^2 + dw.I dw: kinetic energy can only fall
//
// Both are internal: they move neither the centre of mass nor change the linear momentum, and the velocities' part
// keeps the angular momentum, unless a joint leads to the world. Coordinates beyond their range are put back onto the
// limit like a joint; where ranges to hold are named, those and no others count, inside their range too. Source:
// Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed. 2006, section IV.4: a projection after each step
// keeps the order of the integrator.
#pragma once

#include <vector>

#include "plumbline/core/joints/least_change.hpp"

namespace plumbline {

struct Projection {
  double error = 0;  // largest |C| that is left [m] or [rad]
  int sweeps = 0;    // Newton steps taken
};

// Newton's method, quadratic near the joints: drift of 1e-3 is gone after four sweeps. Stops once the error is below
// `tolerance`, or after max_sweeps; the caller sees the error. Far from any solution it may fail, as Newton does.
Projection project_positions(const ArticulatedBody& body, std::span<BodyState> states, double tolerance = 1e-13,
                             int max_sweeps = 20);

// The same with the coordinates of the joints `held_ranges` on the nearer of their limits.
Projection project_positions_held(const ArticulatedBody& body, std::span<BodyState> states,
                                  std::span<const std::size_t> held_ranges, double tolerance = 1e-13,
                                  int max_sweeps = 20);

// One solve; the coordinates of the joints `held_ranges` stand still too. Returns the largest |J v| that was there
// before [m/s] or [rad/s].
double project_velocities(const ArticulatedBody& body, std::span<BodyState> states,
                          std::span<const std::size_t> held_ranges = {});

}  // namespace plumbline
