// The hull is kept as triangles while it grows; coplanar ones become one face at the end.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "plumbline/core/collision/convex_polyhedron.hpp"

namespace plumbline {
namespace {

using Points = std::span<const Vec3>;
using DirectedEdge = std::pair<std::size_t, std::size_t>;

struct Triangle {
  std::array<std::size_t, 3> corners;  // counter-clockwise from outside
  Vec3 normal;
  double offset, area;

  Triangle(Points points, std::size_t i, std::size_t j, std::size_t k) : corners{i, j, k} {
    const Vec3 cross = (points[j] - points[i]).cross(points[k] - points[i]);
    area = 0.5 * cross.norm();
    normal = cross.normalized();
    offset = normal.dot(points[i]);
  }
  double height(const Vec3& p) const { return normal.dot(p) - offset; }
  std::array<DirectedEdge, 3> edges() const {
    return {{{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[0]}}};
  }
};

template <typename Measure>
std::size_t farthest(Points points, const Measure& measure) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (measure(points[k]) > measure(points[best])) best = k;
  }
  return best;
}

// Four points far from each other: farthest from the first, then from the line of these two, then from the plane.
std::vector<Triangle> first_tetrahedron(Points points, double slack) {
  const std::size_t i = farthest(points, [&](const Vec3& p) { return (p - points[0]).norm(); });
  const Vec3& a = points[i];
  const std::size_t j = farthest(points, [&](const Vec3& p) { return (p - a).norm(); });
  const Vec3 along = (points[j] - a).normalized();
  const std::size_t k = farthest(points, [&](const Vec3& p) { return (p - a).cross(along).norm(); });
  const Vec3 up = along.cross(points[k] - a).normalized();
  const std::size_t l = farthest(points, [&](const Vec3& p) { return std::abs(up.dot(p - a)); });
  const double height = up.dot(points[l] - a);
  if (!(std::abs(height) > slack)) {
    throw std::invalid_argument("all " + std::to_string(points.size()) +
                                " points lie in one plane: a solid needs a point outside it");
  }
  const auto [p, q] = height < 0 ? std::pair(j, k) : std::pair(k, j);  // the fourth point is behind the first triangle
  return {{points, i, p, q}, {points, i, l, p}, {points, p, l, q}, {points, q, l, i}};
}

// What the new point sees is replaced by the cone from it to the rim of what it sees.
void add_point(Points points, std::size_t index, double slack, std::vector<Triangle>& hull) {
  const auto seen =
      std::partition(hull.begin(), hull.end(), [&](const Triangle& t) { return !(t.height(points[index]) > slack); });
  std::set<DirectedEdge> edges;
  for (auto t = seen; t != hull.end(); ++t) {
    for (const DirectedEdge& e : t->edges()) edges.insert(e);
  }
  hull.erase(seen, hull.end());
  for (const auto& [tail, head] : edges) {
    if (!edges.contains({head, tail})) hull.emplace_back(points, tail, head, index);
  }
}

// For each triangle the number of its face: spreading from the largest triangle that is left over the neighbours that
// lie in its plane.
std::vector<std::size_t> face_numbers(Points points, double slack, const std::vector<Triangle>& hull) {
  std::map<DirectedEdge, std::size_t> owner;
  for (std::size_t t = 0; t < hull.size(); ++t) {
    for (const DirectedEdge& e : hull[t].edges()) owner[e] = t;
  }
  std::vector<std::size_t> by_area(hull.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::stable_sort(by_area.begin(), by_area.end(), [&](auto s, auto t) { return hull[s].area > hull[t].area; });

  const std::size_t none = hull.size();
  std::vector<std::size_t> face(hull.size(), none);
  std::size_t count = 0;
  for (const std::size_t seed : by_area) {
    if (face[seed] != none) continue;
    std::vector<std::size_t> open{seed};
    face[seed] = count;
    while (!open.empty()) {
      const std::size_t t = open.back();
      open.pop_back();
      for (const auto& [tail, head] : hull[t].edges()) {
        const std::size_t next = owner.at({head, tail});
        const bool flat = std::all_of(hull[next].corners.begin(), hull[next].corners.end(),
                                      [&](std::size_t k) { return std::abs(hull[seed].height(points[k])) <= slack; });
        if (face[next] != none || !flat) continue;
        face[next] = count;
        open.push_back(next);
      }
    }
    ++count;
  }
  return face;
}

// The rims of the faces. A point where only two faces meet lies on an edge and is no corner.
std::vector<std::vector<std::size_t>> face_loops(const std::vector<Triangle>& hull,
                                                 const std::vector<std::size_t>& face) {
  std::map<std::size_t, std::map<std::size_t, std::size_t>> rim;  // face -> tail -> head
  std::map<std::size_t, std::set<std::size_t>> faces_at;
  std::set<std::pair<std::size_t, DirectedEdge>> edges;
  for (std::size_t t = 0; t < hull.size(); ++t) {
    for (const DirectedEdge& e : hull[t].edges()) {
      edges.insert({face[t], e});
      faces_at[e.first].insert(face[t]);
    }
  }
  for (const auto& [f, e] : edges) {
    if (!edges.contains({f, {e.second, e.first}})) rim[f][e.first] = e.second;
  }
  std::vector<std::vector<std::size_t>> loops;
  for (const auto& [f, next] : rim) {
    std::vector<std::size_t> loop;
    std::size_t k = next.begin()->first;
    for (std::size_t step = 0; step < next.size(); ++step) {
      if (faces_at[k].size() >= 3) loop.push_back(k);
      const auto found = next.find(k);
      if (found == next.end()) throw std::invalid_argument("the points are too nearly flat to tell their faces apart");
      k = found->second;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

ConvexPolyhedron convex_hull(Points points) {
  if (points.size() < 4) {
    throw std::invalid_argument(std::to_string(points.size()) + " points span no solid: at least four are needed");
  }
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points) {
    if (!p.allFinite()) throw std::invalid_argument("a point of the cloud is not finite");
    bounds.extend(p);
  }
  const double slack = 0.25 * ConvexPolyhedron::kFlatness * bounds.diagonal().norm();
  std::vector<Triangle> hull = first_tetrahedron(points, slack);
  for (std::size_t k = 0; k < points.size(); ++k) add_point(points, k, slack, hull);

  std::vector<std::vector<std::size_t>> loops = face_loops(hull, face_numbers(points, slack, hull));
  std::map<std::size_t, std::size_t> renumbered;
  std::vector<Vec3> corners;
  for (std::vector<std::size_t>& loop : loops) {
    for (std::size_t& k : loop) {
      const auto [place, is_new] = renumbered.insert({k, corners.size()});
      if (is_new) corners.push_back(points[k]);
      k = place->second;
    }
  }
  return {std::move(corners), std::move(loops)};
}

}  // namespace plumbline
