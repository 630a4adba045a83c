#include "plumbline/core/invariant.hpp"

namespace plumbline {
namespace {

// The part of a vector in the x-z plane, and of an axial vector (w, L) along the plane's normal.
Vec3 polar(const Vec3& v, bool in_plane) { return in_plane ? Vec3(v.x(), 0, v.z()) : v; }
Vec3 axial(const Vec3& v, bool in_plane) { return in_plane ? Vec3(0, v.y(), 0) : v; }

}  // namespace

double energy(const Scenario& scenario, std::span<const BodyState> states, bool in_plane) {
  double sum = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Body& body = scenario.bodies[i];
    if (body.fixed) continue;
    const BodyState& s = states[i];
    const Vec3 w = axial(s.w_WB, in_plane);
    sum += 0.5 * body.mass * polar(s.v_WB, in_plane).squaredNorm();
    sum += 0.5 * w.dot(inertia_in_world(body, s.q_WB) * w);
    sum -= body.mass * polar(scenario.gravity, in_plane).dot(s.p_WB);
  }
  for (const Spring& spring : scenario.springs) sum += stored_energy(spring, states);
  for (const JointSpring& spring : scenario.joint_springs) {
    sum += stored_energy(spring, scenario.joints[spring.joint], states);
  }
  return sum;
}

Vec3 momentum(const Scenario& scenario, std::span<const BodyState> states, bool in_plane) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!scenario.bodies[i].fixed) sum += scenario.bodies[i].mass * polar(states[i].v_WB, in_plane);
  }
  return sum;
}

Vec3 angular_momentum(const Scenario& scenario, std::span<const BodyState> states, bool in_plane) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Body& body = scenario.bodies[i];
    if (body.fixed) continue;
    const BodyState& s = states[i];
    sum += body.mass * s.p_WB.cross(s.v_WB) + inertia_in_world(body, s.q_WB) * s.w_WB;
  }
  return axial(sum, in_plane);
}

}  // namespace plumbline
