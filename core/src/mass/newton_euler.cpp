#include "plumbline/core/mass/newton_euler.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace plumbline {

Vec3 angular_acceleration(const Mat3& inertia, const Mat3& inverse_inertia, const Vec3& w, const Vec3& torque) {
  return inverse_inertia * (torque - w.cross(inertia * w));
}

Vec3 angular_acceleration(const Mat3& inertia, const Vec3& w, const Vec3& torque) {
  Mat3 inverse;
  bool invertible = false;
  inertia.computeInverseWithCheck(inverse, invertible, 1e-14 * std::pow(inertia.norm(), 3));
  if (!invertible) {
    throw std::invalid_argument("the inertia tensor has no inverse: about some axis the body has no inertia");
  }
  return angular_acceleration(inertia, inverse, w, torque);
}

Vec3 torque_for(const Mat3& inertia, const Vec3& w, const Vec3& alpha) {
  return inertia * alpha + w.cross(inertia * w);
}

double moment_about_axis(const MassProperties& body, const Vec3& point, const Vec3& axis) {
  if (!(std::abs(axis.norm() - 1) < 1e-9)) throw std::invalid_argument("the axis must be a unit vector: normalise it");
  const double moment = axis.dot(inertia_about(body, point) * axis);
  if (!(moment > 0)) throw std::invalid_argument("the body has no inertia about this axis");
  return moment;
}

double acceleration_about_axis(const MassProperties& body, const Vec3& point, const Vec3& axis, double torque) {
  return torque / moment_about_axis(body, point, axis);
}

Vec3 pivot_acceleration(const MassProperties& body, const Vec3& pivot, const Vec3& w, const Vec3& g) {
  const Vec3 torque = (body.com - pivot).cross(body.mass * g);
  return angular_acceleration(inertia_about(body, pivot), w, torque);
}

double pendulum_rate(const MassProperties& body, const Vec3& point, const Vec3& axis, double g) {
  if (!(g > 0)) throw std::invalid_argument("a pendulum needs gravity > 0");
  const double moment = moment_about_axis(body, point, axis);
  const double distance = (body.com - point).cross(axis).norm();
  return std::sqrt(body.mass * g * distance / moment);
}

}  // namespace plumbline
