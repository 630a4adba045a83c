#include "plumbline/core/constraints/obstacle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline {

namespace {

Vec3 direction_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length == 0 ? otherwise : Vec3(v / length);
}

PointGap point_gap(const Sphere& sphere, const Obstacle& o, const Vec3& p_W) {
  const Vec3 r = p_W - o.p_WO;
  return {r.norm() - sphere.radius, direction_or(r, Vec3::UnitZ())};
}

PointGap point_gap(const HalfSpace& half_space, const Obstacle& o, const Vec3& p_W) {
  const Vec3 n = half_space.normal.normalized();
  return {n.dot(p_W - o.p_WO), n};
}

PointGap point_gap(const Box& box, const Obstacle& o, const Vec3& p_W) {
  const Vec3 r = o.q_WO.conjugate() * (p_W - o.p_WO);
  const Vec3 beyond = r.cwiseAbs() - 0.5 * box.size;  // positive beyond a pair of faces
  if (beyond.maxCoeff() > 0) {
    const Vec3 nearest = r.cwiseMax(-0.5 * box.size).cwiseMin(0.5 * box.size);
    return {(r - nearest).norm(), o.q_WO * (r - nearest).normalized()};
  }
  int axis = 0;
  const double depth = beyond.maxCoeff(&axis);
  const Vec3 n = Vec3::Unit(axis) * std::copysign(1.0, r[axis]);
  return {beyond.hasNaN() ? std::numeric_limits<double>::quiet_NaN() : depth, o.q_WO * n};
}

// keep_out.cpp refuses cylinders; who asks all the same gets what fails everywhere.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
PointGap point_gap(const Cylinder&, const Obstacle&, const Vec3&) { return {kUnknown, Vec3::UnitZ()}; }
LinkGap link_gap(const Cylinder&, const Obstacle&, const Vec3&, const Vec3&) { return {kUnknown, Vec3::UnitZ(), 0.5}; }

LinkGap link_gap(const Sphere& sphere, const Obstacle& o, const Vec3& a_W, const Vec3& b_W) {
  const Vec3 along = b_W - a_W;
  const double length2 = along.squaredNorm();
  const double s = length2 == 0 ? 0.5 : std::clamp((o.p_WO - a_W).dot(along) / length2, 0.0, 1.0);
  const Vec3 r = (1 - s) * a_W + s * b_W - o.p_WO;
  return {r.norm() - sphere.radius, direction_or(r, along.unitOrthogonal()), s};
}

LinkGap link_gap(const HalfSpace& half_space, const Obstacle& o, const Vec3& a_W, const Vec3& b_W) {
  const PointGap a = point_gap(half_space, o, a_W), b = point_gap(half_space, o, b_W);
  if (a.distance < b.distance) return {a.distance, a.normal_W, 0};
  return {b.distance, b.normal_W, a.distance == b.distance ? 0.5 : 1.0};
}

// In the box's axes: gap between the box and the link along the axis n, on the side on which the link lies.
LinkGap gap_along(const Vec3& axis, const Vec3& half, const Vec3& a, const Vec3& b) {
  const Vec3 n = axis.dot(a + b) < 0 ? Vec3(-axis) : axis;
  const double at_a = n.dot(a), at_b = n.dot(b);
  const double s = at_a < at_b ? 0.0 : at_a > at_b ? 1.0 : 0.5;
  return {std::min(at_a, at_b) - n.cwiseAbs().dot(half), n, s};
}

LinkGap link_gap(const Box& box, const Obstacle& o, const Vec3& a_W, const Vec3& b_W) {
  const Vec3 half = 0.5 * box.size;
  const Vec3 a = o.q_WO.conjugate() * (a_W - o.p_WO), b = o.q_WO.conjugate() * (b_W - o.p_WO);
  if (a.hasNaN() || b.hasNaN()) return {std::numeric_limits<double>::quiet_NaN(), Vec3::UnitZ(), 0.5};
  LinkGap deepest = gap_along(Vec3::UnitX(), half, a, b);
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = Vec3::Unit(k);
    const LinkGap face = gap_along(edge, half, a, b);
    if (face.distance > deepest.distance) deepest = face;
    const Vec3 across = edge.cross(b - a);
    if (across.norm() <= 1e-12 * (b - a).norm()) continue;  // link along the edge: the faces cover it
    LinkGap crossing = gap_along(across.normalized(), half, a, b);
    if (crossing.distance <= deepest.distance) continue;
    // Touching point: where the link passes nearest to the box's edge along k that supports this axis.
    Vec3 corner = half.cwiseProduct(crossing.normal_W.cwiseSign());
    corner[k] = 0;
    const Vec3 flat = (b - a) - edge.dot(b - a) * edge;
    crossing.s = std::clamp((corner - a).dot(flat) / flat.squaredNorm(), 0.0, 1.0);
    deepest = crossing;
  }
  deepest.normal_W = o.q_WO * deepest.normal_W;
  return deepest;
}

}  // namespace

PointGap gap_to_point(const Obstacle& obstacle, const Vec3& p_W) {
  return std::visit([&](const auto& shape) { return point_gap(shape, obstacle, p_W); }, obstacle.shape);
}

LinkGap gap_to_link(const Obstacle& obstacle, const Vec3& a_W, const Vec3& b_W) {
  return std::visit([&](const auto& shape) { return link_gap(shape, obstacle, a_W, b_W); }, obstacle.shape);
}

}  // namespace plumbline
