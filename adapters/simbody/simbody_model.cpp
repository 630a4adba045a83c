#include "simbody_model.hpp"

#include <simbody/internal/Constraint_Ball.h>
#include <simbody/internal/Constraint_BuiltIns.h>
#include <simbody/internal/Constraint_Rod.h>
#include <simbody/internal/Constraint_Weld.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plumbline/adapters/joint_tree.hpp"

namespace plumbline {
namespace {

Vec3 vec3(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

// Simbody's slider travels along x where ours does along z. About y by -90 degrees: x falls on z, exactly.
SimTK::Rotation slider_axes() { return SimTK::Rotation(SimTK::Mat33(0, 0, -1, 0, 1, 0, 1, 0, 0), true); }

SimTK::Transform joint_frame(const Joint& joint, const JointFrame& frame) {
  const SimTK::Rotation R = simbody_rotation(frame.attitude);
  return {joint.kind == JointKind::kSlider ? R * slider_axes() : R, simbody_vector(frame.anchor)};
}

SimTK::Transform pose(const BodyState& s) { return {simbody_rotation(s.q_WB), simbody_vector(s.p_WB)}; }

SimTK::MobilizedBodyIndex hang(SimTK::MobilizedBody& parent, const SimTK::Body& body, const Joint& joint) {
  const SimTK::Transform X_PF = joint_frame(joint, joint.on_a), X_BM = joint_frame(joint, joint.on_b);
  switch (joint.kind) {
    case JointKind::kBall:
      return SimTK::MobilizedBody::Ball(parent, X_PF, body, X_BM);
    case JointKind::kHinge:
      return SimTK::MobilizedBody::Pin(parent, X_PF, body, X_BM);
    case JointKind::kSlider:
      return SimTK::MobilizedBody::Slider(parent, X_PF, body, X_BM);
    case JointKind::kFixed:
      return SimTK::MobilizedBody::Weld(parent, X_PF, body, X_BM);
    case JointKind::kDistance:
      break;
  }
  throw std::logic_error("a distance joint stands in the tree of joints");
}

// Velocity of the joint's frame on b seen from that on a, in a's frame: (angular, linear).
SimTK::SpatialVec initial_velocity(const Scenario& scenario, const Joint& joint) {
  const BodyState a = initial_state_of(scenario, joint.a), b = initial_state_of(scenario, joint.b);
  const Vec3 anchor_W = b.p_WB + b.q_WB * joint.on_b.anchor;
  const Vec3 v_W = b.v_WB + b.w_WB.cross(anchor_W - b.p_WB) - a.v_WB - a.w_WB.cross(anchor_W - a.p_WB);
  const SimTK::Rotation R_WF = pose(a).R() * joint_frame(joint, joint.on_a).R();
  return {~R_WF * simbody_vector(b.w_WB - a.w_WB), ~R_WF * simbody_vector(v_W)};
}

}  // namespace

SimTK::Rotation simbody_rotation(const Quat& q) {
  return SimTK::Rotation(SimTK::Quaternion(q.w(), q.x(), q.y(), q.z()));
}

std::string simbody_version() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

SimbodyModel::SimbodyModel(const Scenario& scenario)
    : bodies_(scenario.bodies.size(), SimTK::MobilizedBodyIndex(0)), fixed_(scenario.bodies.size()) {
  SimTK::Force::UniformGravity(forces_, matter_, simbody_vector(scenario.gravity));
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    fixed_[i].p_WB = scenario.bodies[i].initial.p_WB;
    fixed_[i].q_WB = scenario.bodies[i].initial.q_WB;
  }
  const JointTree tree = joint_tree(scenario);
  require_coordinates(scenario, tree);
  for (const TreeLink& link : tree.links) {
    const Body& body = scenario.bodies[link.body];
    const SimTK::Body::Rigid rigid(
        SimTK::MassProperties(body.mass, SimTK::Vec3(0), SimTK::Inertia(simbody_vector(body.inertia))));
    if (link.joint) {
      const std::size_t a = link.joint->a;
      bodies_[link.body] = hang(a == kWorld ? matter_.updGround() : this->body(a), rigid, *link.joint);
    } else {
      bodies_[link.body] = SimTK::MobilizedBody::Free(matter_.updGround(), rigid);
    }
    if (const auto spring = spring_on(scenario, link)) {
      const SimTK::MobilizedBody& mobod = this->body(link.body);
      SimTK::Force::MobilityLinearSpring(forces_, mobod, SimTK::MobilizerQIndex(0), spring->stiffness, spring->rest);
      SimTK::Force::MobilityLinearDamper(forces_, mobod, SimTK::MobilizerUIndex(0), spring->damping);
    }
  }
  for (const Spring& spring : scenario.springs) {
    const SimTK::MobilizedBody& a = spring.a == kWorld ? matter_.updGround() : this->body(spring.a);
    const SimTK::MobilizedBody& b = this->body(spring.b);
    const SimTK::Vec3 on_a = simbody_vector(spring.on_a), on_b = simbody_vector(spring.on_b);
    SimTK::Force::TwoPointLinearSpring(forces_, a, on_a, b, on_b, spring.stiffness, spring.length);
    SimTK::Force::TwoPointLinearDamper(forces_, a, on_a, b, on_b, spring.damping);
  }
}

void SimbodyModel::close_loops(const Scenario& scenario) {
  const std::vector<std::size_t> left_over = joint_tree(scenario).left_over;
  // A rod may be straight in line with a joint for a moment, so that it seems void: those are never dropped.
  loops_closed_ = std::none_of(left_over.begin(), left_over.end(),
                               [&](std::size_t k) { return scenario.joints[k].kind == JointKind::kDistance; }) &&
                  !left_over.empty();
  for (const std::size_t k : left_over) {
    const Joint& joint = scenario.joints[k];
    SimTK::MobilizedBody& a = joint.a == kWorld ? matter_.updGround() : body(joint.a);
    SimTK::MobilizedBody& b = body(joint.b);
    const SimTK::Transform X_A = joint_frame(joint, joint.on_a), X_B = joint_frame(joint, joint.on_b);
    const SimTK::UnitVec3 x_A = X_A.x(), y_A = X_A.y(), z_B = X_B.z();
    switch (joint.kind) {
      case JointKind::kDistance:
        SimTK::Constraint::Rod(a, X_A.p(), b, X_B.p(), joint.length);
        break;
      case JointKind::kFixed:
        SimTK::Constraint::Weld(a, X_A, b, X_B);
        break;
      case JointKind::kSlider:  // b's anchor stays on a's line, which is x here
        SimTK::Constraint::PointOnLine(a, x_A, X_A.p(), b, X_B.p());
        SimTK::Constraint::ConstantOrientation(a, X_A.R(), b, X_B.R());
        break;
      case JointKind::kHinge:
        SimTK::Constraint::ConstantAngle(a, x_A, b, z_B);
        SimTK::Constraint::ConstantAngle(a, y_A, b, z_B);
        [[fallthrough]];
      case JointKind::kBall:
        SimTK::Constraint::Ball(a, X_A.p(), b, X_B.p());
        break;
    }
  }
}

SimTK::State SimbodyModel::begin(const Scenario& scenario) {
  SimTK::State state = system_.realizeTopology();
  system_.realizeModel(state);
  for (const TreeLink& link : joint_tree(scenario).links) {
    const SimTK::MobilizedBody& mobod = body(link.body);
    const BodyState& s = scenario.bodies[link.body].initial;
    if (link.joint) {
      const SimTK::Transform X_WF =
          pose(initial_state_of(scenario, link.joint->a)) * joint_frame(*link.joint, link.joint->on_a);
      mobod.setQToFitTransform(state, ~X_WF * pose(s) * joint_frame(*link.joint, link.joint->on_b));
      mobod.setUToFitVelocity(state, initial_velocity(scenario, *link.joint));
    } else {
      mobod.setQToFitTransform(state, pose(s));
      mobod.setUToFitVelocity(state, {simbody_vector(s.w_WB), simbody_vector(s.v_WB)});
    }
  }
  if (loops_closed_) drop_void_constraints(state);
  return state;
}

void SimbodyModel::drop_void_constraints(SimTK::State& state) const {
  system_.realize(state, SimTK::Stage::Velocity);
  SimTK::Matrix G;
  matter_.calcG(state, G);
  // Rounding of lengths [m] and of unit axes. What no speed of the tree can violate in one pose holds in all of them.
  constexpr double kRounding = 1e-12;
  if (G.nelt() > 0 && G.normRMS() > kRounding) return;
  for (SimTK::ConstraintIndex k(0); k < matter_.getNumConstraints(); ++k) matter_.getConstraint(k).disable(state);
}

double SimbodyModel::end_of_step(double now, double dt) {
  if (dt > 0 && std::isfinite(dt) && now + dt > now) return now + dt;
  throw std::invalid_argument("a step of " + shortest(dt) + " s at " + shortest(now) + " s does not lead forward");
}

void SimbodyModel::apply(SimTK::State& state, std::span<const Wrench> wrenches) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (is_fixed(i)) continue;
    // Contacts would end the process over it.
    if (!wrenches[i].f_W.allFinite() || !wrenches[i].tau_W.allFinite()) {
      throw std::invalid_argument("the force on body number " + std::to_string(i + 1) + " is not finite");
    }
    wrenches_.setOneBodyForce(state, matter_.getMobilizedBody(bodies_[i]),
                              {simbody_vector(wrenches[i].tau_W), simbody_vector(wrenches[i].f_W)});
  }
}

void SimbodyModel::read(const SimTK::State& state, std::span<BodyState> states) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (is_fixed(i)) {
      states[i] = fixed_[i];
      continue;
    }
    const SimTK::MobilizedBody& mobod = matter_.getMobilizedBody(bodies_[i]);
    const SimTK::Quaternion q = mobod.getBodyRotation(state).convertRotationToQuaternion();
    states[i].p_WB = vec3(mobod.getBodyOriginLocation(state));
    states[i].q_WB = Quat(q[0], q[1], q[2], q[3]);
    states[i].v_WB = vec3(mobod.getBodyOriginVelocity(state));
    states[i].w_WB = vec3(mobod.getBodyAngularVelocity(state));
  }
}

}  // namespace plumbline
