// How far apart are two convex polyhedra, and along which direction?
//
// Two answers to that, both exact up to rounding, by two different ways:
//
// Separating axes. Two convex bodies are apart exactly if some plane has one on each side. For polyhedra only the
// normals of the faces of the difference A - B need trying: those of the faces of A, of the faces of B, and the cross
// products of one edge of each. Of the edge pairs only those count whose arcs on the sphere of normals cross (a face
// of A - B then). The largest gap of all is the signed distance as far as these planes can see it: where the bodies
// overlap it is minus the depth (the shortest way to push them apart), where they touch it is 0, where they are apart
// it is > 0, and smaller than the distance if the nearest features are two corners, or a corner and an edge. S.
// Gottschalk, Separating axis theorem, UNC TR96-024, 1996; D. Gregorius, The separating axis test between convex
// polyhedra, GDC 2013.
//
// Nearest features. The distance of bodies that are apart is the smallest of all edge-edge and corner-face distances.
// C. Ericson, Real-Time Collision Detection, 2005, ch. 5.1 and 9.3.
//
// Both cost a time that grows with edges times edges: made for boxes and for solids of up to some dozen faces.
// A distance d [m] carries an error of a few roundings of the coordinates, about 1e-15 of (size + distance of the
// bodies): there is no cancellation near touch, since the direction comes from a face or from two edges and never from
// the difference of two nearly equal points. The place of the nearest points is known as well, except where edges cross
// at a flat angle: along these its error is divided by the sine of the angle.
#pragma once

#include "plumbline/core/collision/convex_polyhedron.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

// A plane between two polyhedra, and the gap that it sees.
struct SeparatingAxis {
  enum class Kind { kFaceOfA, kFaceOfB, kEdges };
  Kind kind = Kind::kFaceOfA;
  std::size_t index_a = 0;        // face of A, or edge of A; not used for kFaceOfB
  std::size_t index_b = 0;        // face of B, or edge of B; not used for kFaceOfA
  Vec3 normal_W = Vec3::UnitZ();  // unit, from b to a
  double gap = 0;                 // [m] all of A lies that far ahead of all of B along the normal; negative: overlap
};

// The axis of the largest gap. The states' velocities are not used. With NaN in a state the gap is NaN.
SeparatingAxis separating_axis(const ConvexPolyhedron& a, const BodyState& state_a, const ConvexPolyhedron& b,
                               const BodyState& state_b);

// The nearest points of two polyhedra. If they overlap: minus the depth, the normal along which to push a out, and the
// points of the two surfaces that would then touch.
struct Separation {
  double distance = 0;            // [m]; negative: overlap
  Vec3 normal_W = Vec3::UnitZ();  // unit, from b to a
  Vec3 point_a_W = Vec3::Zero();  // on the surface of A [m]
  Vec3 point_b_W = Vec3::Zero();  // on the surface of B [m]; point_a - point_b is along the normal
};

Separation convex_distance(const ConvexPolyhedron& a, const BodyState& state_a, const ConvexPolyhedron& b,
                           const BodyState& state_b);

}  // namespace plumbline
