#include "plumbline/core/mass/wrench_at_point.hpp"

namespace plumbline {

Vec3 torque_about(const Vec3& centre_W, const PointForce& force) { return (force.p_W - centre_W).cross(force.f_W); }

Wrench wrench_about(const Vec3& centre_W, const PointForce& force) {
  return {force.f_W, torque_about(centre_W, force)};
}

Wrench wrench_about(const Vec3& centre_W, std::span<const PointForce> forces) {
  Wrench sum;
  for (const PointForce& force : forces) sum = sum + wrench_about(centre_W, force);
  return sum;
}

Wrench moved_wrench(const Wrench& wrench, const Vec3& from_W, const Vec3& to_W) {
  return {wrench.f_W, wrench.tau_W + (from_W - to_W).cross(wrench.f_W)};
}

Wrench operator+(const Wrench& a, const Wrench& b) { return {a.f_W + b.f_W, a.tau_W + b.tau_W}; }

}  // namespace plumbline
