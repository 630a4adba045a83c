// Limits of joints: where they stand, that they stop without a rebound, push without pulling, and act on both bodies.
#include <fmt/format.h>

#include <algorithm>

#include "joint_scenes.hpp"
#include "plumbline/core/integration/runge_kutta_4.hpp"
#include "plumbline/core/joints/joint_ranges.hpp"

namespace plumbline::conformance {
namespace {

constexpr JointKind kBounded[] = {JointKind::kHinge, JointKind::kSlider};
constexpr double kShortStep = 1.0 / 256;  // [s]

// The two ends differ, so that one that was taken for the other shows.
JointRange range_of(JointKind kind) {
  return kind == JointKind::kHinge ? JointRange{-0.3, 0.2} : JointRange{-0.12, 0.08};
}
// Either end is reached within a quarter of a second, never at the boundary of a step [rad/s] or [m/s].
double pace_of(JointKind kind) { return kind == JointKind::kHinge ? 1.5 : 0.6; }

// Softness of a joint costs a hundredth, of the arm or of the radian.
double softness_of(JointKind kind) { return kind == JointKind::kHinge ? 0.01 : 0.01 * kArm; }

Vec3 axis_of(const Interview& row, const Scenario& scenario) {
  const Joint& joint = scenario.joints[0];
  const Vec3 axis_W = scenario.bodies[joint.b].initial.q_WB * joint.on_b.axis();
  if (!row.planar()) return axis_W;  // and nothing may leave the plane, not even by rounding
  return joint.kind == JointKind::kSlider ? Vec3(axis_W.x(), 0, axis_W.z()) : Vec3(0, axis_W.y(), 0);
}

// Adds `rate` of the joint's coordinate to the velocities of the arm, its body b.
void set_rate(const Interview& row, Scenario& scenario, double rate) {
  const Joint& joint = scenario.joints[0];
  const Vec3 axis_W = axis_of(row, scenario);
  BodyState& s = scenario.bodies[joint.b].initial;
  if (joint.kind == JointKind::kSlider) {
    s.v_WB += rate * axis_W;
  } else {
    s.w_WB += rate * axis_W;
    s.v_WB += (rate * axis_W).cross(s.p_WB - anchor_W(row));
  }
}

Scenario bounded(const Interview& row, JointKind kind, const std::optional<Vec3>& axis_W = {}) {
  Scenario scenario;
  scenario.bodies = {arm(row)};
  scenario.joints = {joint_of(row, kind, kWorld, 0, initial_states(scenario), axis_W)};
  scenario.joints[0].range = range_of(kind);
  return scenario;
}

double coordinate(const Scenario& scenario, const std::vector<BodyState>& states) {
  return coordinate_row(scenario.joints[0], states).error;
}
double coordinate_rate(const Scenario& scenario, const std::vector<BodyState>& states) {
  return rate(coordinate_row(scenario.joints[0], states), states);
}

// Calls with both kinds of joint that have a range, as far as the row has them.
void for_each_kind(const Interview& row, const std::optional<Vec3>& axis_W,
                   const std::function<void(JointKind, const Scenario&)>& ask) {
  row.require(Feature::kJointRange);
  int asked = 0;
  for (JointKind kind : kBounded) {
    const Scenario scenario = bounded(row, kind, axis_W);
    if (!row.can_run(scenario)) continue;
    ask(kind, scenario);
    ++asked;
  }
  if (asked == 0) throw NotAsked("the engine has no hinges and no sliders");
}

// How far the coordinate goes, towards either end.
void expect_stops(Interview& row, JointKind kind, const Scenario& still) {
  for (double direction : {1.0, -1.0}) {
    Scenario scenario = still;
    set_rate(row, scenario, direction * pace_of(kind));
    const auto world = row.build(scenario);
    double farthest = 0;
    for (int k = 0; k < 128; ++k) {
      const double q = coordinate(scenario, run(*world, scenario, kShortStep, 1));
      farthest = std::isnan(q) ? q : std::max(farthest, direction * q);
      if (std::isnan(q)) break;
    }
    const JointRange range = range_of(kind);
    // A stepping engine sees the stop up to one step late, and may answer one step after that.
    row.within(fmt::format("the farthest that a {} goes in the sense {:+g}", joint_name(kind), direction), farthest,
               direction > 0 ? range.high : -range.low, 2 * pace_of(kind) * kShortStep + softness_of(kind));
  }
}

void stops_stand_where_stated(Interview& row) {
  for_each_kind(row, {}, [&](JointKind kind, const Scenario& scenario) { expect_stops(row, kind, scenario); });
}

void stops_of_an_oblique_axis(Interview& row) {
  row.require(Feature::kSpatial);
  for_each_kind(row, Vec3(1, 2, 3).normalized(),
                [&](JointKind kind, const Scenario& scenario) { expect_stops(row, kind, scenario); });
}

void stops_do_not_rebound(Interview& row) {
  for_each_kind(row, {}, [&](JointKind kind, const Scenario& still) {
    for (double direction : {1.0, -1.0}) {
      Scenario scenario = still;
      set_rate(row, scenario, direction * pace_of(kind));
      const auto end = run(*row.build(scenario), scenario, kShortStep, 128);
      const std::string how = fmt::format(" of a {} after a stop in the sense {:+g}", joint_name(kind), direction);
      // What soft joints leave of a push, as elsewhere in the kit.
      row.within("the rate" + how, coordinate_rate(scenario, end), 0, 0.02 * pace_of(kind));
    }
  });
}

void stops_push_and_never_pull(Interview& row) {
  row.require(Feature::kForce);
  row.require(Feature::kTorque);
  for_each_kind(row, {}, [&](JointKind kind, Scenario scenario) {
    scenario.joints[0].range = JointRange{0, 2};  // leans on its lower end from the start
    const Vec3 axis = axis_of(row, scenario);
    const Wrench pull = kind == JointKind::kHinge ? Wrench{Vec3::Zero(), 3 * axis} : Wrench{20 * axis, Vec3::Zero()};
    const Wrench press{-pull.f_W, -pull.tau_W};
    const auto world = row.build(scenario);
    const int steps = 64;
    const auto pressed = push(*world, scenario, 0, press, kShortStep, steps);
    const std::string how = ", " + std::string(joint_name(kind));
    row.within("the coordinate under a load" + how, coordinate(scenario, pressed), 0, softness_of(kind));
    // From there as if there were no stop: within its range a joint is free.
    const auto away = push(*world, scenario, 0, pull, kShortStep, steps);
    Scenario free = scenario;
    free.joints[0].range.reset();
    std::vector<BodyState> exact = initial_states(scenario);
    RungeKutta4 stepper;
    const AccelerationField field = constrained_field(
        articulated_body(free), [&](double, std::span<const BodyState>, std::span<Wrench> w) { w[0] = pull; });
    for (int k = 0; k < steps; ++k) stepper.step(field, k * kShortStep, kShortStep, exact);
    const double fastest = coordinate_rate(free, exact);
    row.within("the coordinate when pulled away" + how, coordinate(scenario, away), coordinate(free, exact),
               2 * kShortStep * fastest + softness_of(kind));
  });
}

// Base and arm turn as one, the arm besides towards a stop: nothing outside acts on the pair.
Scenario pair_with_play(const Interview& row, JointKind kind, double direction) {
  Scenario scenario;
  scenario.bodies = {base(row), arm(row)};
  const Vec3 w = row.planar() ? Vec3(0, 2, 0) : Vec3(1, 1.5, -0.8);
  for (Body& body : scenario.bodies) {
    body.initial.w_WB = w;
    body.initial.v_WB = w.cross(body.initial.p_WB);
  }
  scenario.joints = {joint_of(row, kind, 0, 1, initial_states(scenario))};
  scenario.joints[0].range = range_of(kind);
  set_rate(row, scenario, direction * pace_of(kind));
  return scenario;
}

void expect_shared_stop(Interview& row, const Scenario& scenario, const std::string& how) {
  const ArticulatedBody body = articulated_body(scenario);
  const std::vector<BodyState> before = initial_states(scenario);
  std::vector<BodyState> exact = before;
  RungeKutta4 stepper;
  const int steps = 64;
  double fastest = 0, turning = 0, scale = 0;
  for (int k = 0; k < steps; ++k) {
    advance_within_ranges(body, stepper, k * kShortStep, kShortStep, exact);
    for (const BodyState& s : exact) {
      fastest = std::max(fastest, s.v_WB.norm() + kArm * s.w_WB.norm());
      turning = std::max(turning, s.w_WB.norm());
    }
  }
  for (const Body& b : scenario.bodies) scale += b.mass * turning * kArm;
  const auto after = run(*row.build(scenario), scenario, kShortStep, steps);
  // The way of two steps, one to see the stop and one to answer, and what softness costs.
  const double limit = 2 * kShortStep * fastest + 0.01 * kArm;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::string& name = scenario.bodies[i].name;
    row.within("the position of '" + name + "'" + how, after[i].p_WB, exact[i].p_WB, limit);
    row.within("the angle to the exact attitude of '" + name + "'" + how, geodesic_angle(after[i].q_WB, exact[i].q_WB),
               0, limit / kArm);
  }
  // What a scheme in the joint's coordinates loses in every step while the pair turns by w dt.
  const double turn = turning * kShortStep;
  const double lost = (2 * turn * turn + kOneStepRoundings * row.roundoff()) * steps * scale;
  row.within("the momentum" + how, linear_momentum(body, after), linear_momentum(body, before), lost);
  row.within("the angular momentum" + how, angular_momentum(body, after), angular_momentum(body, before), lost * kArm);
}

void stops_act_on_both_bodies(Interview& row) {
  row.require(Feature::kJointRange);
  int asked = 0;
  for (JointKind kind : kBounded) {
    if (!row.can_run(pair_with_play(row, kind, 1))) continue;
    ++asked;
    for (double direction : {1.0, -1.0}) {
      Scenario scenario = pair_with_play(row, kind, direction);
      const std::string how = fmt::format(" after a stop in the sense {:+g}, {}", direction, joint_name(kind));
      expect_shared_stop(row, scenario, how);
      scenario.joints[0] = reversed(scenario.joints[0]);
      expect_shared_stop(row, scenario, how + " stated the other way round");
    }
  }
  if (asked == 0) throw NotAsked("the engine has no hinges and no sliders");
}

constexpr const char* kPlace =
    "the way of two steps, one to see the stop and one to answer, and 1 % of the radian or arm";

const Question kQuestions[] = {
    {{"stops_stand_where_stated", "limits of joints",
      "Do hinge and slider stop at either end of their range, counted from the start in the joint's own sense?", kPlace,
      false},
     stops_stand_where_stated},
    {{"stops_of_an_oblique_axis", "limits of joints",
      "Do hinge and slider stop at either end along an axis that is none of world or body?", kPlace, false},
     stops_of_an_oblique_axis},
    {{"stops_do_not_rebound", "limits of joints", "Does what has met a stop stay there, when nothing drives it?",
      "2 % of the speed at which it came, what soft joints leave", true},
     stops_do_not_rebound},
    {{"stops_push_and_never_pull", "limits of joints",
      "Does a stop bear a load, and let go of what is pulled away from it?",
      "1 % of the radian or arm under load; the way of two steps more when it is pulled away", true},
     stops_push_and_never_pull},
    {{"stops_act_on_both_bodies", "limits of joints",
      "Does a stop between two free bodies act on both and keep their momenta, whichever the joint names first?",
      "the way of two steps and 1 % of the arm; 2 (w dt)^2 of the momenta in each step", true},
     stops_act_on_both_bodies},
};

}  // namespace

std::span<const Question> stop_questions() { return kQuestions; }

}  // namespace plumbline::conformance
