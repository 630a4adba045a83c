// Penalty springs (course slide 33): a stiff spring for each constraint, which pulls only while it is violated.
//
//   f_i = -(k C + c dC/dt) dq/dp_i    while C != 0, with dC/dt = sum dq/dp_i . v_i
//
// The result is an AccelerationField (integration/stepper.hpp), so every integrator can run it. What it costs: a load F
// is held only by a violation F/k (a particle on a rod hangs m g/k too low), and stiff springs need small steps.
//
// How small. Let w_max be the largest frequency of the springs, from k G W G^T, G the gradients and W the inverse
// masses: sqrt(k/m_eff) for one spring with 1/m_eff = w1 + w2. Semi-implicit Euler on x'' = -w^2 x - 2 zeta w x' has
// the characteristic polynomial z^2 - (2 - w^2 h^2 - 2 zeta w h) z + (1 - 2 zeta w h), whose roots stay within the unit
// circle (Jury's criterion) iff
//
//   h < 2 (sqrt(1 + zeta^2) - zeta)/w,    2/w without damping.
//
// Explicit Euler has no stable step without damping; position and velocity Verlet have 2/w as well, RK4 2.83/w. Damping
// that helps accuracy makes the stable step smaller: it is evaluated at the old velocity.
//
// Source: course slide 33; Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., I.1 (stability of Verlet).
#pragma once

#include "plumbline/core/constraints/constraint.hpp"
#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

struct PenaltySpring {
  double stiffness = 1e4;  // k [N/m], for angles [N m/rad]
  double damping = 0;      // c [N s/m], for angles [N m s/rad]
};

// Linear accelerations of the particles, whose positions are the states' p_WB: gravity and the springs. Particles with
// inverse mass 0 get none. Throws std::invalid_argument for a stiffness or damping below 0; the field throws it when it
// meets another number of states.
AccelerationField penalty_field(ConstraintList constraints, std::vector<double> inverse_masses, const Vec3& gravity_W,
                                const PenaltySpring& spring);

// w_max [rad/s] of the springs about these positions, all of them taken as pulling. Exact where they are unloaded; a
// spring with tension T adds stiffness T/length across it, small beside k.
double largest_penalty_frequency(const ConstraintList& constraints, std::span<const double> inverse_masses,
                                 std::span<const Vec3> p_W, const PenaltySpring& spring);

// The step [s] below which semi-implicit Euler is stable for that frequency [rad/s] and damping ratio zeta = c w/(2 k).
double largest_stable_step(double frequency, double damping_ratio = 0);

}  // namespace plumbline
