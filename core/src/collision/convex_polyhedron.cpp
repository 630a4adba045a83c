#include "plumbline/core/collision/convex_polyhedron.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {
namespace {

std::string number(std::size_t k) { return std::to_string(k); }

double diameter(std::span<const Vec3> points) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points) bounds.extend(p);
  return bounds.diagonal().norm();
}

// Half the sum of the cross products of successive corners: the area as a vector, whatever the shape of the loop
// (M. Newell). Seen from the first corner, so that a far origin costs no digits.
Vec3 area_vector(std::span<const Vec3> vertices, std::span<const std::size_t> loop) {
  Vec3 twice = Vec3::Zero();
  const Vec3& first = vertices[loop.front()];
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    twice += (vertices[loop[k]] - first).cross(vertices[loop[k + 1]] - first);
  }
  return 0.5 * twice;
}

ConvexPolyhedron::Face make_face(std::span<const Vec3> vertices, std::vector<std::size_t> loop) {
  const Vec3 normal = area_vector(vertices, loop).normalized();
  double height = 0;
  for (const std::size_t k : loop) height += normal.dot(vertices[k]);
  const double offset = height / static_cast<double>(loop.size());
  return {std::move(loop), normal, offset};
}

void require_convex(std::span<const Vec3> vertices, std::span<const ConvexPolyhedron::Face> faces) {
  const double slack = ConvexPolyhedron::kFlatness * diameter(vertices);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::size_t k : faces[f].corners) {
      if (!(std::abs(faces[f].normal_B.dot(vertices[k]) - faces[f].offset) <= slack)) {
        throw std::invalid_argument("face " + number(f) + " is not flat at corner " + number(k) +
                                    ": split it into triangles, or take convex_hull of the corners");
      }
    }
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      if (!(faces[f].normal_B.dot(vertices[k]) - faces[f].offset <= slack)) {
        throw std::invalid_argument("corner " + number(k) + " is in front of face " + number(f) +
                                    ": the solid is not convex, or the loop does not run counter-clockwise seen from "
                                    "outside; convex_hull of the corners makes both right");
      }
    }
  }
}

// Every edge is run through once in each direction, by the two faces that meet in it.
std::vector<ConvexPolyhedron::Edge> meeting_edges(std::span<const ConvexPolyhedron::Face> faces) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> face_of;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::vector<std::size_t>& loop = faces[f].corners;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (!face_of.insert({{loop[k], loop[(k + 1) % loop.size()]}, f}).second) {
        throw std::invalid_argument("faces " + number(f) + " and another run the same way along the edge from corner " +
                                    number(loop[k]) + ": one of the two loops must be turned round");
      }
    }
  }
  std::vector<ConvexPolyhedron::Edge> edges;
  for (const auto& [ends, left] : face_of) {
    const auto right = face_of.find({ends.second, ends.first});
    if (right == face_of.end()) {
      throw std::invalid_argument("the edge from corner " + number(ends.first) + " to " + number(ends.second) +
                                  " has one face only: the surface must be closed");
    }
    if (ends.first < ends.second) edges.push_back({ends.first, ends.second, left, right->second});
  }
  return edges;
}

}  // namespace

ConvexPolyhedron::ConvexPolyhedron(std::vector<Vec3> vertices_B, std::vector<std::vector<std::size_t>> loops)
    : vertices_B_(std::move(vertices_B)) {
  for (std::size_t k = 0; k < vertices_B_.size(); ++k) {
    if (!vertices_B_[k].allFinite()) throw std::invalid_argument("corner " + number(k) + " is not finite");
    radius_ = std::max(radius_, vertices_B_[k].norm());
  }
  std::vector<bool> used(vertices_B_.size(), false);
  for (std::vector<std::size_t>& loop : loops) {
    const std::string name = "face " + number(faces_.size());
    if (loop.size() < 3) throw std::invalid_argument(name + " has fewer than three corners");
    for (const std::size_t k : loop) {
      if (k >= vertices_B_.size()) throw std::invalid_argument(name + " names corner " + number(k) + ", which is not");
      used[k] = true;
    }
    faces_.push_back(make_face(vertices_B_, std::move(loop)));
  }
  const auto idle = std::find(used.begin(), used.end(), false);
  if (idle != used.end()) {
    throw std::invalid_argument("no face uses corner " + number(static_cast<std::size_t>(idle - used.begin())));
  }
  if (faces_.size() < 4) {
    throw std::invalid_argument(number(faces_.size()) + " faces close no solid: at least four are needed");
  }
  edges_ = meeting_edges(faces_);
  require_convex(vertices_B_, faces_);
}

ConvexPolyhedron box_polyhedron(const Vec3& size) {
  if (!(size.minCoeff() > 0) || !size.allFinite()) {
    throw std::invalid_argument("a box needs three edge lengths > 0 and finite");
  }
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) corners.push_back(box_corner(size, k));
  return {std::move(corners), {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
}

}  // namespace plumbline
