// Bounds of a body over a whole step: what it may touch on its way (course slide 17 for bodies that move).
//
// The body flies as in time_of_impact.hpp: p(t) = p + v t + a t^2/2, q(t) = exp(w t) q, for 0 <= t <= duration. Two
// bodies whose swept bounds are apart do not meet within the step; fast bodies do not tunnel through the filter.
#pragma once

#include "plumbline/core/broad_phase/bounding_volume.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {

// Translation is exact: along each axis the centre is furthest at the start, at the end, or where v + a t = 0.
//
// Rotation by the angle h = |w| duration moves a point along an arc. Up to half a turn, an arc of radius r lies within
// its sagitta r (1 - cos(h/2)) of its chord, and the chord lies in the larger of the boxes of start and end. So the
// half-widths are the larger ones of start and end plus the sagitta of the corner furthest from the axis, but never
// more than half the diagonal. They are exact for h = 0 and too wide by O(h^2) at most.
//
// Grown by a few roundings of its numbers, so that bodies that touch in exact arithmetic also do here. Half-spaces do
// not move. Throws std::invalid_argument unless 0 <= duration < infinity and the motion is finite.
Aabb swept_box(const Shape& shape, const Motion& motion, double duration);

// Around the box of the centre's path, plus the radius of the body. Exact for a straight path (a capsule's sphere).
BoundingSphere swept_sphere(const Shape& shape, const Motion& motion, double duration);

}  // namespace plumbline
