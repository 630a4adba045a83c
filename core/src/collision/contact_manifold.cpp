#include "plumbline/core/collision/contact_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {
namespace {

using Face = ConvexPolyhedron::Face;

// A polyhedron in place. All lengths in W.
struct Solid {
  std::vector<Vec3> corners;
  std::vector<Vec3> normals;          // of the faces
  std::vector<Vec3> edge_directions;  // unit, no two parallel
  const ConvexPolyhedron& shape;      // whose corners form which faces and edges
  double size;

  double lowest(const Vec3& n) const {
    double result = n.dot(corners[0]);
    for (const Vec3& c : corners) result = std::min(result, n.dot(c));
    return result;
  }
  double highest(const Vec3& n) const { return -lowest(-n); }
  const Vec3& a_corner_of(std::size_t face) const { return corners[shape.faces()[face].corners[0]]; }
};

// Two unit edges, turned to point the same way, span the direction u x v = u x (v - u). Written with the difference, it
// is at right angles to both to rounding even when they are nearly parallel.
Vec3 across(const Vec3& u, const Vec3& v) { return u.cross(u.dot(v) < 0 ? Vec3(-v - u) : Vec3(v - u)); }

Solid placed(const ConvexPolyhedron& shape, const BodyState& s) {
  Solid solid{{}, {}, {}, shape, 2 * shape.radius()};
  for (const Vec3& v : shape.vertices_B()) solid.corners.push_back(s.p_WB + s.q_WB * v);
  for (const Face& f : shape.faces()) solid.normals.push_back(s.q_WB * f.normal_B);
  for (const auto& e : shape.edges()) {
    const Vec3 d = (solid.corners[e.head] - solid.corners[e.tail]).normalized();
    const auto parallel = [&](const Vec3& other) { return across(other, d).norm() < kParallelAngle; };
    if (std::none_of(solid.edge_directions.begin(), solid.edge_directions.end(), parallel)) {
      solid.edge_directions.push_back(d);
    }
  }
  return solid;
}

// All boxes have the faces and edges of one cube.
Solid placed(const Vec3& size, const BodyState& s) {
  static const ConvexPolyhedron cube = box_polyhedron(Vec3::Ones());
  const Mat3 axes = s.q_WB.toRotationMatrix();
  Solid solid{{}, {}, {axes.col(0), axes.col(1), axes.col(2)}, cube, size.norm()};
  for (int k = 0; k < 8; ++k) solid.corners.push_back(s.p_WB + axes * box_corner(size, k));
  for (const Face& f : cube.faces()) solid.normals.push_back(axes * f.normal_B);
  return solid;
}

struct FaceAxis {
  double separation;  // of the other body from the plane of the face [m]
  std::size_t face;
};

// The face of `solid` from whose plane `other` is farthest, among those whose normal `allows`.
template <typename Filter>
FaceAxis best_face(const Solid& solid, const Solid& other, const Filter& allows) {
  FaceAxis best{-std::numeric_limits<double>::infinity(), 0};
  for (std::size_t f = 0; f < solid.normals.size(); ++f) {
    const Vec3& n = solid.normals[f];
    if (!allows(n)) continue;
    const double separation = other.lowest(n) - n.dot(solid.a_corner_of(f));
    if (separation > best.separation) best = {separation, f};
  }
  return best;
}

struct EdgeAxis {
  double separation = -std::numeric_limits<double>::infinity();
  Vec3 normal_W = Vec3::Zero();                                 // from b to a
  Vec3 direction_a = Vec3::Zero(), direction_b = Vec3::Zero();  // of the two edges
};

EdgeAxis best_edges(const Solid& a, const Solid& b) {
  EdgeAxis best;
  for (const Vec3& u : a.edge_directions) {
    for (const Vec3& v : b.edge_directions) {
      Vec3 n = across(u, v);
      const double length = n.norm();
      if (length < kParallelAngle) continue;  // parallel edges: what touches there touches along a face's normal
      n /= length;
      const double a_above = a.lowest(n) - b.highest(n), b_above = b.lowest(n) - a.highest(n);
      if (a_above > best.separation) best = {a_above, n, u, v};
      if (b_above > best.separation) best = {b_above, -n, u, v};
    }
  }
  return best;
}

// What is left of a polygon on the inner side of a plane through `on`. Corners within `slack` of the plane count as on
// it: rounding must not cut off a corner that lies on the rim.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& inward, const Vec3& on, double slack) {
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &x = polygon[k], &next = polygon[(k + 1) % polygon.size()];
    const double d = inward.dot(x - on), d_next = inward.dot(next - on);
    if (d >= -slack) result.push_back(x);
    if ((d > slack && d_next < -slack) || (d < -slack && d_next > slack)) {
      result.push_back(x + d / (d - d_next) * (next - x));
    }
  }
  return result;
}

