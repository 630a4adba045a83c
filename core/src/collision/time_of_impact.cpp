#include "plumbline/core/collision/time_of_impact.hpp"

#include <cmath>

#include "conservative_advancement.hpp"

namespace plumbline {
namespace {

// First approaching root of gap + speed t + acceleration t^2/2.
std::optional<double> falling_root(double gap, double speed, double acceleration) {
  const bool approaches = speed < 0 || (speed == 0 && acceleration < 0);
  if (gap <= 0 && approaches) return 0.0;
  const double radicand = speed * speed - 2 * acceleration * gap;
  if (!(radicand >= 0)) return std::nullopt;
  const double slope = std::sqrt(radicand);
  if (speed < 0) {
    if (slope == 0 && acceleration > 0) return std::nullopt;  // stops exactly at the surface and turns back
    return 2 * gap / (slope - speed);
  }
  if (!(acceleration < 0)) return std::nullopt;
  return (speed + slope) / -acceleration;
}

}  // namespace

std::optional<double> point_meets_plane(const Motion& point, const Plane& plane) {
  return sphere_meets_plane(point, 0, plane);
}

std::optional<double> sphere_meets_plane(const Motion& sphere, double radius, const Plane& plane) {
  const Vec3& n = plane.normal_W;
  return falling_root(n.dot(sphere.start.p_WB) - plane.offset - radius, n.dot(sphere.start.v_WB), n.dot(sphere.a_W));
}

std::optional<double> sphere_meets_sphere(const Motion& a, double radius_a, const Motion& b, double radius_b,
                                          double horizon) {
  const Vec3 d = a.start.p_WB - b.start.p_WB, v = a.start.v_WB - b.start.v_WB, c = a.a_W - b.a_W;
  const double reach = radius_a + radius_b;
  if (c.squaredNorm() > 0) {
    // |d|'' = (v^2 - (v.d/|d|)^2)/|d| + c.d/|d| >= -|c|: sideways motion only ever bends the distance up.
    const auto distance = [&](double t) {
      const Vec3 at = d + t * v + 0.5 * t * t * c;
      const double length = at.norm();
      return Height{length - reach, at.dot(v + t * c) / length};
    };
    return advance(distance, c.norm(), kImpactTolerance * reach, horizon);
  }
  const double closing = -d.dot(v);
  if (!(closing > 0)) return std::nullopt;
  const double length = d.norm();
  const double clear = (length - reach) * (length + reach);
  if (clear <= 0) return 0.0;
  const double speed = v.norm(), miss = d.cross(v).norm();  // miss / speed: the distance at which they would pass
  const double radicand = (reach * speed - miss) * (reach * speed + miss);
  if (!(radicand > 0)) return std::nullopt;
  return clear / (closing + std::sqrt(radicand));
}

std::optional<double> corner_meets_plane(const Motion& body, const Vec3& r_B, const Plane& plane, double tolerance,
                                         double horizon) {
  const Vec3& n = plane.normal_W;
  const BodyState& s = body.start;
  const double gap = n.dot(s.p_WB) - plane.offset, speed = n.dot(s.v_WB), fall = n.dot(body.a_W);
  const Vec3 r_W = s.q_WB * r_B;
  const double turn = s.w_WB.norm();
  if (!(turn > 0)) return falling_root(gap + n.dot(r_W), speed, fall);
  // Under rotation about the axis e, r keeps its part along e; the rest turns: r_perp cos + (e x r) sin.
  const Vec3 axis = s.w_WB / turn;
  const Vec3 across = axis.cross(r_W);
  const double along = n.dot(axis) * axis.dot(r_W);
  const double cosine = n.dot(r_W) - along, sine = n.dot(across);
  const auto height = [&](double t) {
    const double co = std::cos(turn * t), si = std::sin(turn * t);
    return Height{gap + along + speed * t + 0.5 * fall * t * t + cosine * co + sine * si,
                  speed + fall * t + turn * (sine * co - cosine * si)};
  };
  const double bend = std::abs(fall) + turn * turn * std::hypot(cosine, sine);
  return advance(height, bend, tolerance, horizon);
}

std::optional<double> box_meets_plane(const Motion& box, const Vec3& size, const Plane& plane, double horizon) {
  std::optional<double> first;
  for (int k = 0; k < 8; ++k) {
    const auto t = corner_meets_plane(box, box_corner(size, k), plane, kImpactTolerance * size.norm(), horizon);
    if (t && *t <= horizon && (!first || *t < *first)) first = t;
  }
  return first;
}

Vec3 box_corner(const Vec3& size, int index) {
  return 0.5 * Vec3((index & 1) != 0 ? size.x() : -size.x(), (index & 2) != 0 ? size.y() : -size.y(),
                    (index & 4) != 0 ? size.z() : -size.z());
}

}  // namespace plumbline
