// Gravity, forces and torques: signs, axes, and how long they last.
#include <fmt/format.h>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

void gravity_pulls_where_it_is_stated(Interview& row) {
  Scenario scenario;
  scenario.gravity = Vec3(1.5, 0, -9.81);
  scenario.bodies = {ball("ball", 0.5, 80, Vec3(0, 0, 2))};
  const auto world = row.build(scenario);
  const BodyState s = run(*world, scenario, kStep, 1)[0];
  const Vec3 dv = scenario.gravity * kStep;
  // A row that staggers its velocities is off by its declared share of a step.
  const double limit = (kOneStepRoundings * row.roundoff() + std::abs(row.info().velocity_offset)) * dv.norm();
  row.within("the velocity after one step", s.v_WB, dv, limit);
  const BodyState later = run(*world, scenario, kStep, 9)[0];
  row.expect(later.p_WB.z() < 2, fmt::format("z after ten steps is {:.9g}, wanted below 2", later.p_WB.z()));
  row.expect(later.p_WB.x() > 0, fmt::format("x after ten steps is {:.9g}, wanted above 0", later.p_WB.x()));
}

void forces_add_to_gravity(Interview& row) {
  row.require(Feature::kForce);
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.bodies = {ball("ball", 0.5, 4, Vec3::Zero())};
  const auto world = row.build(scenario);
  const Wrench wrench{Vec3(6, 0, 2), Vec3::Zero()};
  const int steps = 8;
  const BodyState s = push(*world, scenario, 0, wrench, kStep, steps)[0];
  const Vec3 wanted = steps * kStep * (scenario.gravity + wrench.f_W / 4);
  const double limit =
      (steps * kOneStepRoundings * row.roundoff() + std::abs(row.info().velocity_offset) / steps) * wanted.norm();
  row.within("the velocity after eight steps under gravity and a force", s.v_WB, wanted, limit);
}

void force_and_torque_last_one_step(Interview& row) {
  row.require(Feature::kForce);
  row.require(Feature::kTorque);
  Scenario scenario;
  scenario.bodies = {ball("ball", 0.5, 2, Vec3::Zero())};
  const auto world = row.build(scenario);
  const BodyState pushed = push(*world, scenario, 0, {Vec3(3, 0, -2), Vec3(0, 0.25, 0)}, kStep, 1)[0];
  row.expect(pushed.v_WB.norm() > 0, "the force did nothing");
  row.expect(pushed.w_WB.norm() > 0, "the torque did nothing");
  const BodyState later = run(*world, scenario, kStep, 10)[0];
  // Ten free steps may round; a force that stays would add as much again with each of them.
  const double slack = 10 * kOneStepRoundings * row.roundoff();
  row.within("the velocity ten steps after the force", later.v_WB, pushed.v_WB, slack * pushed.v_WB.norm());
  row.within("the spin ten steps after the torque", later.w_WB, pushed.w_WB, slack * pushed.w_WB.norm());
}

void forces_go_to_their_body(Interview& row) {
  row.require(Feature::kForce);
  Scenario scenario;
  scenario.bodies = {ball("third", 0.1, 1, Vec3(3, 0, 0)), half_space(Vec3::UnitZ(), Vec3(0, 0, -9)),
                     ball("first", 0.1, 1, Vec3(1, 0, 0)), ball("second", 0.1, 1, Vec3(2, 0, 0))};
  const auto world = row.build(scenario);
  const auto s = push(*world, scenario, 2, {Vec3(0, 0, 5), Vec3::Zero()}, kStep, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    const Body& body = scenario.bodies[i];
    row.within("x of " + body.name, s[i].p_WB.x(), body.initial.p_WB.x(), 0);
    row.expect((s[i].v_WB.z() > 0) == (i == 2),
               fmt::format("vz of {} is {:.9g}, when 'first' is pushed up", body.name, s[i].v_WB.z()));
  }
}

