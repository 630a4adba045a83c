// Frames, handedness, order, and the time that a step takes: free bodies on which nothing acts.
#include <fmt/format.h>

#include <algorithm>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

void initial_state_reads_back(Interview& row) {
  Scenario scenario;
  scenario.bodies = {box("box", Vec3(1, 2, 3), 5, Vec3(1, 0, -3), Vec3(4, 0, 6)),
                     half_space(Vec3::UnitZ(), Vec3(7, 0, -8))};
  BodyState& stated = scenario.bodies[0].initial;
  stated.q_WB = rotation_by(Vec3(0, 0.7, 0));
  stated.w_WB = Vec3(0, 0.9, 0);
  if (!row.planar()) {
    stated.p_WB.y() = -2;
    stated.v_WB.y() = 5;
    stated.q_WB = rotation_by(Vec3(0.3, -1.1, 0.5));
    stated.w_WB = Vec3(-0.8, 0.9, 1.3);
  }
  const auto states = states_of(*row.build(scenario), scenario);
  const double u = row.roundoff();
  row.within("position", states[0].p_WB, stated.p_WB, u * stated.p_WB.norm());
  // Velocities may be kept in body axes: a rotation and back is 16 roundings.
  row.within("velocity", states[0].v_WB, stated.v_WB, kOneStepRoundings * u * stated.v_WB.norm());
  row.within("angular velocity", states[0].w_WB, stated.w_WB, kOneStepRoundings * u * stated.w_WB.norm());
  // An attitude may be kept as a matrix: each entry has three products and two sums, its inverse a root and a
  // quotient, and the angle is twice the quaternion's error.
  row.within("the angle between the stated attitude and the one that is read",
             geodesic_angle(states[0].q_WB, stated.q_WB), 0, 16 * u);
  row.within("position of the half-space", states[1].p_WB, scenario.bodies[1].initial.p_WB, 0);
  row.within("velocity of the half-space", states[1].v_WB, Vec3::Zero(), 0);
}

void spin_turns_right_handed(Interview& row) {
  for (const Vec3& axis : axes_of_rotation(row)) {
    Scenario scenario;
    scenario.bodies = {box("cube", Vec3(1, 1, 1), 1, Vec3::Zero())};
    const double w = 1;
    scenario.bodies[0].initial.w_WB = w * axis;
    const int steps = 32;
    const double angle = w * kStep * steps;
    const BodyState s = run(*row.build(scenario), scenario, kStep, steps)[0];
    // A quaternion advanced by Euler's rule and normalised turns by 2 atan(w dt/2) = w dt (1 - (w dt)^2/12 + ...) in a
    // step, the worst of the usual rules; each step rounds a product of quaternions (8 operations deep).
    const double limit = angle * std::pow(w * kStep, 2) / 12 + steps * 16 * row.roundoff();
    const Vec3 across(axis.z(), axis.x(), axis.y());  // the next axis: x -> y -> z -> x
    row.within(fmt::format("after {} rad about {}, the image of the next axis", angle, name_of(axis)), s.q_WB * across,
               std::cos(angle) * across + std::sin(angle) * axis.cross(across), limit);
    row.within("the spin itself", s.w_WB, w * axis, steps * kOneStepRoundings * row.roundoff());
    row.within("the length of the quaternion", s.q_WB.norm(), 1, steps * kOneStepRoundings * row.roundoff());
  }
}

void angular_velocity_is_in_world_axes(Interview& row) {
  row.require(Feature::kSpatial);
  Scenario scenario;
  scenario.bodies = {box("cube", Vec3(1, 1, 1), 6, Vec3::Zero())};  // any axis is a principal one
  scenario.bodies[0].initial.q_WB = quarter_turn_about_y();
  scenario.bodies[0].initial.w_WB = Vec3::UnitX();
  const int steps = 32;
  const double angle = kStep * steps;
  const BodyState s = run(*row.build(scenario), scenario, kStep, steps)[0];
  const Quat wanted = rotation_by(Vec3(angle, 0, 0)) * quarter_turn_about_y();
  // As in spin_turns_right_handed.
  const double limit = angle * kStep * kStep / 12 + steps * 16 * row.roundoff();
  row.within("the angle to the attitude that a turn about x of the world gives", geodesic_angle(s.q_WB, wanted), 0,
             limit);
  row.within("the spin itself", s.w_WB, Vec3::UnitX(), steps * kOneStepRoundings * row.roundoff());
}

void free_body_keeps_its_angular_momentum(Interview& row) {
  row.require(Feature::kSpatial);
  Scenario scenario;
  scenario.bodies = {uneven_box()};
  Body& body = scenario.bodies[0];
  body.initial.w_WB = Vec3(1, 0.8, 0.6);
  const auto momentum = [&](const BodyState& s) -> Vec3 { return inertia_in_world(body, s.q_WB) * s.w_WB; };
  const Vec3 before = momentum(body.initial);
  const double dt = 1.0 / 1024, w = body.initial.w_WB.norm();
  const int steps = 64;
  const Vec3 after = momentum(run(*row.build(scenario), scenario, dt, steps)[0]);
  // A scheme of first order is off by (w dt)^2/2 of the momentum in a step, whichever way it takes w x I w. Without
  // that term the momentum would turn with the body, by more than w T/10.
  const double limit = (steps * std::pow(w * dt, 2) + steps * 16 * row.roundoff()) * before.norm();
  row.within("the angular momentum after 1/16 s", after, before, limit);
}

