// Convex polyhedra: corners, faces and edges (course slide 16, "combine these for more complex objects").
//
// A polyhedron is the list of its corners in body axes B [m] and, for each flat face, the loop of its corners. From
// these follow the outward normals, the edges and which two faces meet in each edge: all that a distance between two
// polyhedra asks for. The body's origin (its centre of mass, when it moves) may lie anywhere.
//
// Faces are whole: coplanar triangles of a point cloud are merged, so that a box has 6 faces and 12 edges however it
// was made. Convex hulls by adding one point at a time: de Berg et al., Computational Geometry, 3rd ed. 2008, ch. 11.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

class ConvexPolyhedron {
 public:
  // The points x inside have normal_B . x <= offset.
  struct Face {
    std::vector<std::size_t> corners;  // indices, counter-clockwise seen from outside
    Vec3 normal_B;                     // outward, unit
    double offset;                     // [m]
  };

  // The loop of the face `left` runs from tail to head, that of the face `right` from head to tail.
  struct Edge {
    std::size_t tail, head;   // corners
    std::size_t left, right;  // faces
  };

  // Corners [m] and the loops of the faces. Throws std::invalid_argument where these are not the closed surface of a
  // convex solid: a loop of fewer than three corners, an edge without its two faces, a face that is bent or has corners
  // in front of it (by more than kFlatness of the size), a corner that no face uses, a number that is not finite.
  ConvexPolyhedron(std::vector<Vec3> vertices_B, std::vector<std::vector<std::size_t>> loops);

  const std::vector<Vec3>& vertices_B() const { return vertices_B_; }
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }

  // Distance of the farthest corner from the body's origin [m].
  double radius() const { return radius_; }

  // How far from a common plane the corners of a face may lie, relative to the size of the solid.
  static constexpr double kFlatness = 1e-12;

 private:
  std::vector<Vec3> vertices_B_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  double radius_ = 0;
};

// The box of those full edge lengths [m] about its centre. Throws std::invalid_argument unless all are > 0 and finite.
// Corner i is box_corner(size, i); the faces are -x, +x, -y, +y, -z, +z.
ConvexPolyhedron box_polyhedron(const Vec3& size);

// The smallest convex polyhedron that holds all points [m]. Points inside it, on a face or on an edge (to kFlatness of
// the diameter of the cloud) are no corners. Throws std::invalid_argument for fewer than four points, for points that
// all lie in one plane, and for numbers that are not finite. The time grows with points times faces.
ConvexPolyhedron convex_hull(std::span<const Vec3> points_B);

}  // namespace plumbline
