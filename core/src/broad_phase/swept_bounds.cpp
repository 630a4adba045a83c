#include "plumbline/core/broad_phase/swept_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace plumbline {
namespace {

// Positions and attitudes are each a handful of roundings old when they are compared.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// The path of the centre of mass.
Aabb path_box(const Motion& motion, double duration) {
  if (!(duration >= 0 && std::isfinite(duration))) {
    throw std::invalid_argument("bounds over " + std::to_string(duration) + " s: the duration must be finite and >= 0");
  }
  if (!is_finite(motion.start) || !motion.a_W.allFinite()) {
    throw std::invalid_argument("bounds of a motion that is not finite: check its state and acceleration");
  }
  const auto at = [&](double t) -> Vec3 {
    return motion.start.p_WB + t * motion.start.v_WB + 0.5 * t * t * motion.a_W;
  };
  Aabb path = merged({at(0), at(0)}, {at(duration), at(duration)});
  for (int axis = 0; axis < 3; ++axis) {
    const double turn = -motion.start.v_WB[axis] / motion.a_W[axis];
    if (turn > 0 && turn < duration) path = merged(path, {at(turn), at(turn)});
  }
  return path;
}

double rounding(const Aabb& box) { return kRounding * box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff(); }

Vec3 swept_half_widths(const Sphere& sphere, const Motion&, double) { return Vec3::Constant(sphere.radius); }

Vec3 swept_half_widths(const Box& box, const Motion& motion, double duration) {
  const double radius = 0.5 * box.size.norm();
  const Vec3& w = motion.start.w_WB;
  const double angle = w.norm() * duration;
  if (angle == 0) return bounding_box(box, motion.start).max - motion.start.p_WB;
  if (angle >= std::numbers::pi) return Vec3::Constant(radius);

  const Vec3 half = 0.5 * box.size;
  const Quat turn = rotation_by(w * duration);
  const Mat3 R_start = motion.start.q_WB.toRotationMatrix(), R_end = (turn * motion.start.q_WB).toRotationMatrix();
  const Vec3 start = R_start.cwiseAbs() * half, end = R_end.cwiseAbs() * half;
  double arm = 0;  // of the corner furthest from the axis of rotation
  const Vec3 axis_B = R_start.transpose() * w.normalized();
  for (int k = 0; k < 8; ++k) arm = std::max(arm, axis_B.cross(box_corner(box.size, k)).norm());
  const double sine = std::sin(angle / 4);
  const double sagitta = 2 * arm * sine * sine;  // 1 - cos(h/2) without cancellation
  return (start.cwiseMax(end).array() + sagitta).min(radius);
}

// Whatever way it turns, its sphere holds it.
Vec3 swept_half_widths(const Cylinder& cylinder, const Motion&, double) {
  return Vec3::Constant(std::hypot(cylinder.radius, 0.5 * cylinder.height));
}

// Not used: a half-space bounds itself.
Vec3 swept_half_widths(const HalfSpace&, const Motion&, double) { return Vec3::Zero(); }

}  // namespace

Aabb swept_box(const Shape& shape, const Motion& motion, double duration) {
  const Aabb path = path_box(motion, duration);
  if (std::holds_alternative<HalfSpace>(shape)) return bounding_box(shape, motion.start);
  const Vec3 half = std::visit([&](const auto& s) { return swept_half_widths(s, motion, duration); }, shape);
  const Aabb box{path.min - half, path.max + half};
  return grown(box, rounding(box));
}

BoundingSphere swept_sphere(const Shape& shape, const Motion& motion, double duration) {
  const Aabb path = path_box(motion, duration);
  const double radius = bounding_sphere(shape, motion.start).radius;
  return {centre(path), 0.5 * (path.max - path.min).norm() + radius + rounding(path) + kRounding * radius};
}

}  // namespace plumbline
