// Chains and bridges: particles in a row, each linked to the next (course slides 35-36).
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/constraints/assembly.hpp"

namespace plumbline {

// Particles at these positions [m], each of that mass [kg], linked with the distances that they have there. The first
// is held in place, so is the last if asked (a bridge). Link k of the list joins particles k and k + 1. Throws
// std::invalid_argument for fewer than two positions, two neighbours in one place, or a mass <= 0.
//
// What to expect of a chain of N links of length l and N particles of mass m that hangs from its first:
//   tension of link k = m g (N - k): the weight below, carried from link to link;
//   small swings of frequency w_j^2 = (g/l) x_j, x_j the zeros of the Laguerre polynomial L_N (Bernoulli 1732).
Assembly make_chain(std::span<const Vec3> p_W, double mass, bool last_held = false);

// A straight row of positions: `links` + 1 points from `first_W` to `last_W`.
std::vector<Vec3> row_of_points(const Vec3& first_W, const Vec3& last_W, std::size_t links);

}  // namespace plumbline
