// The contact manifold of two convex bodies: all the points at which they may push each other at this instant.
//
// Bodies that lie on each other touch in a whole region. For rigid bodies the forces on the region's corners can do
// all that a pressure spread over it can, so that the manifold is the list of these corners.
//
// 1. Along which normal do they touch? Two convex polyhedra are apart if and only if one of finitely many directions
//    separates them: the normal of a face, or the cross product of two edges (for boxes 15 of them: S. Gottschalk,
//    M. Lin, D. Manocha, OBBTree, SIGGRAPH 1996). The one along which they are farthest apart, or overlap least, is the
//    normal.
// 2. A face's normal: the other body's facing polygon is clipped at the sides of that face (Sutherland and Hodgman
//    1974), and each corner of what is left is a contact with its own gap. Where faces are parallel this is their
//    common polygon: 4 points for a box upon a larger one, 8 for equal squares turned by 45 degrees. Where one is
//    tilted a little, each point has the normal of the features that touch there: corner on face, face on corner, edge
//    on edge. Two edges, with no face that lies along their normal: one contact, where the edges come closest.
//
// Points lie halfway between the two surfaces (between a tilted body and a face, along the face's normal), so that they
// do not depend on which body is called a, and normals just change their sign. Gaps [m] are measured along the normal.
//
// Valid for bodies that touch, nearly touch, or overlap by little compared with their size: the gap of the nearest
// point is then their distance, or minus the depth of overlap. Bodies whose nearest features are corner against
// corner or corner against edge have no such direction; while they are apart they may have no contact at all, and
// where they touch exactly so the normal is that of a face or edge pair, one of the many that are possible.
#pragma once

#include <vector>

#include "plumbline/core/collision/contact.hpp"
#include "plumbline/core/collision/convex_polyhedron.hpp"

namespace plumbline {

// Two boxes of those sizes (full edge lengths) [m]: at most 8 contacts.
std::vector<Contact> box_box_contacts(const BodyState& a, const Vec3& size_a, const BodyState& b, const Vec3& size_b);

// Two convex polyhedra: at most as many contacts as their touching faces have corners together.
std::vector<Contact> convex_contacts(const ConvexPolyhedron& a, const BodyState& state_a, const ConvexPolyhedron& b,
                                     const BodyState& state_b);

// Edges whose directions differ by less than this [rad] count as parallel.
inline constexpr double kParallelAngle = 1e-6;

// Below this angle [rad] between the normal of two touching edges and that of a face, a body is one that lies down, or
// rocks, on that face: all the points are listed at which it may come to lie, and not just the crossing of the edges.
inline constexpr double kLyingAngle = 0.1;

}  // namespace plumbline
