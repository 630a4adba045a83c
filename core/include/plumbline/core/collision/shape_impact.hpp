// The time of impact of any two shapes of body.hpp, in one call.
//
//   | a \ b      | sphere              | box                  | half-space          |
//   | sphere     | sphere_meets_sphere | sphere_meets_box     | sphere_meets_plane  |
//   | box        | sphere_meets_box    | boxes as polyhedra   | box_meets_plane     |
//   | half-space | sphere_meets_plane  | box_meets_plane      | never               |
//
// A half-space is taken as fixed: its surface passes through the start position of its motion, whose velocities and
// acceleration are not used.
#pragma once

#include <optional>

#include "plumbline/core/body.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"
#include "plumbline/core/collision/touch.hpp"

namespace plumbline {

// The first time in [0, horizon] [s] at which the two touch while they approach, the point and the normal (from b to
// a, so that exchanging the two turns it round). Bodies that touch or overlap at the start and approach meet at 0;
// those that part do not, unless the motion brings them back. NaN never meets anything.
std::optional<Touch> shapes_meet(const Shape& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                                 double horizon);

}  // namespace plumbline