// The face of `solid` that looks most against n, of those that meet in its lowest corner along n.
std::size_t facing(const Solid& solid, const Vec3& n) {
  const auto lower = [&](const Vec3& x, const Vec3& y) { return n.dot(x) < n.dot(y); };
  const auto corner = static_cast<std::size_t>(std::min_element(solid.corners.begin(), solid.corners.end(), lower) -
                                               solid.corners.begin());
  const std::vector<Face>& faces = solid.shape.faces();
  std::size_t best = faces.size();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (std::find(faces[f].corners.begin(), faces[f].corners.end(), corner) == faces[f].corners.end()) continue;
    if (best == faces.size() || solid.normals[f].dot(n) < solid.normals[best].dot(n)) best = f;
  }
  return best;
}

std::vector<Vec3> polygon_of(const Solid& solid, std::size_t face) {
  std::vector<Vec3> polygon;
  for (const std::size_t k : solid.shape.faces()[face].corners) polygon.push_back(solid.corners[k]);
  return polygon;
}

double distance_to_line(const Vec3& x, const Vec3& tail, const Vec3& head) {
  return (head - tail).normalized().cross(x - tail).norm();
}

// Two faces that look at each other, `low` with the unit normal n and `high`, tilted a little, with -n_high nearly n.
// At the corner x of their common polygon a corner of `high` touches the face `low`, along n; or a corner of `low` the
// face `high`, along -n_high; or an edge an edge, along their cross product.
Vec3 normal_at(const Vec3& x, const std::vector<Vec3>& low, const Vec3& n, const std::vector<Vec3>& high,
               const Vec3& n_high, double slack) {
  for (const Vec3& corner : high) {
    if ((x - corner).norm() <= slack) return n;
  }
  for (const Vec3& corner : low) {
    if (n.cross(x - corner).norm() <= slack) return -n_high;
  }
  const auto edge_through = [](const std::vector<Vec3>& polygon, const Vec3& point) {
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 edge = Vec3::Zero();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 &tail = polygon[k], &head = polygon[(k + 1) % polygon.size()];
      const double distance = distance_to_line(point, tail, head);
      if (distance < nearest) {
        nearest = distance;
        edge = (head - tail).normalized();
      }
    }
    return edge;
  };
  const Vec3 foot = x - n.dot(x - low[0]) * n;
  const Vec3 crossed = across(edge_through(low, foot), edge_through(high, x));
  // Where two edges touch, their normal lies between those of the faces, give or take the tilt. Edges that are nearly
  // parallel span other directions; then corners close by tell the same, and the face's normal will do.
  const double length = crossed.norm(), tilt = (n + n_high).norm();
  if (length < kParallelAngle) return n;
  const Vec3 normal = crossed / (n.dot(crossed) < 0 ? -length : length);
  return (normal - n).norm() <= 2 * tilt ? normal : n;
}

