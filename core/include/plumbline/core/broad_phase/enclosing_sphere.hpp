// The smallest sphere around a set of points (course slide 17: a bounding sphere for a body that is given by points).
//
// Welzl's algorithm with the move-to-front rule (Welzl, Smallest enclosing disks (balls and ellipsoids), LNCS 555,
// 1991): expected time linear in the number of points. Guarantee: the sphere contains every point to rounding (its
// radius is the largest distance from its centre, measured at the end), and it is the smallest one to a relative 1e-9,
// also for points that lie on a common line, plane or sphere. Ritter's two-pass sphere (Graphics Gems, 1990) is
// quicker and only some 5 to 20 % too large; here the points of a body are bounded once, so the smallest one is worth
// it.
#pragma once

#include <span>

#include "plumbline/core/broad_phase/bounding_volume.hpp"

namespace plumbline {

// Any number of points [m], in any order, repeated or not; the same points in the same order give the same bits.
// Throws std::invalid_argument for no points, and for one that is not finite, naming it.
BoundingSphere enclosing_sphere(std::span<const Vec3> points_W);

}  // namespace plumbline
