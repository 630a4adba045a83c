#include "plumbline/core/body.hpp"

#include <stdexcept>

namespace plumbline {

std::string_view shape_name(const Shape& shape) {
  static constexpr std::string_view kNames[] = {"sphere", "box", "half_space", "cylinder"};
  return kNames[shape.index()];
}

void require_mass(const Body& body) {
  if (!body.fixed && !(body.mass > 0)) {
    throw std::invalid_argument("body '" + body.name + "' moves and needs a mass > 0; give it one or make it fixed");
  }
}

Vec3 solid_inertia(const Shape& shape, double mass) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return Vec3::Constant(0.4 * mass * sphere->radius * sphere->radius);
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    const Vec3 s2 = box->size.cwiseAbs2();
    return mass / 12.0 * Vec3(s2.y() + s2.z(), s2.z() + s2.x(), s2.x() + s2.y());
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const double r2 = cylinder->radius * cylinder->radius, h2 = cylinder->height * cylinder->height;
    const double across = mass * (3 * r2 + h2) / 12;
    return {across, across, 0.5 * mass * r2};
  }
  throw std::invalid_argument("a half-space has no inertia: it is infinite and always fixed");
}

Mat3 inertia_in_world(const Body& body, const Quat& q_WB) {
  const Mat3 r_WB = q_WB.toRotationMatrix();
  return r_WB * body.inertia.asDiagonal() * r_WB.transpose();
}

}  // namespace plumbline
