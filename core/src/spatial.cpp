#include "plumbline/core/spatial.hpp"

#include <cmath>

namespace plumbline {

double geodesic_angle(const Quat& a, const Quat& b) {
  const Quat d = a.conjugate() * b;
  return 2.0 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

Quat rotation_by(const Vec3& phi) {
  const double angle = phi.norm();
  // sin(x/2)/x -> 1/2 - x^2/48: below 1e-4 the next term of the series is under 1e-18.
  const double half_sinc = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  const Vec3 v = half_sinc * phi;
  return Quat(std::cos(0.5 * angle), v.x(), v.y(), v.z());
}

Mat3 cross_matrix(const Vec3& r) {
  Mat3 m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

}  // namespace plumbline
