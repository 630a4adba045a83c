// The literals that the checks' scenarios are made of.
#pragma once

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "interview.hpp"

namespace plumbline::conformance {

// A power of two, so that it is the same number in single and in double precision [s].
inline constexpr double kStep = 1.0 / 64;

// Rounding of a one-step change of velocity: the inputs (force, step, inverse mass), two products and a sum are rounded
// once each; a rotation to the body's frame and back adds three products and two sums, twice. 16 roundings bound it.
inline constexpr double kOneStepRoundings = 16;

inline std::vector<BodyState> states_of(const World& world, const Scenario& scenario) {
  std::vector<BodyState> states(scenario.bodies.size());
  world.read(states);
  return states;
}

inline std::vector<BodyState> run(World& world, const Scenario& scenario, double dt, int steps) {
  for (int k = 0; k < steps; ++k) world.step(dt);
  return states_of(world, scenario);
}

// The same wrench on one body in every step.
inline std::vector<BodyState> push(World& world, const Scenario& scenario, std::size_t body, const Wrench& wrench,
                                   double dt, int steps) {
  std::vector<Wrench> wrenches(scenario.bodies.size());
  wrenches[body] = wrench;
  for (int k = 0; k < steps; ++k) {
    world.apply(wrenches);
    world.step(dt);
  }
  return states_of(world, scenario);
}

inline bool same_bits(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(BodyState)) == 0);
}

inline Body ball(std::string name, double radius, double mass, const Vec3& p_WB, const Vec3& v_WB = Vec3::Zero()) {
  Body body;
  body.name = std::move(name);
  body.shape = Sphere{radius};
  body.mass = mass;
  body.inertia = solid_inertia(body.shape, mass);
  body.initial.p_WB = p_WB;
  body.initial.v_WB = v_WB;
  return body;
}

inline Body box(std::string name, const Vec3& size, double mass, const Vec3& p_WB, const Vec3& v_WB = Vec3::Zero()) {
  Body body = ball(std::move(name), 1, mass, p_WB, v_WB);
  body.shape = Box{size};
  body.inertia = solid_inertia(body.shape, mass);
  return body;
}

inline Body half_space(const Vec3& normal, const Vec3& p_WB = Vec3::Zero()) {
  Body body;
  body.name = "ground";
  body.shape = HalfSpace{normal};
  body.fixed = true;
  body.initial.p_WB = p_WB;
  return body;
}

// A cube whose moments are those of no homogeneous box of that shape, so that ones derived from the shape are noticed.
inline Body uneven_box(const Vec3& p_WB = Vec3::Zero()) {
  Body body = box("box", Vec3(1, 1, 1), 2, p_WB);
  body.inertia = Vec3(0.3, 0.5, 0.7);
  return body;
}

inline Quat quarter_turn_about_y() { return rotation_by(Vec3(0, std::acos(0.0), 0)); }

inline std::vector<Vec3> axes_of_motion(const Interview& row) {
  if (row.planar()) return {Vec3::UnitX(), Vec3::UnitZ()};
  return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
}
inline std::vector<Vec3> axes_of_rotation(const Interview& row) {
  if (row.planar()) return {Vec3::UnitY()};
  return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
}
inline std::string name_of(const Vec3& axis) {
  if (axis == Vec3::UnitX()) return "x";
  if (axis == Vec3::UnitY()) return "y";
  return axis == Vec3::UnitZ() ? "z" : "an oblique axis";
}

// Bodies that fall, touch and rest: whatever an engine keeps between steps is in use. Of all kinds together and of
// simpler scenes those that the row can run, moved along x by `shift`; one free ball where it has no contacts at all.
std::vector<Scenario> busy_scenes(const Interview& row, double shift = 0);

}  // namespace plumbline::conformance
