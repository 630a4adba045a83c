#include "plumbline/core/broad_phase/bounding_volume.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace plumbline {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Aabb around(const Vec3& p_W, const Vec3& half_widths) { return {p_W - half_widths, p_W + half_widths}; }

Aabb box_of(const Sphere& sphere, const BodyState& state) { return around(state.p_WB, Vec3::Constant(sphere.radius)); }

Aabb box_of(const Box& box, const BodyState& state) {
  // The corner that reaches furthest along an axis has all its terms R_kj (+-s_j/2) positive.
  return around(state.p_WB, state.q_WB.toRotationMatrix().cwiseAbs() * (0.5 * box.size));
}

Aabb box_of(const HalfSpace& half_space, const BodyState& state) {
  Aabb all{Vec3::Constant(-kInf), Vec3::Constant(kInf)};
  for (int axis = 0; axis < 3; ++axis) {
    if (half_space.normal[axis] == 1) all.max[axis] = state.p_WB[axis];
    if (half_space.normal[axis] == -1) all.min[axis] = state.p_WB[axis];
  }
  return all;
}

Aabb box_of(const Cylinder& cylinder, const BodyState& state) {
  // Axis a, unit: the flat ends reach |a_k| h/2 along axis k, their rims another r sqrt(1 - a_k^2).
  const Vec3 axis = state.q_WB * Vec3::UnitZ();
  const Vec3 rim = (1 - axis.array().square()).max(0).sqrt() * cylinder.radius;
  return around(state.p_WB, 0.5 * cylinder.height * axis.cwiseAbs() + rim);
}

double radius_of(const Sphere& sphere) { return sphere.radius; }
double radius_of(const Box& box) { return 0.5 * box.size.norm(); }
double radius_of(const HalfSpace&) { return kInf; }
double radius_of(const Cylinder& cylinder) { return std::hypot(cylinder.radius, 0.5 * cylinder.height); }

}  // namespace

bool overlap(const BoundingSphere& a, const BoundingSphere& b) {
  const double reach = a.radius + b.radius;
  return (a.centre - b.centre).squaredNorm() <= reach * reach;
}

bool overlap(const BoundingSphere& sphere, const Aabb& box) {
  const Vec3 nearest = sphere.centre.cwiseMax(box.min).cwiseMin(box.max);
  return contains(sphere, nearest);
}

bool contains(const Aabb& box, const Vec3& point_W) {
  return (box.min.array() <= point_W.array()).all() && (point_W.array() <= box.max.array()).all();
}

bool contains(const BoundingSphere& sphere, const Vec3& point_W) {
  return (point_W - sphere.centre).squaredNorm() <= sphere.radius * sphere.radius;
}

Aabb merged(const Aabb& a, const Aabb& b) { return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)}; }

Aabb grown(const Aabb& box, double margin) { return {box.min.array() - margin, box.max.array() + margin}; }

Aabb bounding_box(const Shape& shape, const BodyState& state) {
  return std::visit([&](const auto& s) { return box_of(s, state); }, shape);
}

BoundingSphere bounding_sphere(const Shape& shape, const BodyState& state) {
  return {state.p_WB, std::visit([](const auto& s) { return radius_of(s); }, shape)};
}

Aabb bounding_box(std::span<const Vec3> points_W) {
  if (points_W.empty()) throw std::invalid_argument("no points to bound: give one at least");
  Aabb box{points_W[0], points_W[0]};
  for (std::size_t k = 0; k < points_W.size(); ++k) {
    if (points_W[k].hasNaN()) throw std::invalid_argument("point " + std::to_string(k) + " to bound is NaN");
    box = merged(box, {points_W[k], points_W[k]});
  }
  return box;
}

bool overlap(const Aabb& box, const HalfSpace& half_space, const Vec3& p_WB) {
  Vec3 lowest;
  for (int axis = 0; axis < 3; ++axis) lowest[axis] = half_space.normal[axis] > 0 ? box.min[axis] : box.max[axis];
  return half_space.normal.dot(lowest - p_WB) <= 0;
}

}  // namespace plumbline
