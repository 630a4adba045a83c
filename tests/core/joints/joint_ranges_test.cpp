// Joint ranges: exact impacts at limits, limbs that rest on them, and the rag doll.
#include "plumbline/core/joints/joint_ranges.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "jointed_scenes.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/integration/adaptive_stepper.hpp"
#include "plumbline/core/integration/runge_kutta_4.hpp"
#include "plumbline/core/joints/joint_projection.hpp"
#include "plumbline/core/joints/rigid_doll.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace jointed;

constexpr double kPi = std::numbers::pi;

// A rod of 1 m and 1 kg on a hinge, let go level, with a stop at 0.3 rad beyond the lowest point.
TEST(JointRange, ThrowsThePendulumBackAtTheExactMoment) {
  const double w0 = std::sqrt(1.5 * 9.81), stop = 0.3, e = 0.5;
  ArticulatedBody rod = planar_chain({1}, {0.5}, {1}, {1.0 / 12});
  rod.joints[0].range = JointRange{-3, stop};
  const Quat level = rotation_by(kPi / 2 * Vec3::UnitY());
  std::vector<BodyState> states = {{level * Vec3(0, 0, -0.5), level, Vec3::Zero(), Vec3::Zero()}};
  AdaptiveStepper stepper(1e-14);
  int impacts = 0;
  for (int k = 0; k < 10; ++k) impacts += advance_within_ranges(rod, stepper, 0.1 * k, 0.1, states, {.restitution = e});
  EXPECT_EQ(impacts, 1);

  const PlanarPendulum fall(w0, {-kPi / 2, 0});
  double early = 0.3, late = fall.period() / 2;
  for (int k = 0; k < 100; ++k) (fall.at((early + late) / 2).angle < stop ? early : late) = (early + late) / 2;
  const PlanarPendulum rebound(w0, {stop, -e * fall.at(early).rate});
  const PendulumState expected = rebound.at(1 - early);
  // The stop is met to 1e-12 rad, the steps add 1e-14 each; a second of swinging magnifies both by less than 20.
  EXPECT_NEAR(coordinate_row(rod.joints[0], states).error, expected.angle, 4e-11);
  EXPECT_NEAR(-states[0].w_WB.y(), expected.rate, 1e-10);
  RecordProperty("angle_1e-16", std::to_string((coordinate_row(rod.joints[0], states).error - expected.angle) * 1e16));
}

// Two bodies on one rail in free space, 2 kg and 3 kg, with 0.5 m of play: Newton's law of impact for two masses.
TEST(JointRange, ExchangesMomentumAlongASlider) {
  for (const double e : {0.0, 0.4, 1.0}) {
    ArticulatedBody pair;
    pair.bodies = {{2, Mat3::Identity()}, {3, Mat3::Identity()}};
    std::vector<BodyState> states(2);
    states[1].v_WB.z() = 1;
    pair.joints = {joint_at(JointKind::kSlider, 0, 1, states, Vec3::Zero())};
    pair.joints[0].range = JointRange{-0.25, 0.25};
    RungeKutta4 stepper;  // exact on straight lines
    EXPECT_EQ(advance_within_ranges(pair, stepper, 0, 0.5, states, {.restitution = e}), 1);
    // At t = 0.25 s 3 kg m/s are shared, and the relative speed becomes -e.
    const double v0 = (3 + 3 * e) / 5, v1 = (3 - 2 * e) / 5;
    EXPECT_NEAR(states[0].v_WB.z(), v0, 10 * kEps);
    EXPECT_NEAR(states[1].v_WB.z(), v1, 10 * kEps);
    EXPECT_NEAR(states[0].p_WB.z(), v0 / 4, 2e-12);  // the limit is met to 1e-12 m
    EXPECT_NEAR(states[1].p_WB.z(), 0.25 + v1 / 4, 2e-12);
  }
}

