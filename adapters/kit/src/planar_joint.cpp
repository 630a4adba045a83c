#include "plumbline/adapters/planar_joint.hpp"

#include <cmath>

#include "plumbline/adapters/joint_tree.hpp"
#include "plumbline/adapters/planar_frame.hpp"

namespace plumbline {
namespace {

// A vector in body axes, in those that turn with the planar angle alone. The two differ for a ball whose attitude is
// not a turn about y.
PlanarVector in_planar_axes(const BodyState& state, const Vec3& v_B) {
  const Vec3 v_W = state.q_WB * v_B;
  const double angle = in_plane(state).angle, c = std::cos(angle), s = std::sin(angle);
  return {c * v_W.x() + s * v_W.z(), c * v_W.z() - s * v_W.x()};
}

}  // namespace

PlanarJoint planar_joint(const Scenario& scenario, const Joint& joint) {
  const BodyState a = initial_state_of(scenario, joint.a), b = initial_state_of(scenario, joint.b);
  PlanarJoint planar;
  planar.on_a = in_planar_axes(a, joint.on_a.anchor);
  planar.on_b = in_planar_axes(b, joint.on_b.anchor);
  planar.axis = in_planar_axes(a, joint.on_a.axis());
  planar.turn = in_plane(b).angle - in_plane(a).angle;
  const bool turns = joint.kind == JointKind::kHinge;
  if (turns) planar.sense = (a.q_WB * joint.on_a.axis()).y() > 0 ? -1 : 1;
  if (joint.range) {
    planar.range = planar.sense > 0 ? *joint.range : JointRange{-joint.range->high, -joint.range->low};
  }
  return planar;
}

PlanarSpring planar_spring(const Scenario& scenario, const Spring& spring) {
  const BodyState a = initial_state_of(scenario, spring.a), b = initial_state_of(scenario, spring.b);
  return {in_planar_axes(a, spring.on_a), in_planar_axes(b, spring.on_b)};
}

}  // namespace plumbline
