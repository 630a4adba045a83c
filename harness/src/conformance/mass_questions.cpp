// Whether mass and inertia are those that are stated: a unit force and a unit torque echo them.
#include <fmt/format.h>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

void force_echoes_the_mass(Interview& row) {
  row.require(Feature::kForce);
  for (const Vec3& axis : axes_of_motion(row)) {
    for (double mass : {0.3, 2500.0}) {
      Scenario scenario;
      scenario.bodies = {ball("ball", 0.7, mass, Vec3::Zero())};
      const auto world = row.build(scenario);
      const BodyState s = push(*world, scenario, 0, {axis, Vec3::Zero()}, kStep, 1)[0];
      const double dv = kStep / mass;
      row.within(fmt::format("the change of velocity of {} kg by 1 N along {}", mass, name_of(axis)), s.v_WB, dv * axis,
                 kOneStepRoundings * row.roundoff() * dv);
      row.within("the rotation by a force on the centre of mass", s.w_WB.norm(), 0, 0);
    }
  }
}

void torque_echoes_the_inertia(Interview& row) {
  row.require(Feature::kTorque);
  Scenario scenario;
  scenario.bodies = {uneven_box()};
  for (const Vec3& axis : axes_of_rotation(row)) {
    const auto world = row.build(scenario);
    const BodyState s = push(*world, scenario, 0, {Vec3::Zero(), axis}, kStep, 1)[0];
    const double dw = kStep / axis.dot(scenario.bodies[0].inertia);
    row.within("the change of angular velocity by 1 N m about " + name_of(axis), s.w_WB, dw * axis,
               kOneStepRoundings * row.roundoff() * dw);
    row.within("the velocity by a torque", s.v_WB.norm(), 0, 0);
  }
}

void inertia_turns_with_the_body(Interview& row) {
  row.require(Feature::kTorque);
  row.require(Feature::kSpatial);
  Scenario scenario;
  scenario.bodies = {uneven_box()};
  Body& body = scenario.bodies[0];
  const auto answer_to = [&](const Vec3& torque) {
    const auto world = row.build(scenario);
    return push(*world, scenario, 0, {Vec3::Zero(), torque}, kStep, 1)[0].w_WB;
  };
  body.initial.q_WB = quarter_turn_about_y();
  // After the quarter turn the body's z axis points along x of the world.
  const double dw = kStep / body.inertia.z();
  row.within("after a quarter turn about y, the answer to 1 N m about x", answer_to(Vec3::UnitX()), dw * Vec3::UnitX(),
             kOneStepRoundings * row.roundoff() * dw);

  body.initial.q_WB = rotation_by(Vec3(0.3, -1.1, 0.5));
  const double condition = body.inertia.maxCoeff() / body.inertia.minCoeff();
  for (const Vec3& axis : axes_of_rotation(row)) {
    const Vec3 wanted = kStep * inertia_in_world(body, body.initial.q_WB).inverse() * axis;
    // While the step lasts the body turns by less than w dt and takes its inertia with it.
    const double limit = condition * (wanted.norm() * kStep + kOneStepRoundings * row.roundoff()) * wanted.norm();
    row.within("in an oblique attitude, the answer to 1 N m about " + name_of(axis), answer_to(axis), wanted, limit);
  }
}

const Question kQuestions[] = {
    {{"force_echoes_the_mass", "mass and inertia",
      "Does 1 N for one step change the velocity by dt/m, along the force, and turn nothing?",
      "16 roundings: inputs, products and a rotation to body axes and back", false},
     force_echoes_the_mass},
    {{"torque_echoes_the_inertia", "mass and inertia",
      "Does 1 N m for one step change the angular velocity by dt/I with the stated I, not one derived from the shape?",
      "16 roundings: inputs, products and a rotation to body axes and back", false},
     torque_echoes_the_inertia},
    {{"inertia_turns_with_the_body", "mass and inertia",
      "Are the principal moments those of the body's axes, also when it stands askew?",
      "16 roundings; askew, besides, what the body turns within the step", false},
     inertia_turns_with_the_body},
};

}  // namespace

std::span<const Question> mass_questions() { return kQuestions; }

}  // namespace plumbline::conformance