// Gravity presses a level rod onto its stop: it stays, and the stop carries the torque m g d.
TEST(JointRange, HoldsWhatLeansOnItAndLetsGoWhatDoesNot) {
  ArticulatedBody rod = planar_chain({2}, {0.5}, {1}, {0.2});
  rod.joints[0].range = JointRange{kPi / 2, 3};  // level, towards +x
  const Quat level = rotation_by(-kPi / 2 * Vec3::UnitY());
  const BodyState start{level * Vec3(0, 0, -0.5), level, Vec3::Zero(), Vec3::Zero()};
  std::vector<BodyState> states = {start};
  const std::size_t held[] = {0};
  const auto solved = constrained_accelerations(rod, states, {}, held);
  EXPECT_NEAR(solved.range_forces[0], 2 * 9.81 * 0.5, 100 * kEps);
  EXPECT_NEAR(solved.reactions[0].f_W.z(), 2 * 9.81, 100 * kEps);
  RungeKutta4 stepper;
  for (int k = 0; k < 50; ++k) EXPECT_EQ(advance_within_ranges(rod, stepper, 0.02 * k, 0.02, states), 0);
  EXPECT_LT((states[0].p_WB - start.p_WB).norm(), 1e-13);

  rod.gravity_W *= -1;  // now it is lifted off, with m g d/(I + m d^2)
  for (int k = 0; k < 10; ++k) advance_within_ranges(rod, stepper, 0.001 * k, 0.001, states);
  EXPECT_NEAR(states[0].w_WB.norm(), 9.81 / 0.7 * 0.01, 1e-7);
}

// Held coordinates go onto the nearer limit from either side of it, and stand still there; others are left alone.
TEST(JointRange, IsPutBackOntoTheNearerLimitWhereItIsHeld) {
  const std::size_t first[] = {0};
  for (const double off : {1e-4, -1e-4}) {
    for (const double limit : {-0.4, 0.7}) {
      ArticulatedBody chain = planar_chain({1, 1}, {0.5, 0.5}, {1, 1}, {0.2, 0.1});
      chain.joints[0].range = JointRange{-0.4, 0.7};
      chain.joints[1].range = JointRange{-0.1, 0.1};  // beyond it from the start, and not held
      const double angle = limit + off, beyond = 0.3;
      const Quat turned = rotation_by(-angle * Vec3::UnitY());
      const Quat bent = rotation_by(-(angle + beyond) * Vec3::UnitY());
      std::vector<BodyState> states(2);
      states[0] = {turned * Vec3(0, 0, -0.5), turned, Vec3(0.3, 0, 0.1), Vec3(0, 0.2, 0)};
      states[1] = {turned * Vec3(0, 0, -1) + bent * Vec3(0, 0, -0.5), bent, Vec3(0, 0, 0.4), Vec3(0, -0.7, 0)};
      EXPECT_LE(project_positions_held(chain, states, first).error, 1e-13);
      project_velocities(chain, states, first);
      EXPECT_NEAR(coordinate_row(chain.joints[0], states).error, limit, 1e-13);
      EXPECT_NEAR(rate(coordinate_row(chain.joints[0], states), states), 0, 100 * kEps);
      EXPECT_NEAR(coordinate_row(chain.joints[1], states).error, beyond, 10 * std::abs(off));
      EXPECT_GT(std::abs(rate(coordinate_row(chain.joints[1], states), states)), 0.01);
    }
  }
}

// An impulse at a limb that already leans on its limit passes on to the trunk as if the joint were stiff.
TEST(JointRange, PassesTheBlowOnWhereTheLimitIsReached) {
  RigidDoll doll = make_rigid_doll();
  doll.body.joints[kLeftForearm - 1].range->high = 0;  // straight arm: the elbow cannot go on
  const Vec3 hand = doll.states[kLeftForearm].p_WB, blow(-5, 0, 0);
  ArticulatedBody stiff = doll.body;
  stiff.joints[kLeftForearm - 1] = joint_at(
      JointKind::kFixed, kLeftUpperArm, kLeftForearm, doll.states,
      doll.states[kLeftForearm].p_WB + doll.states[kLeftForearm].q_WB * doll.body.joints[kLeftForearm - 1].on_b.anchor);
  std::vector<BodyState> expected = doll.states;
  apply_impulse(stiff, expected, kLeftForearm, hand, blow);
  apply_impulse(doll.body, doll.states, kLeftForearm, hand, blow);
  EXPECT_LT(room_rate(doll.body, {kLeftForearm - 1, -1}, doll.states), -0.1);
  const std::vector<double> impulses = resolve_range_impacts(doll.body, doll.states, {});
  EXPECT_GT(*std::max_element(impulses.begin(), impulses.end()), 0);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((doll.states[i].v_WB - expected[i].v_WB).norm(), 1e-12);
    EXPECT_LT((doll.states[i].w_WB - expected[i].w_WB).norm(), 1e-11);
  }
}

