// Nearest points of the simplest things: a point, a segment, a triangle.
//
// All lengths in metres, all points in one common frame. A segment whose ends coincide is a point; a triangle without
// area is treated as its three edges. Source: C. Ericson, Real-Time Collision Detection, 2005, ch. 5.1.
#pragma once

#include <array>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct Segment {
  Vec3 tail, head;
};

using TriangleCorners = std::array<Vec3, 3>;

struct NearestPoints {
  Vec3 a, b;  // on the first and on the second thing
  double distance() const { return (a - b).norm(); }
};

// p = tail + s (head - tail), with s the projection's, held within [0, 1].
Vec3 nearest_on_segment(const Vec3& point, const Segment& segment);

// The smallest of at most five distances: of the two lines' nearest points, if both lie within their segments, and of
// each end to the other segment. Exact also for parallel segments, which have many nearest pairs: one of them, or the
// middle one where the segments run side by side.
NearestPoints nearest_points(const Segment& a, const Segment& b);

// The foot of the perpendicular, if it lies inside, else the nearest point of the three edges.
Vec3 nearest_on_triangle(const Vec3& point, const TriangleCorners& triangle);

}  // namespace plumbline
