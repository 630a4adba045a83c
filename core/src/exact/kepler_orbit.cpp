#include "plumbline/core/exact/kepler_orbit.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plumbline {

using std::numbers::pi;

KeplerOrbit::KeplerOrbit(double strength, const Vec3& position, const Vec3& velocity)
    : strength_(strength), p0_(position), v0_(velocity), r0_(position.norm()) {
  const double bound = 2 / r0_ - velocity.squaredNorm() / strength;  // 1/a
  if (!(strength > 0 && std::isfinite(strength) && r0_ > 0 && bound > 0 && std::isfinite(bound)) ||
      !(position.cross(velocity).norm() > 0)) {
    throw std::invalid_argument(
        "an ellipse needs GM > 0, v0^2 < 2 GM/r0 and a velocity that does not point through the centre");
  }
  a_ = 1 / bound;
  n_ = std::sqrt(strength / a_) / a_;
  cosine_ = 1 - r0_ / a_;
  sine_ = position.dot(velocity) / std::sqrt(strength * a_);
  eccentricity_ = std::hypot(cosine_, sine_);
}

double KeplerOrbit::period() const { return 2 * pi / n_; }

// The root of F(x) = x - c sin x + s (1 - cos x) - n t, which rises everywhere (F' = r/a) and lies within 2 e of n t.
// Newton's steps, halved back into the bracket whenever they leave it.
double KeplerOrbit::anomaly_passed(double t) const {
  const double mean = n_ * t;
  double low = mean - 2, high = mean + 2, x = mean;
  for (int k = 0; k < 100; ++k) {
    const double half = std::sin(0.5 * x);
    // 1 - cos x as 2 sin^2(x/2): no digits are lost for small x.
    const double f = x - cosine_ * std::sin(x) + sine_ * 2 * half * half - mean;
    (f > 0 ? high : low) = x;
    const double slope = 1 - cosine_ * std::cos(x) + sine_ * std::sin(x);
    double next = x - f / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-16 * (1 + std::abs(x))) return next;
    x = next;
  }
  return x;  // the last digit may alternate; it is no better known
}

OrbitState KeplerOrbit::at(double t) const {
  t = std::remainder(t, period());
  const double x = anomaly_passed(t);
  const double half = std::sin(0.5 * x), versed = 2 * half * half;  // 1 - cos x
  const double r = a_ * (1 - cosine_ * std::cos(x) + sine_ * std::sin(x));
  const double f = 1 - a_ / r0_ * versed;
  // g = t - (x - sin x)/n, with Kepler's equation put in for t: both terms stay small for small x.
  const double g = (r0_ / a_ * std::sin(x) + sine_ * versed) / n_;
  const double f_rate = -std::sqrt(strength_ * a_) / (r * r0_) * std::sin(x), g_rate = 1 - a_ / r * versed;
  return {f * p0_ + g * v0_, f_rate * p0_ + g_rate * v0_};
}

}  // namespace plumbline
