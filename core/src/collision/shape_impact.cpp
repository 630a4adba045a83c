#include "plumbline/core/collision/shape_impact.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "plumbline/core/collision/polyhedron_impact.hpp"
#include "plumbline/core/collision/sphere_box_impact.hpp"

namespace plumbline {
namespace {

Vec3 position(const Motion& m, double t) { return m.start.p_WB + t * m.start.v_WB + 0.5 * t * t * m.a_W; }

std::optional<Touch> reversed(std::optional<Touch> touch) {
  if (touch) touch->normal_W = -touch->normal_W;
  return touch;
}

std::optional<Touch> meet(const Sphere& a, const Motion& motion_a, const Sphere& b, const Motion& motion_b,
                          double horizon) {
  const auto t = sphere_meets_sphere(motion_a, a.radius, motion_b, b.radius, horizon);
  if (!t || !(*t <= horizon)) return std::nullopt;
  const Vec3 centre_b = position(motion_b, *t), d = position(motion_a, *t) - centre_b;
  const double distance = d.norm();
  Touch touch{*t, centre_b, Vec3::UnitZ()};
  if (distance > 0) touch.normal_W = d / distance;
  touch.point_W += 0.5 * (b.radius + distance - a.radius) * touch.normal_W;
  return touch;
}

std::optional<Touch> meet(const Sphere& a, const Motion& motion_a, const Box& b, const Motion& motion_b,
                          double horizon) {
  return sphere_meets_box(motion_a, a.radius, motion_b, b.size, horizon);
}

std::optional<Touch> meet(const Box& a, const Motion& motion_a, const Sphere& b, const Motion& motion_b,
                          double horizon) {
  return reversed(sphere_meets_box(motion_b, b.radius, motion_a, a.size, horizon));
}

std::optional<Touch> meet(const Box& a, const Motion& motion_a, const Box& b, const Motion& motion_b, double horizon) {
  return polyhedron_meets_polyhedron(box_polyhedron(a.size), motion_a, box_polyhedron(b.size), motion_b, horizon);
}

Plane surface(const HalfSpace& half_space, const Motion& motion) {
  return {half_space.normal, half_space.normal.dot(motion.start.p_WB)};
}

std::optional<Touch> meet(const Sphere& a, const Motion& motion_a, const HalfSpace& b, const Motion& motion_b,
                          double horizon) {
  const Plane plane = surface(b, motion_b);
  const auto t = sphere_meets_plane(motion_a, a.radius, plane);
  if (!t || !(*t <= horizon)) return std::nullopt;
  const Vec3 centre = position(motion_a, *t);
  return Touch{*t, centre - (plane.normal_W.dot(centre) - plane.offset) * plane.normal_W, plane.normal_W};
}

// The mean of the corners that touch together: the middle of an edge or face that lands flat.
std::optional<Touch> meet(const Box& a, const Motion& motion_a, const HalfSpace& b, const Motion& motion_b,
                          double horizon) {
  const Plane plane = surface(b, motion_b);
  const auto t = box_meets_plane(motion_a, a.size, plane, horizon);
  if (!t) return std::nullopt;
  const Vec3 centre = position(motion_a, *t);
  const Quat attitude = rotation_by(*t * motion_a.start.w_WB) * motion_a.start.q_WB;
  std::array<Vec3, 8> corners;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 8; ++k) {
    corners[k] = centre + attitude * box_corner(a.size, static_cast<int>(k));
    lowest = std::min(lowest, plane.normal_W.dot(corners[k]));
  }
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const Vec3& corner : corners) {
    if (plane.normal_W.dot(corner) > lowest + 10 * kImpactTolerance * a.size.norm()) continue;
    sum += corner;
    ++count;
  }
  return Touch{*t, sum / count, plane.normal_W};
}

template <typename Shape>
std::optional<Touch> meet(const HalfSpace& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                          double horizon) {
  return reversed(meet(b, motion_b, a, motion_a, horizon));
}

std::optional<Touch> meet(const HalfSpace&, const Motion&, const HalfSpace&, const Motion&, double) {
  return std::nullopt;
}

// Never called: shapes_meet refuses cylinders before it asks who meets whom.
template <typename Shape>
std::optional<Touch> meet(const Cylinder&, const Motion&, const Shape&, const Motion&, double) {
  return std::nullopt;
}
template <typename Shape>
std::optional<Touch> meet(const Shape&, const Motion&, const Cylinder&, const Motion&, double) {
  return std::nullopt;
}
std::optional<Touch> meet(const Cylinder&, const Motion&, const Cylinder&, const Motion&, double) {
  return std::nullopt;
}
std::optional<Touch> meet(const HalfSpace&, const Motion&, const Cylinder&, const Motion&, double) {
  return std::nullopt;
}

}  // namespace

std::optional<Touch> shapes_meet(const Shape& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                                 double horizon) {
  if (std::holds_alternative<Cylinder>(a) || std::holds_alternative<Cylinder>(b)) {
    throw std::invalid_argument(
        "the time of impact of a cylinder cannot be computed; take a sphere, box or polyhedron");
  }
  return std::visit(
      [&](const auto& shape_a, const auto& shape_b) { return meet(shape_a, motion_a, shape_b, motion_b, horizon); }, a,
      b);
}

}  // namespace plumbline
