// Two bodies without any symmetry, and joints between them or to the world.
#pragma once

#include <optional>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {

// A typical lever of the scenes: it turns angles into lengths [m].
inline constexpr double kArm = 0.4;

inline std::vector<BodyState> initial_states(const Scenario& scenario) {
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  return states;
}

// Nothing about them is symmetric, so that a wrong anchor, axis or moment shows; for a planar row they stand in its
// plane.
inline Body arm(const Interview& row) {
  Body body = box("arm", Vec3(0.4, 0.3, 0.5), 2, Vec3(0.3, 0, -0.2));
  body.inertia = Vec3(0.04, 0.06, 0.05);
  body.initial.q_WB = rotation_by(row.planar() ? Vec3(0, 0.4, 0) : Vec3(0.3, -0.5, 0.4));
  return body;
}
inline Body base(const Interview& row) {
  Body body = box("base", Vec3(0.3, 0.4, 0.5), 3, Vec3(-0.3, 0, 0.25));
  body.inertia = Vec3(0.06, 0.08, 0.05);
  body.initial.q_WB = rotation_by(row.planar() ? Vec3(0, -0.7, 0) : Vec3(-0.2, 0.6, 0.9));
  return body;
}
inline Vec3 anchor_W(const Interview& row) { return {0.1, row.planar() ? 0.0 : 0.1, 0.15}; }
inline Vec3 far_end_W() { return {-0.3, 0, 0.4}; }

inline Joint joint_of(const Interview& row, JointKind kind, std::size_t a, std::size_t b,
                      const std::vector<BodyState>& states, const std::optional<Vec3>& axis_W = {}) {
  if (kind == JointKind::kDistance) return rod_between(a, b, states, far_end_W(), anchor_W(row));
  const Vec3 usual = kind == JointKind::kSlider ? Vec3(0.6, 0, 0.8) : Vec3(0, 1, 0);
  return joint_at(kind, a, b, states, anchor_W(row), axis_W.value_or(usual));
}

}  // namespace plumbline::conformance
