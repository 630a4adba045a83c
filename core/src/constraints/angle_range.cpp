#include "plumbline/core/constraints/angle_range.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plumbline {

namespace {

constexpr double kPi = std::numbers::pi;

struct Arms {
  Vec3 u, v;
};

Arms arms(std::span<const Vec3> p_W, const std::optional<Vec3>& axis_W) {
  Arms result{p_W[0] - p_W[1], p_W[2] - p_W[1]};
  if (axis_W) {
    result.u -= axis_W->dot(result.u) * *axis_W;
    result.v -= axis_W->dot(result.v) * *axis_W;
  }
  return result;
}

}  // namespace

AngleRange::AngleRange(std::size_t first, std::size_t joint, std::size_t third, double low, double high)
    : Constraint({first, joint, third}, low, high) {
  if (!(0 <= low && low <= high && high <= kPi))
    throw std::invalid_argument("an angle in space needs 0 <= low <= high <= pi; give an axis for signed angles");
}

AngleRange::AngleRange(std::size_t first, std::size_t joint, std::size_t third, double low, double high,
                       const Vec3& axis_W)
    : Constraint({first, joint, third}, -0.5 * (high - low), 0.5 * (high - low)),
      middle_(0.5 * (low + high)),
      axis_W_(axis_W.normalized()) {
  if (!(low <= high && high <= low + 2 * kPi))
    throw std::invalid_argument("an angle in a plane needs low <= high <= low + 2 pi, in radians");
  if (!(axis_W.norm() > 0)) throw std::invalid_argument("an angle in a plane needs an axis that is not zero");
}

double AngleRange::angle(std::span<const Vec3> p_W) const {
  const auto [u, v] = arms(p_W, axis_W_);
  const Vec3 across = u.cross(v);
  return std::atan2(axis_W_ ? axis_W_->dot(across) : across.norm(), u.dot(v));
}

double AngleRange::quantity(std::span<const Vec3> p_W) const {
  return axis_W_ ? std::remainder(angle(p_W) - middle_, 2 * kPi) : angle(p_W);
}

PerParticle AngleRange::gradient(std::span<const Vec3> p_W) const {
  const auto [u, v] = arms(p_W, axis_W_);
  Vec3 normal;  // q grows when v turns about it and u against it
  if (axis_W_) {
    normal = *axis_W_;
  } else {
    const Vec3 across = u.cross(v);
    normal = across.norm() == 0 ? Vec3(u.unitOrthogonal()) : Vec3(across.normalized());
  }
  const Vec3 at_u = -normal.cross(u) / u.squaredNorm();
  const Vec3 at_v = normal.cross(v) / v.squaredNorm();
  return {at_u, -(at_u + at_v), at_v};
}

}  // namespace plumbline
