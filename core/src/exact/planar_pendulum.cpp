#include "plumbline/core/exact/planar_pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "plumbline/core/exact/elliptic_integral.hpp"

namespace plumbline {

using std::numbers::pi;

PlanarPendulum::PlanarPendulum(double w0, const PendulumState& initial) : w0_(w0) {
  if (!(w0 > 0 && std::isfinite(w0) && std::isfinite(initial.angle) && std::isfinite(initial.rate))) {
    throw std::invalid_argument("a pendulum needs w0 > 0 and a finite angle and rate");
  }
  turns0_ = std::nearbyint(initial.angle / (2 * pi));
  const double half = 0.5 * (initial.angle - 2 * pi * turns0_);
  const double s = std::sin(half), c = std::cos(half), speed = 0.5 * initial.rate / w0;
  k_ = std::hypot(s, speed);
  // 1 - k^2 without 1 - sin^2, which would lose the digits of a pendulum that starts near the top.
  const double complement = (std::abs(c) - std::abs(speed)) * (std::abs(c) + std::abs(speed));
  rotates_ = complement < 0;
  if (rotates_) {
    sense_ = initial.rate < 0 ? -1 : 1;
    modulus_ = {std::min(1.0, 1 / (k_ * k_)), -complement / (k_ * k_)};
    u0_ = elliptic_f(sense_ * half, modulus_);
    return;
  }
  modulus_ = {std::min(1.0, k_ * k_), complement};
  // sn = s/k, cn = speed/k. At rest hanging, k = 0 and both are 0: u0 = 0 will do.
  u0_ = complement == 0 ? std::asinh(s / std::abs(c)) : elliptic_f(std::atan2(s, speed), modulus_);
  if (complement == 0 && speed < 0) sense_ = -1;
}

PendulumState PlanarPendulum::at(double t) const {
  const double start = 2 * pi * turns0_;
  if (rotates_) {
    const JacobiElliptic j = jacobi_elliptic(u0_ + k_ * w0_ * t, modulus_);
    return {start + sense_ * 2 * j.amplitude(), sense_ * 2 * k_ * w0_ * j.dn};
  }
  if (modulus_.complement == 0) {
    const double u = u0_ + sense_ * w0_ * t;
    return {start + 2 * std::atan(std::sinh(u)), sense_ * 2 * w0_ / std::cosh(u)};
  }
  const JacobiElliptic j = jacobi_elliptic(u0_ + w0_ * t, modulus_);
  // cos(theta/2) = dn: the arc sine alone would lose digits near the top.
  return {start + 2 * std::atan2(k_ * j.sn, j.dn), 2 * k_ * w0_ * j.cn};
}

double PlanarPendulum::period() const {
  if (modulus_.complement == 0) return std::numeric_limits<double>::infinity();
  const double quarter = complete_elliptic_k(modulus_) / w0_;
  return rotates_ ? 2 * quarter / k_ : 4 * quarter;
}

}  // namespace plumbline
