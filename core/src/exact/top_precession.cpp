#include "plumbline/core/exact/top_precession.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plumbline {
namespace {

double weight_moment(const TopBody& top) { return top.mass * top.gravity * top.arm_B.norm(); }

}  // namespace

PrecessionRates precession_rates(const TopBody& top, double theta, double spin) {
  if (!(theta > 0 && theta < std::numbers::pi) || !(std::abs(spin) > 0 && std::isfinite(spin))) {
    throw std::invalid_argument("steady precession needs an angle in (0, pi) and a spin that is not 0");
  }
  const double a = transverse_inertia_at_pivot(top) * std::cos(theta);
  const double b = top.inertia_axial * spin, c = weight_moment(top);
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) {
    throw std::invalid_argument(
        "the top spins too slowly to precess steadily at this angle: (I3 w3)^2 must reach "
        "4 I1 m g l cos(theta)");
  }
  // Of the two quotients c/q and q/a neither subtracts.
  const double q = 0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  return {c / q, a == 0 ? std::copysign(std::numeric_limits<double>::infinity(), b) : q / a};
}

BodyState precessing_state(const TopBody& top, double theta, double spin, double rate, const Vec3& pivot_W) {
  BodyState state;
  state.q_WB = rotation_by(Vec3(theta, 0, 0)) * Quat::FromTwoVectors(top.arm_B, Vec3::UnitZ());
  const Vec3 r_W = state.q_WB * top.arm_B, axis_W = r_W.normalized();
  state.w_WB = spin * axis_W + rate * (Vec3::UnitZ() - axis_W.z() * axis_W);
  state.p_WB = pivot_W + r_W;
  state.v_WB = state.w_WB.cross(r_W);
  return state;
}

double sleeping_spin(const TopBody& top) {
  return 2 * std::sqrt(transverse_inertia_at_pivot(top) * weight_moment(top)) / top.inertia_axial;
}

}  // namespace plumbline
