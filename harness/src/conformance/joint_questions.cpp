// Joints: each kind against the exact motion of constrained_motion.hpp, to the world and between two bodies.
#include <fmt/format.h>

#include "joint_scenes.hpp"
#include "plumbline/core/integration/runge_kutta_4.hpp"
#include "plumbline/core/joints/constrained_motion.hpp"

namespace plumbline::conformance {
namespace {

constexpr JointKind kKinds[] = {JointKind::kBall, JointKind::kHinge, JointKind::kSlider, JointKind::kFixed,
                                JointKind::kDistance};

// The arm on the world.
Scenario hung(const Interview& row, JointKind kind, const std::optional<Vec3>& axis_W = {}) {
  Scenario scenario;
  scenario.bodies = {arm(row)};
  scenario.joints = {joint_of(row, kind, kWorld, 0, initial_states(scenario), axis_W)};
  return scenario;
}

// Base and arm, free but for the joint between them.
Scenario paired(const Interview& row, JointKind kind) {
  Scenario scenario;
  scenario.bodies = {base(row), arm(row)};
  scenario.joints = {joint_of(row, kind, 0, 1, initial_states(scenario))};
  return scenario;
}

void require_wrenches(const Interview& row) {
  row.require(Feature::kForce);
  row.require(Feature::kTorque);
}

// One step from rest: every scheme adds a dt, with the exact a of bodies that joints hold.
void expect_answer(Interview& row, const Scenario& scenario, std::size_t pushed, const Wrench& wrench,
                   const std::string& how) {
  std::vector<Wrench> wrenches(scenario.bodies.size());
  wrenches[pushed] = wrench;
  const auto exact =
      constrained_accelerations(articulated_body(scenario), initial_states(scenario), wrenches).accelerations;
  const auto states = push(*row.build(scenario), scenario, pushed, wrench, kStep, 1);
  const Body& body = scenario.bodies[pushed];
  const double free = kStep * (wrench.f_W.norm() / body.mass + kArm * wrench.tau_W.norm() / body.inertia.minCoeff());
  // Solvers leave a share of what a free body would do, by softness or too few sweeps. An anchor or axis that stands
  // elsewhere, a wrong sign or a missing reaction changes the answer by a large part of it.
  const double limit = (0.02 + std::abs(row.info().velocity_offset)) * free;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::string who = " of '" + scenario.bodies[i].name + "' after one step of " + how;
    row.within("the velocity" + who, states[i].v_WB, kStep * exact[i].linear, limit);
    row.within("the spin" + who, states[i].w_WB, kStep * exact[i].angular, limit / kArm);
  }
}

void expect_answers(Interview& row, const Scenario& scenario) {
  const std::string kind(joint_name(scenario.joints[0].kind));
  for (const Vec3& axis : axes_of_motion(row)) {
    expect_answer(row, scenario, 0, {4 * axis, Vec3::Zero()}, "a force along " + name_of(axis) + ", " + kind);
  }
  for (const Vec3& axis : axes_of_rotation(row)) {
    expect_answer(row, scenario, 0, {Vec3::Zero(), 0.2 * axis}, "a torque about " + name_of(axis) + ", " + kind);
  }
}

// The motion that the joint leaves free, as the arm has it at the start.
void set_moving(const Interview& row, Scenario& scenario) {
  const Joint& joint = scenario.joints[0];
  BodyState& s = scenario.bodies[0].initial;
  Vec3 axis_W = s.q_WB * joint.on_b.axis();
  if (row.planar()) {  // nothing may leave the plane, not even by rounding
    axis_W = joint.kind == JointKind::kSlider ? Vec3(axis_W.x(), 0, axis_W.z()) : Vec3(0, axis_W.y(), 0);
  }
  if (joint.kind == JointKind::kSlider) s.v_WB = 0.4 * axis_W;
  if (joint.kind == JointKind::kHinge) s.w_WB = 1.5 * axis_W;
  if (joint.kind == JointKind::kBall || joint.kind == JointKind::kDistance) {
    s.w_WB = row.planar() ? Vec3(0, 1.5, 0) : Vec3(0.5, 1.2, -0.7);
  }
  if (joint.kind == JointKind::kSlider || joint.kind == JointKind::kFixed) return;
  const Vec3 centre = joint.kind == JointKind::kDistance ? far_end_W() : anchor_W(row);
  s.v_WB = s.w_WB.cross(s.p_WB - centre);
}

// Half a second of motion under a wrench, beside the exact one.
void expect_motion(Interview& row, Scenario scenario) {
  set_moving(row, scenario);
  const Wrench wrench =
      row.planar() ? Wrench{Vec3(2, 0, 1), Vec3(0, 0.05, 0)} : Wrench{Vec3(2, -1, 1), Vec3(0.03, 0.05, -0.04)};
  const int steps = 32;
  std::vector<BodyState> exact = initial_states(scenario);
  RungeKutta4 stepper;
  const AccelerationField field = constrained_field(
      articulated_body(scenario), [&](double, std::span<const BodyState>, std::span<Wrench> w) { w[0] = wrench; });
  double fastest = 0;
  for (int k = 0; k < steps; ++k) {
    stepper.step(field, k * kStep, kStep, exact);
    fastest = std::max(fastest, exact[0].v_WB.norm() + kArm * exact[0].w_WB.norm());
  }
  const auto world = row.build(scenario);
  const BodyState start = states_of(*world, scenario)[0], &stated = scenario.bodies[0].initial;
  const BodyState end = push(*world, scenario, 0, wrench, kStep, steps)[0];
  const std::string kind(joint_name(scenario.joints[0].kind));
  // A rotation to the joint's coordinates and back is 16 roundings, of numbers near 1.
  const double rounding = 2 * kOneStepRoundings * row.roundoff();
  row.within("the initial velocity, " + kind, start.v_WB, stated.v_WB, rounding);
  row.within("the initial spin, " + kind, start.w_WB, stated.w_WB, rounding * (1 + stated.w_WB.norm()));
  row.within("the angle between initial and stated attitude, " + kind, geodesic_angle(start.q_WB, stated.q_WB), 0,
             rounding);
  // A first-order scheme is off by about the way of one step, wherever the joint bends the path; softness of the joint
  // costs a hundredth of the arm at most.
  const double limit = 2 * kStep * fastest + 0.01 * kArm;
  row.within("the position after 1/2 s, " + kind, end.p_WB, exact[0].p_WB, limit);
  row.within("the angle to the exact attitude after 1/2 s, " + kind, geodesic_angle(end.q_WB, exact[0].q_WB), 0,
             limit / kArm);
}

template <JointKind kind>
void joint_moves_as_stated(Interview& row) {
  require_wrenches(row);
  expect_answers(row, hung(row, kind));
  expect_motion(row, hung(row, kind));
}

void axis_may_be_oblique(Interview& row) {
  require_wrenches(row);
  row.require(Feature::kSpatial);
  int asked = 0;
  for (JointKind kind : {JointKind::kHinge, JointKind::kSlider}) {
    const Scenario scenario = hung(row, kind, Vec3(1, 2, 3).normalized());
    if (!row.can_run(scenario)) continue;
    expect_answers(row, scenario);
    expect_motion(row, scenario);
    ++asked;
  }
  if (asked == 0) throw NotAsked("the engine has no hinges and no sliders");
}

// Calls with a scene of every kind of joint that the row has.
void for_each_pair(Interview& row, const std::function<void(const Scenario&)>& ask) {
  int asked = 0;
  for (JointKind kind : kKinds) {
    const Scenario scenario = paired(row, kind);
    if (!row.can_run(scenario)) continue;
    ask(scenario);
    ++asked;
  }
  if (asked == 0) throw NotAsked("the engine has no joints");
}

void either_body_may_come_first(Interview& row) {
  require_wrenches(row);
  const Wrench wrench =
      row.planar() ? Wrench{Vec3(3, 0, 2), Vec3(0, 0.1, 0)} : Wrench{Vec3(3, -1, 2), Vec3(0.1, 0.1, -0.05)};
  for_each_pair(row, [&](const Scenario& scenario) {
    const std::string kind(joint_name(scenario.joints[0].kind));
    Scenario turned = scenario;
    turned.joints[0] = reversed(scenario.joints[0]);
    for (std::size_t pushed : {0u, 1u}) {
      const std::string how = "a push on '" + scenario.bodies[pushed].name + "', " + kind;
      expect_answer(row, scenario, pushed, wrench, how);
      expect_answer(row, turned, pushed, wrench, how + " stated the other way round");
    }
  });
}

void joints_keep_momentum(Interview& row) {
  for_each_pair(row, [&](Scenario scenario) {
    // Turning about the origin as one, which every kind of joint allows; from then on the joint pulls both.
    const Vec3 w = row.planar() ? Vec3(0, 2, 0) : Vec3(1, 1.5, -0.8);
    double scale = 0;  // of the linear momentum [kg m/s]
    for (Body& body : scenario.bodies) {
      body.initial.w_WB = w;
      body.initial.v_WB = w.cross(body.initial.p_WB);
      scale += body.mass * w.norm() * kArm;
    }
    const ArticulatedBody body = articulated_body(scenario);
    const auto before = initial_states(scenario);
    const double dt = 1.0 / 256;
    const int steps = 64;
    const auto after = run(*row.build(scenario), scenario, dt, steps);
    // First order in dt: a scheme in the joint's own coordinates is off by (w dt)^2 a step. A reaction on one of the
    // two alone, or at another point, shows as w T.
    const double limit = (2 * steps * std::pow(w.norm() * dt, 2) + steps * kOneStepRoundings * row.roundoff()) * scale;
    const std::string kind = ", " + std::string(joint_name(scenario.joints[0].kind));
    row.within("the momentum after 1/4 s" + kind, linear_momentum(body, after), linear_momentum(body, before), limit);
    row.within("the angular momentum after 1/4 s" + kind, angular_momentum(body, after), angular_momentum(body, before),
               limit * kArm);
  });
}

void joined_bodies_do_not_collide(Interview& row) {
  row.require(Feature::kJointsAndContact);
  Scenario scenario;
  scenario.contact = ContactMaterial{0, 0};
  scenario.bodies = {ball("one", 0.3, 1, Vec3(-0.2, 0, 0)), ball("other", 0.3, 2, Vec3(0.2, 0, 0))};
  const auto states = initial_states(scenario);
  int asked = 0;
  for (JointKind kind : kKinds) {
    scenario.joints = {
        kind == JointKind::kDistance
            ? rod_between(0, 1, states, states[0].p_WB, states[1].p_WB)
            : joint_at(kind, 0, 1, states, Vec3::Zero(), kind == JointKind::kSlider ? Vec3::UnitX() : Vec3::UnitY())};
    if (!row.can_run(scenario)) continue;
    ++asked;
    const auto s = run(*row.build(scenario), scenario, kStep, 32);
    // What the rounding of a position is worth as a velocity, should a step put it right at once.
    const double limit = 64 * row.roundoff() / kStep;
    for (std::size_t i = 0; i < 2; ++i) {
      row.within(fmt::format("the velocity of '{}', {}", scenario.bodies[i].name, joint_name(kind)), s[i].v_WB,
                 Vec3::Zero(), limit);
    }
  }
  if (asked == 0) throw NotAsked("the engine has no joints between balls");
}

constexpr const char* kAnswerAndMotion =
    "2 % of a free body's answer to one push; over 1/2 s the way of two steps and 1 % of the arm";

const Question kQuestions[] = {
    {{"ball_joint_moves_as_stated", "joints",
      "Does a body on a ball joint answer pushes and swing as it exactly would?", kAnswerAndMotion, false},
     joint_moves_as_stated<JointKind::kBall>},
    {{"hinge_moves_as_stated", "joints", "Does a body on a hinge turn about its axis alone, the right way?",
      kAnswerAndMotion, false},
     joint_moves_as_stated<JointKind::kHinge>},
    {{"slider_moves_as_stated", "joints", "Does a body on a slider move along its axis alone, the right way?",
      kAnswerAndMotion, false},
     joint_moves_as_stated<JointKind::kSlider>},
    {{"fixed_joint_moves_as_stated", "joints", "Does a body on a fixed joint stay where it is?", kAnswerAndMotion,
      false},
     joint_moves_as_stated<JointKind::kFixed>},
    {{"distance_joint_moves_as_stated", "joints", "Does a body on a rod keep its distance and nothing else?",
      kAnswerAndMotion, false},
     joint_moves_as_stated<JointKind::kDistance>},
    {{"axis_may_be_oblique", "joints",
      "Do a hinge and a slider along no axis of world or body move as they exactly would?", kAnswerAndMotion, false},
     axis_may_be_oblique},
    {{"either_body_may_come_first", "joints",
      "Do two bodies answer a push on either of them alike, whichever of them the joint names first?",
      "2 % of a free body's answer", false},
     either_body_may_come_first},
    {{"joints_keep_momentum", "joints",
      "Does a joint between two free bodies keep their momentum and angular momentum?",
      "2 (w dt)^2 of it in each step, what a scheme in the joint's coordinates loses", false},
     joints_keep_momentum},
    {{"joined_bodies_do_not_collide", "joints", "Do two balls that overlap rest when a joint ties them to each other?",
      "the rounding of a position, put right within one step", false},
     joined_bodies_do_not_collide},
};

}  // namespace

std::span<const Question> joint_questions() { return kQuestions; }

}  // namespace plumbline::conformance
