// Literal scenarios that several tests of the kinetics start from.
#pragma once

#include "plumbline/core/scenario.hpp"

namespace plumbline::scenes {

inline constexpr double kG = 9.81;  // [m/s^2]

inline Body ground() {
  Body body;
  body.name = "ground";
  body.shape = HalfSpace{Vec3::UnitZ()};
  body.fixed = true;
  return body;
}

inline Body solid(const std::string& name, const Shape& shape, double mass, const Vec3& p_WB, const Vec3& v_WB) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.mass = mass;
  body.inertia = solid_inertia(shape, mass);
  body.initial.p_WB = p_WB;
  body.initial.v_WB = v_WB;
  return body;
}

inline Body ball(const std::string& name, double radius, double mass, const Vec3& p_WB, const Vec3& v_WB) {
  return solid(name, Sphere{radius}, mass, p_WB, v_WB);
}

inline Scenario free_flight(Body body, const Vec3& gravity, double duration) {
  Scenario s;
  s.id = "test/free_flight";
  s.gravity = gravity;
  s.duration = duration;
  s.bodies = {std::move(body)};
  return s;
}

inline Scenario on_ground(Body body, double restitution, double friction, double duration) {
  Scenario s;
  s.id = "test/on_ground";
  s.gravity = Vec3(0, 0, -kG);
  s.duration = duration;
  s.bodies = {ground(), std::move(body)};
  s.contact = ContactMaterial{restitution, friction};
  return s;
}

}  // namespace plumbline::scenes
