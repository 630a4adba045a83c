// Bounding volumes: simple bodies around complicated ones (course slide 17).
//
// If the volumes are apart, so are the bodies, and the exact test is saved. Two kinds: a sphere, which turns with the
// body at no cost, and a box along the world's axes (an AABB), which fits flat and long bodies better and is what the
// spatial indices of broad_phase.hpp sort.
//
// Everything is in W [m]. Volumes are closed: touching counts as overlap, so that no contact is lost at its first
// instant. Source: Ericson, Real-Time Collision Detection (2005), chapter 4.
#pragma once

#include <span>

#include "plumbline/core/body.hpp"

namespace plumbline {

// The points with min <= x <= max along each axis. An edge may be infinite.
struct Aabb {
  Vec3 min, max;
};

// The points within the radius >= 0 of the centre. The radius may be infinite.
struct BoundingSphere {
  Vec3 centre;
  double radius;
};

// Two boxes are apart if and only if they are apart along one axis. A NaN overlaps nothing. (Bitwise &: six cheap
// comparisons without a jump are faster than guessing which of them fails.)
inline bool overlap(const Aabb& a, const Aabb& b) {
  return (a.min.x() <= b.max.x()) & (b.min.x() <= a.max.x()) & (a.min.y() <= b.max.y()) & (b.min.y() <= a.max.y()) &
         (a.min.z() <= b.max.z()) & (b.min.z() <= a.max.z());
}

// |c_a - c_b| <= r_a + r_b, without the root.
bool overlap(const BoundingSphere& a, const BoundingSphere& b);

// The point of the box that is nearest to the centre lies within the radius (Arvo, Graphics Gems, 1990).
bool overlap(const BoundingSphere& sphere, const Aabb& box);

bool contains(const Aabb& box, const Vec3& point_W);
bool contains(const BoundingSphere& sphere, const Vec3& point_W);

Aabb merged(const Aabb& a, const Aabb& b);                                     // the smallest box around both
Aabb grown(const Aabb& box, double margin);                                    // by margin [m] on all six sides
inline Vec3 centre(const Aabb& box) { return 0.5 * box.min + 0.5 * box.max; }  // halved first: 1e308 does not overflow

// Bounds of a body in that state, tight and exact to rounding.
//   sphere:     p +- r.
//   box:        half-widths |R| s/2, with |R| the matrix of the absolute values of the attitude's rotation matrix.
//               The sphere has half the diagonal for its radius.
//   half-space: has no bounds. Its sphere has an infinite radius. Its box ends at the plane if the normal lies along
//               an axis (a floor: all z <= p_z), and is all of space otherwise.
Aabb bounding_box(const Shape& shape, const BodyState& state);
BoundingSphere bounding_sphere(const Shape& shape, const BodyState& state);

// The smallest box around points. Throws std::invalid_argument for none, and for a NaN, naming the point.
Aabb bounding_box(std::span<const Vec3> points_W);

// Whether a box reaches into a half-space whose surface passes through p_WB: its lowest corner decides.
bool overlap(const Aabb& box, const HalfSpace& half_space, const Vec3& p_WB);

}  // namespace plumbline
