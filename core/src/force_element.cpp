#include "plumbline/core/force_element.hpp"

#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {
namespace {

struct End {
  Vec3 point_W, velocity_W, arm_W;  // arm: from the centre of mass
};

End end_of(std::size_t body, const Vec3& on_body, std::span<const BodyState> states) {
  if (body == kWorld) return {on_body, Vec3::Zero(), Vec3::Zero()};
  const BodyState& s = states[body];
  const Vec3 arm = s.q_WB * on_body;
  return {s.p_WB + arm, s.v_WB + s.w_WB.cross(arm), arm};
}

void push(std::size_t body, const Vec3& force_W, const Vec3& arm_W, std::span<Wrench> wrenches) {
  if (body == kWorld) return;
  wrenches[body].f_W += force_W;
  wrenches[body].tau_W += arm_W.cross(force_W);
}

}  // namespace

void add_wrenches(const Spring& spring, std::span<const BodyState> states, std::span<Wrench> wrenches) {
  const End a = end_of(spring.a, spring.on_a, states), b = end_of(spring.b, spring.on_b, states);
  const Vec3 d = b.point_W - a.point_W;
  const double length = d.norm();
  Vec3 force = -spring.stiffness * d;
  if (length != 0) {  // NaN goes on: it must show
    const Vec3 n = d / length;
    force += (spring.stiffness * spring.length - spring.damping * n.dot(b.velocity_W - a.velocity_W)) * n;
  }
  push(spring.b, force, b.arm_W, wrenches);
  push(spring.a, -force, a.arm_W, wrenches);
}

void add_wrenches(const Joint& joint, double effort, std::span<const BodyState> states, std::span<Wrench> wrenches) {
  const JointRow row = coordinate_row(joint, states);
  wrenches[row.b].f_W += effort * row.force_W;
  wrenches[row.b].tau_W += effort * row.torque_b_W;
  if (row.a == kWorld) return;
  wrenches[row.a].f_W -= effort * row.force_W;
  wrenches[row.a].tau_W += effort * row.torque_a_W;
}

double effort_of(const JointSpring& spring, const Joint& joint, std::span<const BodyState> states) {
  const JointRow row = coordinate_row(joint, states);
  return -(spring.stiffness * (row.error - spring.rest) + spring.damping * rate(row, states));
}

double stored_energy(const Spring& spring, std::span<const BodyState> states) {
  const Vec3 d = end_of(spring.b, spring.on_b, states).point_W - end_of(spring.a, spring.on_a, states).point_W;
  const double stretch = d.norm() - spring.length;
  return 0.5 * spring.stiffness * stretch * stretch;
}

double stored_energy(const JointSpring& spring, const Joint& joint, std::span<const BodyState> states) {
  const double stretch = coordinate_row(joint, states).error - spring.rest;
  return 0.5 * spring.stiffness * stretch * stretch;
}

}  // namespace plumbline