void wrenches_are_in_world_axes(Interview& row) {
  row.require(Feature::kForce);
  Scenario scenario;
  scenario.bodies = {box("cube", Vec3(1, 1, 1), 6, Vec3::Zero())};  // I = 1 kg m^2
  scenario.bodies[0].initial.q_WB = quarter_turn_about_y();
  const double limit = kOneStepRoundings * row.roundoff() * kStep;
  for (const Vec3& axis : axes_of_motion(row)) {
    const auto world = row.build(scenario);
    const BodyState s = push(*world, scenario, 0, {6 * axis, Vec3::Zero()}, kStep, 1)[0];
    row.within("the velocity of a body that stands askew by a force along " + name_of(axis), s.v_WB, kStep * axis,
               limit);
  }
  if (!row.has(Feature::kTorque)) return;
  for (const Vec3& axis : axes_of_rotation(row)) {
    const auto world = row.build(scenario);
    const BodyState s = push(*world, scenario, 0, {Vec3::Zero(), axis}, kStep, 1)[0];
    row.within("the spin of a body that stands askew by a torque about " + name_of(axis), s.w_WB, kStep * axis, limit);
  }
}

void torque_turns_right_handed(Interview& row) {
  row.require(Feature::kTorque);
  Scenario scenario;
  scenario.bodies = {box("cube", Vec3(1, 1, 1), 6, Vec3::Zero())};  // I = 1 kg m^2
  const int steps = 32;
  const auto world = row.build(scenario);
  const BodyState s = push(*world, scenario, 0, {Vec3::Zero(), Vec3(0, 2, 0)}, kStep, steps)[0];
  const double w = 2 * kStep * steps;
  row.within("the spin about y", s.w_WB.y(), w,
             (steps * kOneStepRoundings * row.roundoff() + std::abs(row.info().velocity_offset) / steps) * w);
  // phi = tau t^2/(2 I) up to half a step's worth of w, the difference between the first-order rules.
  const double phi = w * w / 4;
  const Vec3 x_W = s.q_WB * Vec3::UnitX();
  row.within("the angle from x towards -z", std::atan2(-x_W.z(), x_W.x()), phi, w * kStep);
}

void slow_bodies_stay_awake(Interview& row) {
  row.require(Feature::kForce);
  Scenario scenario;
  const double creep = 1e-3;
  scenario.bodies = {ball("ball", 0.1, 1, Vec3::Zero(), Vec3(creep, 0, 0))};
  const auto world = row.build(scenario);
  const double duration = 4;  // twice as long as the most patient engine waits
  const BodyState s = run(*world, scenario, kStep, static_cast<int>(duration / kStep))[0];
  row.within("the way in 4 s at 1 mm/s", s.p_WB.x(), creep * duration,
             2 * duration / kStep * row.roundoff() * creep * duration);
  const BodyState pushed = push(*world, scenario, 0, {Vec3(0, 0, 1), Vec3::Zero()}, kStep, 1)[0];
  row.expect(pushed.v_WB.z() > 0, "a force on a slow body is lost");
}

const Question kQuestions[] = {
    {{"gravity_pulls_where_it_is_stated", "forces", "Does gravity act along the stated vector, with its size and sign?",
      "16 roundings, and the declared stagger of the velocities", false},
     gravity_pulls_where_it_is_stated},
    {{"forces_add_to_gravity", "forces", "Do a force and gravity add up, step after step?",
      "16 roundings a step, and the declared stagger of the velocities", false},
     forces_add_to_gravity},
    {{"force_and_torque_last_one_step", "forces", "Is a wrench gone after the step that it was meant for?",
      "16 roundings in each of ten free steps", false},
     force_and_torque_last_one_step},
    {{"forces_go_to_their_body", "forces", "Does the k-th wrench act on the k-th body, fixed ones counted?", "", false},
     forces_go_to_their_body},
    {{"wrenches_are_in_world_axes", "forces",
      "Do force and torque act along the world's axes on a body that is turned?",
      "16 roundings: inputs, products and a rotation to body axes and back", false},
     wrenches_are_in_world_axes},
    {{"torque_turns_right_handed", "forces", "Does a torque about +y turn x towards -z, as fast as it should?",
      "16 roundings a step for the spin; w dt for the angle, the difference between schemes", false},
     torque_turns_right_handed},
    {{"slow_bodies_stay_awake", "forces", "Does a slow body move on, and answer a force?",
      "one product and one sum a step", true},
     slow_bodies_stay_awake},
};

}  // namespace

std::span<const Question> force_questions() { return kQuestions; }

}  // namespace plumbline::conformance