void motion_across_the_plane(Interview& row) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.bodies = {ball("ball", 0.1, 1, Vec3(1, 2, 3), Vec3(4, 5, 6))};
  const int steps = 16;
  const BodyState s = run(*row.build(scenario), scenario, kStep, steps)[0];
  // Uniform motion: each step rounds one product and one sum of numbers not above y. What a planar engine does not know
  // of a body stays as it is stated.
  const double y = row.planar() ? 2 : 2 + 5 * kStep * steps;
  row.within("y", s.p_WB.y(), y, 2 * steps * row.roundoff() * y);
  row.within("vy", s.v_WB.y(), row.planar() ? 0 : 5, 0);
  row.within("x", s.p_WB.x(), 1 + 4 * kStep * steps, 2 * steps * row.roundoff() * 2);
}

void a_step_lasts_dt(Interview& row) {
  for (double dt : {1.0 / 16, 1.0 / 64, 1.0 / 1024}) {
    Scenario scenario;
    scenario.bodies = {ball("ball", 0.1, 1, Vec3::Zero(), Vec3(3, 0, -2))};
    const int steps = static_cast<int>(0.25 / dt);
    const BodyState s = run(*row.build(scenario), scenario, dt, steps)[0];
    // Each step rounds one product and one sum of numbers not above the distance.
    const Vec3 wanted(0.75, 0, -0.5);
    row.within(fmt::format("the way in 1/4 s with dt = {} s", dt), s.p_WB, wanted,
               2 * steps * row.roundoff() * wanted.norm());
  }
}

void bodies_keep_their_order(Interview& row) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -1);
  for (int i = 0; i < 4; ++i) {
    const double n = 1 + i;
    scenario.bodies.push_back(ball(fmt::format("ball {}", i), 0.1, n, Vec3(3 * n, 0, -n), Vec3(-n, 0, n)));
    scenario.bodies.back().initial.w_WB = Vec3(0, n, 0);
  }
  scenario.bodies.insert(scenario.bodies.begin() + 2, half_space(Vec3::UnitZ(), Vec3(0, 0, -50)));
  scenario.bodies[3].fixed = true;
  Scenario turned = scenario;
  std::ranges::reverse(turned.bodies);
  const auto states = run(*row.build(scenario), scenario, kStep, 8);
  auto other = run(*row.build(turned), turned, kStep, 8);
  std::ranges::reverse(other);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Body& body = scenario.bodies[i];
    // Free flight under |g| = 1 over T = 1/8 s: within g T dt of the parabola, whatever the scheme.
    const double t = 8 * kStep, slack = t * kStep + 16 * row.roundoff() * body.initial.p_WB.norm();
    const Vec3 wanted =
        body.fixed ? body.initial.p_WB : Vec3(body.initial.p_WB + t * body.initial.v_WB + t * t / 2 * scenario.gravity);
    row.within("position of " + body.name, states[i].p_WB, wanted, body.fixed ? 0 : slack);
    row.expect(same_bits({states[i]}, {other[i]}), body.name + " moves otherwise when the bodies are listed backwards");
  }
}

const Question kQuestions[] = {
    {{"initial_state_reads_back", "frames",
      "Is the stated initial state what is read before the first step: world axes, centre of mass, w x y z?",
      "one rounding to the engine's precision; attitude and velocities 16, for a rotation to body axes and back",
      false},
     initial_state_reads_back},
    {{"spin_turns_right_handed", "frames", "Does a spin about an axis turn the others by the right-hand rule?",
      "(w dt)^2/12 of the angle, the error of a quaternion advanced by Euler's rule, and 16 roundings a step", false},
     spin_turns_right_handed},
    {{"angular_velocity_is_in_world_axes", "frames",
      "Does a body that stands askew spin about the world's axis that is stated?",
      "(w dt)^2/12 of the angle, the error of a quaternion advanced by Euler's rule, and 16 roundings a step", false},
     angular_velocity_is_in_world_axes},
    {{"free_body_keeps_its_angular_momentum", "frames",
      "Does an uneven body left alone keep its angular momentum: is the gyroscopic term there, with the right sign?",
      "(w dt)^2 of it in each step, twice what a scheme of first order loses", true},
     free_body_keeps_its_angular_momentum},
    {{"motion_across_the_plane", "frames",
      "Does a row in space run the whole motion, and a planar one its projection onto the x-z plane?",
      "one product and one sum a step", false},
     motion_across_the_plane},
    {{"a_step_lasts_dt", "frames", "Does a step take exactly the dt that it is given, large or small?",
      "one product and one sum a step", false},
     a_step_lasts_dt},
    {{"bodies_keep_their_order", "frames",
      "Does each body have its own state in the order of the scenario, fixed ones between them?",
      "g T dt, the difference between schemes; the same bits when the list is turned round", false},
     bodies_keep_their_order},
};

}  // namespace

std::span<const Question> frame_questions() { return kQuestions; }

}  // namespace plumbline::conformance
