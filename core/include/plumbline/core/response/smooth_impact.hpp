// Two rigid bodies of any shape collide in one point without friction: the impulse in closed form.
//
// Slide 23's formula with a larger mobility: the point of contact, at the arm r from a centre of mass, gives way
// because the body moves and because it turns. Per unit impulse along the normal n,
//
//   1/M = 1/m_a + 1/m_b + (r_a x n) . I_a^-1 (r_a x n) + (r_b x n) . I_b^-1 (r_b x n),
//   j   = -(1 + e) M v_n           while v_n < 0, else 0,
//
// and M, the effective mass of the point, takes the part of the reduced mass: the impact costs (1 - e^2)/2 M v_n^2.
// In the plane, against a body that never moves, this is j = -(1 + e) v_n / (1/m + (r x n)^2/I): a box that falls on a
// corner. (Course slides 20-23; D. Baraff, Physically Based Modeling: Rigid Body Simulation, SIGGRAPH course notes
// 1997, section 8.1.) With friction the impulse may turn while it grows, and no such formula holds: see impulse.hpp.
#pragma once

#include <span>

#include "plumbline/core/response/impulse.hpp"

namespace plumbline {

// The effective mass M [kg] of the point of contact along its normal. At least one of the bodies must move: otherwise
// nothing gives way and M is infinite.
double effective_mass(const Contact& contact, std::span<const Inertness> inertness, std::span<const BodyState> states);

// Changes the velocities of contact.body_a and body_b and returns j >= 0 [N s], along the normal on body_a and against
// it on body_b. Throws std::invalid_argument for e outside [0, 1] and for two bodies that never move.
double apply_smooth_impact(const Contact& contact, double restitution, std::span<const Inertness> inertness,
                           std::span<BodyState> states);

}  // namespace plumbline
