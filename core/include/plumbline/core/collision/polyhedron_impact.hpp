// When do two moving convex polyhedra touch: time, point, normal (course slide 16, "when does a polyhedral object hit
// another polyhedral object?").
//
// Motions as everywhere in this folder: p(t) = p + v t + a t^2/2, q(t) = exp(w t) q, each w constant in W.
//
// Conservative advancement of second order along separating axes. At time t a plane with normal m separates the two
// (m a face's normal that turns with its body, or the cross product of two edges that turn with theirs). The height of
// each corner i of A over each corner j of B along it, f_ij(t) = m(t) . (a_i(t) - b_j(t)), has a bounded second
// derivative,
//   |f''| <= M = mu^2 X + 2 mu V + C,
// with mu the rate at which m turns, X >= |a_i - b_j|, V >= their relative speed and C >= their relative acceleration.
// So f_ij(t + s) >= f_ij + f_ij' s - M s^2/2, and a step to the first root of the smallest of these parabolas never
// steps over a touch. Near the touch the axis is the one along which they meet, and the error is squared with each
// step, where the classic bound (distance / largest speed) only shrinks it by a factor: B. Mirtich, Impulse-based
// dynamic simulation of rigid body systems, thesis, Berkeley 1996, ch. 2.
//
// Promise: no touch is stepped over. The time is that of a gap <= kImpactTolerance times the size of the pair, so its
// error is (1e-13 size + a few roundings of the coordinates) / u, where u is the speed at which they approach along
// the normal then: 1e-10 s for a metre-sized pair that meets at 1 cm/s or more. Grazing impacts (u -> 0) are as badly
// conditioned as their problem: a touch whose gap dips by less than that tolerance may be found or not. Nor
// is anything found after 10,000 steps, which only a gap needs that stays next to the tolerance while the bodies
// tumble.
#pragma once

#include <optional>

#include "plumbline/core/collision/convex_polyhedron.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"
#include "plumbline/core/collision/touch.hpp"

namespace plumbline {

// The first time in [0, horizon] [s] at which they touch while they approach. Bodies that overlap or touch at the start
// and approach (along the normal of least depth) meet at 0; those that part do not, unless the motion brings them back.
// NaN never meets anything.
std::optional<Touch> polyhedron_meets_polyhedron(const ConvexPolyhedron& a, const Motion& motion_a,
                                                 const ConvexPolyhedron& b, const Motion& motion_b, double horizon);

}  // namespace plumbline
