#include "plumbline/core/constraints/constraint_events.hpp"

#include "plumbline/core/constraints/first_crossing.hpp"

namespace plumbline {

Flight after(const Flight& flight, double t) {
  return {flight.p_W + (flight.v_W + 0.5 * t * flight.a_W) * t, flight.v_W + t * flight.a_W, flight.a_W};
}

std::array<double, 5> distance_quartic(const Flight& flight, const Vec3& centre_W, double radius) {
  const Vec3 r = flight.p_W - centre_W;
  const Vec3 &v = flight.v_W, &a = flight.a_W;
  // r^2 - R^2 as a product, which keeps its digits near the sphere.
  return {(r.norm() - radius) * (r.norm() + radius), 2 * r.dot(v), v.squaredNorm() + r.dot(a), v.dot(a),
          0.25 * a.squaredNorm()};
}

std::optional<double> flight_enters_sphere(const Flight& flight, const Vec3& centre_W, double radius) {
  const auto quartic = distance_quartic(flight, centre_W, radius);
  return first_crossing(quartic, zeros_bound(quartic));
}

std::optional<double> flight_leaves_sphere(const Flight& flight, const Vec3& centre_W, double radius) {
  auto quartic = distance_quartic(flight, centre_W, radius);
  for (double& c : quartic) c = -c;
  return first_crossing(quartic, zeros_bound(quartic));
}

Vec3 rebound(const Vec3& v_W, const Vec3& normal_W, double restitution) {
  const double along = normal_W.dot(v_W);
  return along < 0 ? Vec3(v_W - (1 + restitution) * along * normal_W) : v_W;
}

}  // namespace plumbline
