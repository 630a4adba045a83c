// Obstacle avoidance of a link, length kept (course slide 35, example 3): the slide's three ideas.
//
//   translate  both ends by the shortest vector that parts link and obstacle
//   rotate     about the end farther from the obstacle, by the smallest angle about the axis u x n (u along the link, n
//              out of the obstacle) at which the link is clear
//   combine    the minimal motion that clears the link and keeps its length; every motion that keeps the length is a
//              translation and a rotation, so this is the slide's combination with the best shares
//
// What a motion costs is sum m |d|^2 [kg m^2], as for every minimal motion (constraint.hpp).
//
// A link that starts clear stays where it is. A fixed end (w = 0) rules out the translation, and rotation about the
// other end. The blocked directions of a link that turns in one plane about an end outside a convex obstacle form one
// interval; the rotation is its end, found by bisection to the last bit and taken on the clear side.
#pragma once

#include <optional>

#include "plumbline/core/constraints/obstacle.hpp"

namespace plumbline {

struct Link {
  Vec3 a_W, b_W;                                  // ends [m]
  double inverse_mass_a = 1, inverse_mass_b = 1;  // of the particles at the ends [1/kg]
};

struct LinkMotion {
  Vec3 d_a_W, d_b_W;  // displacements [m]
  double cost;        // [kg m^2]
};

// Nothing where an end is fixed.
std::optional<LinkMotion> escape_by_translation(const Link& link, const Obstacle& obstacle);
// Nothing where the end that should move is fixed or the pivot itself is inside the obstacle.
std::optional<LinkMotion> escape_by_rotation(const Link& link, const Obstacle& obstacle);
// For a box the combination clears the half-space before the box that the shortest way out ends in, which is the way
// out that moves least to first order in the depth. Nothing where no motion is found.
std::optional<LinkMotion> escape_by_both(const Link& link, const Obstacle& obstacle);

// Whichever of the three costs least; nothing when none is possible ("no guarantees", slide 36).
std::optional<LinkMotion> least_escape(const Link& link, const Obstacle& obstacle);

}  // namespace plumbline
