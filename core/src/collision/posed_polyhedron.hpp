// Polyhedra put into the world: what separating axes and their motion look at.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/collision/convex_distance.hpp"
#include "plumbline/core/collision/nearest_points.hpp"

namespace plumbline {

// Corners and normals in world axes, seen from an origin of the user's choice: coordinates stay as small as the pair,
// wherever in the world it is.
struct PosedPolyhedron {
  const ConvexPolyhedron* shape;
  Vec3 centre;                  // the body's origin [m]
  std::vector<Vec3> vertices;   // [m]
  std::vector<Vec3> normals;    // of the faces, outward
  std::vector<double> offsets;  // normal . x on the face [m]

  explicit PosedPolyhedron(const ConvexPolyhedron& body)
      : shape(&body),
        centre(Vec3::Zero()),
        vertices(body.vertices_B().size()),
        normals(body.faces().size()),
        offsets(body.faces().size()) {}

  void place(const Vec3& position, const Quat& attitude) {
    const Mat3 R = attitude.toRotationMatrix();
    centre = position;
    for (std::size_t k = 0; k < vertices.size(); ++k) vertices[k] = position + R * shape->vertices_B()[k];
    for (std::size_t f = 0; f < normals.size(); ++f) {
      normals[f] = R * shape->faces()[f].normal_B;
      offsets[f] = normals[f].dot(position) + shape->faces()[f].offset;
    }
  }
  Vec3 edge_vector(const ConvexPolyhedron::Edge& edge) const { return vertices[edge.head] - vertices[edge.tail]; }
};

inline double lowest(std::span<const Vec3> points, const Vec3& along) {
  double result = along.dot(points.front());
  for (const Vec3& p : points) {
    const double height = along.dot(p);
    if (!(height >= result)) result = height;  // NaN wins, and so will not be overlooked
  }
  return result;
}

// Calls visit(axis) for the axes whose gap is above `floor`, faces first; visit returns the floor for those to come.
template <typename Visit>
void visit_axes(const PosedPolyhedron& a, const PosedPolyhedron& b, double floor, const Visit& visit) {
  using Kind = SeparatingAxis::Kind;
  const auto offer = [&](const SeparatingAxis& axis) {
    if (!(axis.gap <= floor)) floor = visit(axis);
  };
  for (std::size_t f = 0; f < a.normals.size(); ++f) {
    offer({Kind::kFaceOfA, f, 0, -a.normals[f], lowest(b.vertices, a.normals[f]) - a.offsets[f]});
  }
  for (std::size_t f = 0; f < b.normals.size(); ++f) {
    offer({Kind::kFaceOfB, 0, f, b.normals[f], lowest(a.vertices, b.normals[f]) - b.offsets[f]});
  }
  const auto &edges_a = a.shape->edges(), &edges_b = b.shape->edges();
  for (std::size_t i = 0; i < edges_a.size(); ++i) {
    const ConvexPolyhedron::Edge& edge_a = edges_a[i];
    const Vec3 u = a.edge_vector(edge_a), &left = a.normals[edge_a.left], &right = a.normals[edge_a.right];
    for (std::size_t j = 0; j < edges_b.size(); ++j) {
      const ConvexPolyhedron::Edge& edge_b = edges_b[j];
      // The edge makes a face of A - B with the other one if the arc between the normals of its two faces crosses the
      // arc between those of the other, turned round: each edge vector has the other's two normals on opposite sides.
      const double left_b = b.normals[edge_b.left].dot(u), right_b = b.normals[edge_b.right].dot(u);
      if (!(left_b * right_b < 0)) continue;
      const Vec3 v = b.edge_vector(edge_b);
      const double left_a = left.dot(v), right_a = right.dot(v);
      if (!(left_a * right_a < 0) || !(left_b * right_a < 0)) continue;  // the last: they cross, not their antipodes
      Vec3 n = u.cross(v).normalized();
      if (n.dot(left + right) > 0) n = -n;  // from b to a is against the outward normals of A
      // Nearly parallel edges: the cross product has few digits, and its part along the edges would tilt the plane.
      n -= u * (n.dot(u) / u.squaredNorm());
      n -= v * (n.dot(v) / v.squaredNorm());
      n.normalize();
      if (n.dot(a.vertices[edge_a.tail] - b.vertices[edge_b.tail]) <= floor) continue;
      // Rounding may have let a pair pass that is no face; the gap that all corners leave is true in any case.
      offer({Kind::kEdges, i, j, n, lowest(a.vertices, n) + lowest(b.vertices, -n)});
    }
  }
}

// The axis of the largest gap; NaN wins.
SeparatingAxis separating_axis(const PosedPolyhedron& a, const PosedPolyhedron& b);

// The nearest points of two polyhedra that are apart or just touch. Where several pairs are equally near (to a few
// roundings) the mean of all: the middle of an edge or a face that they share, so that a body that lands flat is hit in
// the middle.
NearestPoints nearest_features(const PosedPolyhedron& a, const PosedPolyhedron& b);

}  // namespace plumbline