TEST(JointRange, RefusesWhatMakesNoSense) {
  RigidDoll doll = make_rigid_doll();
  RungeKutta4 stepper;
  EXPECT_THROW(resolve_range_impacts(doll.body, doll.states, {.restitution = 1.5}), std::invalid_argument);
  EXPECT_THROW(resolve_range_impacts(doll.body, doll.states, {.restitution = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(advance_within_ranges(doll.body, stepper, 0, -0.1, doll.states), std::invalid_argument);
  EXPECT_THROW(make_rigid_doll(0), std::invalid_argument);
  EXPECT_EQ(range_limits(doll.body).size(), 13u);
}

// Struck on a hand and a foot in free space, the doll tumbles, elbows, knees and neck run into their limits, and what
// is inside can change neither momentum. Linear momentum is a sum that every step and impulse keeps to rounding; the
// angular one is kept by the exact motion, so it is off by no more than the steps allow: 13 numbers of 10 bodies, each
// wrong by up to 1e-12 (1 + |y|) a step, with inertias and lever arms of some kg m.
TEST(RigidDoll, KeepsMomentumJointsAndRangesWhileItTumbles) {
  RigidDoll doll = make_rigid_doll();
  std::vector<BodyState> states = doll.states;
  require_valid(doll.body);
  apply_impulse(doll.body, states, kLeftForearm, states[kLeftForearm].p_WB, Vec3(6, 2, 1));
  apply_impulse(doll.body, states, kRightShank, states[kRightShank].p_WB, Vec3(-15, 3, 0));
  apply_impulse(doll.body, states, kHeadSegment, states[kHeadSegment].p_WB + Vec3(0, 0.05, 0.1), Vec3(8, 0, 0));
  resolve_range_impacts(doll.body, states, {.restitution = 0.3});
  const Vec3 p = linear_momentum(doll.body, states), L = angular_momentum(doll.body, states);
  EXPECT_LT((p - Vec3(-1, 5, 1)).norm(), 73 * 100 * kEps);  // what was given
  double energy = mechanical_energy(doll.body, states), joints = 0, beyond = 0, shift = 0;
  Vec3 centre = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) centre += doll.body.bodies[i].mass * states[i].p_WB;
  AdaptiveStepper stepper(1e-12);
  const double dt = 0.05;
  const int steps = 16;
  int impacts = 0;
  for (int k = 0; k < steps; ++k) {
    impacts += advance_within_ranges(doll.body, stepper, dt * k, dt, states, {.restitution = 0.3});
    joints = max_or_nan(joints, joint_error(doll.body, states));
    for (const RangeLimit& limit : range_limits(doll.body))
      beyond = max_or_nan(beyond, -room(doll.body, limit, states));
    const double now = mechanical_energy(doll.body, states);
    EXPECT_LE(now, energy + 1e-9);  // impacts only take
    energy = now;
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < states.size(); ++i) moment += doll.body.bodies[i].mass * states[i].p_WB;
    shift = max_or_nan(shift, (moment - centre - dt * (k + 1) * p).norm() / 73);
  }
  EXPECT_GE(impacts, 3);
  const double drift = (angular_momentum(doll.body, states) - L).norm();
  EXPECT_LT((linear_momentum(doll.body, states) - p).norm(), 73 * 1000 * kEps);
  EXPECT_LT(drift, 130 * 1e-12 * 10 * (steps + impacts));
  EXPECT_LT(shift, 1e-11);
  EXPECT_LT(joints, 1e-9);
  EXPECT_LT(beyond, 1e-9);
  RecordProperty("impacts", impacts);
  RecordProperty("drift_L_1e-18", std::to_string(drift * 1e18));
  RecordProperty("joints_1e-18", std::to_string(joints * 1e18));
  RecordProperty("beyond_1e-18", std::to_string(beyond * 1e18));
  RecordProperty("p_1e-18", std::to_string((linear_momentum(doll.body, states) - p).norm() * 1e18));
}

}  // namespace
}  // namespace plumbline