// `side` = +1 where the face belongs to body b, so that its normal points to a; -1 where it is a's.
std::vector<Contact> face_contacts(const Solid& solid, std::size_t face, const Solid& other, double side) {
  const Vec3& n = solid.normals[face];
  const double slack = 1e-10 * (solid.size + other.size);  // far above rounding, far below any size
  const std::size_t opposite = facing(other, n);
  const std::vector<Vec3> low = polygon_of(solid, face), high = polygon_of(other, opposite);
  std::vector<Vec3> common = high;
  for (std::size_t k = 0; k < low.size() && !common.empty(); ++k) {
    const Vec3 &tail = low[k], &head = low[(k + 1) % low.size()];
    common = clipped(common, n.cross(head - tail).normalized(), tail, slack);
  }
  std::vector<Contact> contacts;
  for (const Vec3& x : common) {
    const double height = n.dot(x - low[0]);
    const Vec3 normal = normal_at(x, low, n, high, other.normals[opposite], slack);
    contacts.push_back({0, 0, x - 0.5 * height * n, side * normal, height * n.dot(normal)});
  }
  return contacts;
}

// Of the edges of that direction, the one that is lowest along n; from its tail to its head.
std::pair<Vec3, Vec3> lowest_edge(const Solid& solid, const Vec3& direction, const Vec3& n) {
  std::pair<Vec3, Vec3> lowest;
  double height = std::numeric_limits<double>::infinity();
  for (const auto& e : solid.shape.edges()) {
    const Vec3 &tail = solid.corners[e.tail], &head = solid.corners[e.head];
    if (across(direction, (head - tail).normalized()).norm() >= kParallelAngle) continue;
    if (n.dot(tail + head) < height) {
      height = n.dot(tail + head);
      lowest = {tail, head};
    }
  }
  return lowest;
}

// Seen along the normal, the two edges cross: at the share s of a's edge, where it meets the plane that holds b's.
Contact edge_contact(const Solid& a, const Solid& b, const EdgeAxis& axis) {
  const Vec3& n = axis.normal_W;
  const auto [tail_a, head_a] = lowest_edge(a, axis.direction_a, n);
  const auto [tail_b, head_b] = lowest_edge(b, axis.direction_b, -n);
  const auto point_on = [&n](const Vec3& tail, const Vec3& head, const Vec3& other_tail, const Vec3& other_head) {
    const Vec3 m = n.cross(other_head - other_tail);
    const double s = m.dot(other_tail - tail) / m.dot(head - tail);
    return Vec3(tail + std::clamp(s, 0.0, 1.0) * (head - tail));
  };
  const Vec3 on_a = point_on(tail_a, head_a, tail_b, head_b), on_b = point_on(tail_b, head_b, tail_a, head_a);
  return {0, 0, 0.5 * (on_a + on_b), n, n.dot(on_a - on_b)};
}

std::vector<Contact> contacts_of(const Solid& a, const Solid& b) {
  const auto any = [](const Vec3&) { return true; };
  FaceAxis of_a = best_face(a, b, any), of_b = best_face(b, a, any);
  const EdgeAxis edges = best_edges(a, b);
  // A corner on a rim touches along faces and edges alike: then the face is taken.
  const double preference = 1e-12 * (a.size + b.size);
  if (edges.separation > std::max(of_a.separation, of_b.separation) + preference) {
    const auto alike = [&](const Vec3& n) { return n.cross(edges.normal_W).norm() < kLyingAngle; };
    const auto alike_a = [&](const Vec3& n) { return n.dot(edges.normal_W) < 0 && alike(n); };
    const auto alike_b = [&](const Vec3& n) { return n.dot(edges.normal_W) > 0 && alike(n); };
    of_a = best_face(a, b, alike_a);
    of_b = best_face(b, a, alike_b);
    if (std::isinf(std::max(of_a.separation, of_b.separation))) return {edge_contact(a, b, edges)};
  }
  return of_b.separation >= of_a.separation ? face_contacts(b, of_b.face, a, 1) : face_contacts(a, of_a.face, b, -1);
}

}  // namespace

std::vector<Contact> box_box_contacts(const BodyState& a, const Vec3& size_a, const BodyState& b, const Vec3& size_b) {
  return contacts_of(placed(size_a, a), placed(size_b, b));
}

std::vector<Contact> convex_contacts(const ConvexPolyhedron& a, const BodyState& state_a, const ConvexPolyhedron& b,
                                     const BodyState& state_b) {
  return contacts_of(placed(a, state_a), placed(b, state_b));
}

}  // namespace plumbline
