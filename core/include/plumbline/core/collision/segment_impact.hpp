// When does a moving line hit another line (course slide 16)? And a moving point a triangle?
//
// The ends of the segments move in straight lines at constant velocity, each its own: the segments may so turn, shrink
// and grow. Two lines can only meet when they lie in one plane, and four points do when the volume that they span is
// zero,
//   F(t) = (u x v) . d = 0,  u = a2 - a1, v = b2 - b1, d = b1 - a1, each linear in t:
// a cubic, whose up to three roots are candidates. At the first of them at which the two segments really share a point
// they touch. A point and a triangle: the same cubic with u and v two sides. (X. Provot, Collision and self-collision
// handling in cloth model, Graphics Interface 1997; T. Brochu et al., Efficient geometrically exact continuous
// collision detection, SIGGRAPH 2012, for the traps.)
//
// Where F vanishes all the time (all in one plane, as in a plane game) the touch begins with an end on a segment: the
// roots of the components of (v x (a1 - b1)) and so on, quadratics; where these vanish too (all on one line), with an
// end on an end: linear. Parallel segments that come together sideways are of that kind.
//
// Promise: a touch in [0, horizon] [s] is found whatever its kind, double roots at grazing included (polynomial_roots),
// and what is found is a touch to within 64 roundings of the coordinates, times 1/sin of the angle between the lines
// (at most 1e6), which is what the time of a crossing at that angle is worth. So lines that pass each other at such a
// distance may be called touching. The time of a simple root has an error of a few roundings of the coordinates over
// the speed of approach; of a double root, of its square root.
// Rigid rods that turn have ends on circles and no cubic: give them a thickness, and they are polyhedra
// (polyhedron_impact.hpp). Lines have no inside: those that touch at the start meet at 0, whether they approach or
// part. NaN never meets anything.
#pragma once

#include <array>
#include <optional>

#include "plumbline/core/collision/nearest_points.hpp"
#include "plumbline/core/collision/touch.hpp"

namespace plumbline {

struct MovingPoint {
  Vec3 p_W = Vec3::Zero();  // at time 0 [m]
  Vec3 v_W = Vec3::Zero();  // [m/s]
  Vec3 at(double t) const { return p_W + t * v_W; }
};

struct MovingSegment {
  MovingPoint tail, head;
  Segment at(double t) const { return {tail.at(t), head.at(t)}; }
};

using MovingTriangle = std::array<MovingPoint, 3>;

// The normal of the touch: of crossing lines u x v, of a point on a triangle the triangle's, turned so that the first
// comes from its front side. Where the motion stays in that plane, the part of the approach across the segment (or
// edge) that is hit; where nothing moves, as it comes.
std::optional<Touch> segment_meets_segment(const MovingSegment& a, const MovingSegment& b, double horizon);
std::optional<Touch> point_meets_triangle(const MovingPoint& point, const MovingTriangle& triangle, double horizon);

}  // namespace plumbline
