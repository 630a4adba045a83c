// Input that no engine can answer: it must end with an exception or stay finite, never with a wrong answer in silence.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool all_finite(const std::vector<BodyState>& states) { return std::ranges::all_of(states, is_finite); }

Scenario feather() {
  Scenario scenario;
  scenario.bodies = {ball("feather", 0.1, 1, Vec3::Zero())};
  return scenario;
}

void impossible_bodies_are_refused(Interview& row) {
  const auto refuse = [&](const std::string& what, const std::function<void(Body&)>& spoil) {
    Scenario scenario = feather();
    spoil(scenario.bodies[0]);
    row.refused(
        "a body with " + what, [&] { row.build(scenario); }, "feather");
  };
  for (double bad : {0.0, -1.0, kNaN, kInfinity}) {
    refuse(fmt::format("mass {}", bad), [&](Body& body) { body.mass = bad; });
    refuse(fmt::format("a moment of inertia of {}", bad), [&](Body& body) { body.inertia.y() = bad; });
  }
  refuse("a position that is NaN", [](Body& body) { body.initial.p_WB.z() = kNaN; });
  refuse("a velocity that is infinite", [](Body& body) { body.initial.v_WB.x() = kInfinity; });
  refuse("an attitude of length 2", [](Body& body) { body.initial.q_WB = Quat(2, 0, 0, 0); });
  Scenario scenario = feather();
  scenario.gravity.z() = kNaN;
  row.refused("gravity that is NaN", [&] { row.build(scenario); });
}

void force_that_is_nan_shows(Interview& row) {
  row.require(Feature::kForce);
  const Scenario scenario = feather();
  for (double bad : {kNaN, kInfinity}) {
    const auto world = row.build(scenario);
    std::vector<BodyState> states;
    try {
      states = push(*world, scenario, 0, {Vec3(bad, 0, 0), Vec3::Zero()}, kStep, 2);
    } catch (const std::exception&) {
      continue;  // loud
    }
    row.expect(!all_finite(states), fmt::format("a force of {} leaves every number finite: it was swallowed", bad));
  }
}

void step_of_zero_moves_nothing(Interview& row) {
  Scenario scenario = feather();
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.bodies[0].initial.v_WB = Vec3(1, 0, 2);
  scenario.bodies[0].initial.w_WB = Vec3(0, 3, 0);
  for (double dt : {0.0, kNaN}) {
    const auto world = row.build(scenario);
    std::vector<BodyState> states;
    try {
      states = run(*world, scenario, dt, 1);
    } catch (const std::exception&) {
      continue;  // loud
    }
    if (dt != 0) {
      row.expect(!all_finite(states), "a step of NaN leaves every number finite: it was swallowed");
      continue;
    }
    const BodyState& stated = scenario.bodies[0].initial;
    row.within("the position after a step of 0 s", states[0].p_WB, stated.p_WB, 0);
    row.within("the velocity after a step of 0 s", states[0].v_WB, stated.v_WB, row.roundoff() * stated.v_WB.norm());
    row.within("the spin after a step of 0 s", states[0].w_WB, stated.w_WB,
               kOneStepRoundings * row.roundoff() * stated.w_WB.norm());
    const BodyState next = run(*world, scenario, kStep, 1)[0];
    row.within(
        "the velocity after a step of 0 s and a true one", next.v_WB, Vec3(stated.v_WB + kStep * scenario.gravity),
        kOneStepRoundings * row.roundoff() * stated.v_WB.norm() + std::abs(row.info().velocity_offset) * 9.81 * kStep);
  }
}

void coincident_bodies_stay_finite(Interview& row) {
  Scenario scenario;
  scenario.contact = ContactMaterial{0, 0};
  const double radius = 0.25;
  scenario.bodies = {ball("one", radius, 1, Vec3(1, 0, 2)), ball("other", radius, 1, Vec3(1, 0, 2))};
  const int steps = 32;
  std::vector<BodyState> states;
  const auto world = row.build(scenario);
  try {
    states = run(*world, scenario, kStep, steps);
  } catch (const std::exception&) {
    return;  // loud
  }
  // Nothing is faster than what throws the two apart within one step.
  const double fastest = 2 * radius / kStep;
  for (std::size_t i = 0; i < 2; ++i) {
    row.within("the velocity of '" + scenario.bodies[i].name + "'", states[i].v_WB, Vec3::Zero(), fastest);
  }
  row.within("the momentum of two balls of 1 kg in one place", states[0].v_WB + states[1].v_WB, Vec3::Zero(),
             steps * kOneStepRoundings * row.roundoff() * fastest);
  row.expect(all_finite(states), "a number is not finite");
}

void huge_speed_is_kept(Interview& row) {
  for (double speed : {1e3, 1e6, 1e12}) {
    Scenario scenario = feather();
    scenario.bodies[0].initial.v_WB = Vec3(speed, 0, 0);
    std::vector<BodyState> states;
    const auto world = row.build(scenario);
    try {
      states = run(*world, scenario, kStep, 2);
    } catch (const std::exception&) {
      continue;  // loud
    }
    if (!all_finite(states)) continue;  // and so is this
    row.within(fmt::format("the way of a free ball at {} m/s", speed), states[0].p_WB.x(), 2 * kStep * speed,
               8 * row.roundoff() * kStep * speed);
    row.within(fmt::format("the velocity of a free ball at {} m/s", speed), states[0].v_WB.x(), speed,
               8 * row.roundoff() * speed);
  }
}

const Question kQuestions[] = {
    {{"impossible_bodies_are_refused", "hostile input",
      "Are mass, inertia or a state that is zero, negative, infinite or NaN refused, with the name of the body?", "",
      false},
     impossible_bodies_are_refused},
    {{"force_that_is_nan_shows", "hostile input",
      "Does a force that is NaN or infinite end with an exception or in states that are not finite?", "", false},
     force_that_is_nan_shows},
    {{"step_of_zero_moves_nothing", "hostile input",
      "Does a step of 0 s end with an exception or leave the state as it is, and one of NaN not pass for a step?",
      "one rounding; 16 for the spin, for a rotation and back", false},
     step_of_zero_moves_nothing},
    {{"coincident_bodies_stay_finite", "hostile input",
      "Do two balls in the same place end with an exception or stay finite, with no momentum from nothing?",
      "the speed that parts them within one step; momentum 16 roundings a step", false},
     coincident_bodies_stay_finite},
    {{"huge_speed_is_kept", "hostile input",
      "Does a free ball keep a speed of up to 1e12 m/s, or end with an exception, rather than be slowed in silence?",
      "8 roundings: two steps of a product and a sum", false},
     huge_speed_is_kept},
};

}  // namespace

std::span<const Question> hostile_questions() { return kQuestions; }

}  // namespace plumbline::conformance
