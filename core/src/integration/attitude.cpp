#include "plumbline/core/integration/attitude.hpp"

#include <cmath>

namespace plumbline {

Quat turned(const Quat& q_WB, const Vec3& phi_W) { return (rotation_by(phi_W) * q_WB).normalized(); }

Vec3 dexp_inverse(const Vec3& phi, const Vec3& w) {
  const double x = phi.norm();
  // The closed form loses 2 eps/x^2 to cancellation, the series misses x^6/1209600: at 0.05 both are near 1e-14, times
  // the x^2 of the double cross product.
  const double c = x < 0.05 ? 1.0 / 12 + x * x / 720 + x * x * x * x / 30240
                            : (1 - 0.5 * x * std::cos(0.5 * x) / std::sin(0.5 * x)) / (x * x);
  const Vec3 phi_w = phi.cross(w);
  return w - 0.5 * phi_w + c * phi.cross(phi_w);
}

}  // namespace plumbline
