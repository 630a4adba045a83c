// When does a moving sphere hit a moving box (course slide 16: primitives "combined for more complex objects")?
//
// Seen from the box, the centre x(t) of the sphere moves, and it touches when its distance from the box is the radius:
// the surface that it must reach is the box with rounded edges, made of faces, quarter cylinders and eighths of spheres
// (C. Ericson, Real-Time Collision Detection, 2005, ch. 5.5.7).
//
// Both in straight motion without turning of the box: exact. While each coordinate of x stays within, above or below
// the box, the square of the distance is one quadratic in t, sum over the coordinates that are outside of
// (x_k -+ h_k + v_k t)^2. There are at most seven such pieces, and the first root of the first piece that has one is
// the time, with the error of a few roundings (grazing: of its square root, as with two spheres).
//
// The box turns, or they accelerate: by advancing. The distance of a point from a convex body is a convex function of
// the point, so that along a path its second derivative is nowhere below -|x''|, whatever the feature below the sphere:
//   f(t + s) >= f + f' s - M s^2/2,   M >= |x''| = |a - 2 w x d' + w x (w x d)|,
// d from the centre of the box, w its angular velocity. Steps to the root of that bound never step over an impact and
// converge quadratically; they stop when f <= kImpactTolerance times the size. Spin of the sphere plays no part.
#pragma once

#include <optional>

#include "plumbline/core/collision/time_of_impact.hpp"
#include "plumbline/core/collision/touch.hpp"

namespace plumbline {

// The first time in [0, horizon] [s] at which a sphere (a) of that radius and a box (b) of those full edge lengths [m]
// touch while they approach. Overlap at the start, if they approach (along the normal of least depth), is 0. The normal
// points from the box to the sphere. NaN never meets anything.
std::optional<Touch> sphere_meets_box(const Motion& sphere, double radius, const Motion& box, const Vec3& size,
                                      double horizon);

}  // namespace plumbline
