// Closed loops, which only maximal coordinates know, and the way back onto the joints.
#include "plumbline/core/joints/joint_projection.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "jointed_scenes.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/integration/adaptive_stepper.hpp"
#include "plumbline/core/integration/runge_kutta_4.hpp"
#include "plumbline/core/joints/constrained_motion.hpp"
#include "plumbline/core/joints/rigid_doll.hpp"

namespace plumbline {
namespace {

using namespace jointed;

constexpr double kPi = std::numbers::pi;

// The n-four-bar of the IFToMM benchmark A02: n + 1 upright rods on the ground, n level ones across their tops, all of
// 1 kg and 1 m; the upright ones start with 1 m/s at their tops. In space five rows a hinge are far too many.
struct FourBar {
  ArticulatedBody body;
  std::vector<BodyState> states;
  explicit FourBar(std::size_t n) {
    body.gravity_W = Vec3(0, 0, -9.81);
    const Mat3 rod = Mat3::Identity() / 12;
    for (std::size_t k = 0; k <= n; ++k) {
      body.bodies.push_back({1, rod});
      states.push_back({{static_cast<double>(k), 0, 0.5}, Quat::Identity(), {0.5, 0, 0}, {0, 1, 0}});
    }
    for (std::size_t k = 0; k < n; ++k) {
      body.bodies.push_back({1, rod});
      states.push_back({{static_cast<double>(k) + 0.5, 0, 1}, Quat::Identity(), {1, 0, 0}, {0, 0, 0}});
    }
    const auto hinge = [&](std::size_t a, std::size_t b, double x, double z) {
      body.joints.push_back(joint_at(JointKind::kHinge, a, b, states, {x, 0, z}, Vec3::UnitY()));
    };
    for (std::size_t k = 0; k <= n; ++k) hinge(kWorld, k, static_cast<double>(k), 0);
    for (std::size_t k = 0; k < n; ++k) {
      hinge(k, n + 1 + k, static_cast<double>(k), 1);
      hinge(k + 1, n + 1 + k, static_cast<double>(k) + 1, 1);
    }
  }
};

TEST(FourBarLoop, TurnsThroughItsSingularPoseAsTheExactOne) {
  FourBar loop(2);
  // theta'' = w^2 sin(theta) from upright, w^2 = g ((N + 1)/2 + N)/((N + 1)/3 + N).
  const PlanarPendulum exact(std::sqrt(9.81 * 3.5 / 3), {kPi, 1});
  EXPECT_NEAR(exact.period(), 1.942514923, 1e-9);  // published
  EXPECT_NEAR(-std::sin(exact.at(10).angle), 0.3284581115, 1e-9);
  EXPECT_NEAR(-std::cos(exact.at(10).angle), 0.9445185382, 1e-9);
  EXPECT_NEAR(exact.at(10).rate, 1.50664218, 1e-8);
  EXPECT_EQ(constrained_accelerations(loop.body, loop.states).rank, 29);  // of 35 rows: one freedom is left

  const auto off = [&](double t) {
    const double angle = exact.at(t).angle;
    return (2 * loop.states[0].p_WB - Vec3(-std::sin(angle), 0, -std::cos(angle))).norm();
  };
  const AccelerationField field = constrained_field(loop.body);
  AdaptiveStepper before(1e-13);
  for (int k = 0; k < 12; ++k) before.step(field, 0.05 * k, 0.05, loop.states);
  EXPECT_LT(off(0.6), 1e-10);  // asked of a reference
  RecordProperty("before_1e-18", std::to_string(off(0.6) * 1e18));

  // At t = 0.71 s all rods are level, and the loop could leave its path. Projected after each step it does not, and the
  // order of the integrator stays what it is.
  const auto run = [&](double from, double to, int steps) {
    RungeKutta4 stepper;
    for (int k = 0; k < steps; ++k) {
      stepper.step(field, from, (to - from) / steps, loop.states);
      project_positions(loop.body, loop.states);
      project_velocities(loop.body, loop.states);
    }
    return off(to);
  };
  const std::vector<BodyState> start = loop.states;
  const double coarse = run(0.6, 1, 200);
  loop.states = start;
  const double fine = run(0.6, 1, 400);
  const double order = std::log2(coarse / fine);
  EXPECT_NEAR(order, 4, 0.05);
  EXPECT_LT(fine, 1e-11);
  RecordProperty("order_1e-6", std::to_string(order * 1e6));

  // Ten level poses later, with the coarse step: the energy drifts like t, so the phase like t^2, (9.4/0.4)^2 = 552.
  const double end = run(1, 10, 4500);
  EXPECT_LT(end, 552 * coarse);
  EXPECT_LT(joint_error(loop.body, loop.states), 1e-12);
  RecordProperty("end_1e-15", std::to_string(end * 1e15));
}

// Crank 0.3 m, rod 1 m, a block on rails: hinge, hinge, hinge and slider in one loop.
TEST(SliderCrank, KeepsItsEnergyAndTheGeometryOfThePiston) {
  const double r = 0.3, l = 1, w = 4;
  ArticulatedBody body;
  body.gravity_W = Vec3(0, 0, -9.81);
  body.bodies = {{1, 0.02 * Mat3::Identity()}, {2, 0.2 * Mat3::Identity()}, {1.5, 0.1 * Mat3::Identity()}};
  std::vector<BodyState> states(3);
  // The crank points up: the rod then only moves along x, with r w.
  const double cosine = std::sqrt(1 - r * r / (l * l));
  const Vec3 pin(0, 0, r), piston(l * cosine, 0, 0);
  states[0] = {pin / 2, Quat::Identity(), {r * w / 2, 0, 0}, {0, w, 0}};
  states[1] = {(pin + piston) / 2, Quat::Identity(), {r * w, 0, 0}, Vec3::Zero()};
  states[2] = {piston, Quat::Identity(), {r * w, 0, 0}, Vec3::Zero()};
  body.joints = {joint_at(JointKind::kHinge, kWorld, 0, states, Vec3::Zero(), Vec3::UnitY()),
                 joint_at(JointKind::kHinge, 0, 1, states, pin, Vec3::UnitY()),
                 joint_at(JointKind::kHinge, 1, 2, states, piston, Vec3::UnitY()),
                 joint_at(JointKind::kSlider, kWorld, 2, states, piston, Vec3::UnitX())};
  EXPECT_EQ(constrained_accelerations(body, states).rank, 17);
  const double energy = mechanical_energy(body, states);
  AdaptiveStepper stepper(1e-13);
  const AccelerationField field = constrained_field(body);
  double least = energy, most = energy;
  for (int k = 0; k < 40; ++k) {
    stepper.step(field, 0.05 * k, 0.05, states);
    const Vec3 tip = 2 * states[0].p_WB;
    EXPECT_NEAR(states[2].p_WB.x(), tip.x() + std::sqrt(l * l - tip.z() * tip.z()), 1e-10);
    EXPECT_NEAR(tip.norm(), r, 1e-10);
    least = std::min(least, mechanical_energy(body, states));
    most = std::max(most, mechanical_energy(body, states));
  }
  EXPECT_LT(most - least, 1e-10 * (energy + 20));  // asked of a reference; [J]
}

TEST(JointProjection, ClosesTheJointsQuadraticallyWithoutMovingTheWhole) {
  Random random(31);
  for (int n = 0; n < 5; ++n) {
    RigidDoll doll = make_rigid_doll();
    for (BodyState& s : doll.states) {
      s.p_WB += random.vector(1e-3);
      s.q_WB = (s.q_WB * rotation_by(random.vector(1e-3))).normalized();
    }
    const std::vector<BodyState> before = doll.states;
    const Projection done = project_positions(doll.body, doll.states);
    EXPECT_LE(done.error, 1e-13);
    EXPECT_LE(done.sweeps, 4);  // 1e-3, 1e-6, 1e-12 times a curvature of 1/0.1 m, rounding
    Vec3 shift = Vec3::Zero();
    for (std::size_t i = 0; i < before.size(); ++i) {
      shift += doll.body.bodies[i].mass * (doll.states[i].p_WB - before[i].p_WB);
    }
    EXPECT_LT(shift.norm(), 73 * 100 * kEps);
  }
}

TEST(JointProjection, TakesTheLeastEnergyAndNoMomentumFromVelocities) {
  Random random(32);
  RigidDoll doll = make_rigid_doll();
  for (BodyState& s : doll.states) {
    s.v_WB = random.vector(1);
    s.w_WB = random.vector(1);
  }
  const double before = mechanical_energy(doll.body, doll.states);
  const Vec3 p = linear_momentum(doll.body, doll.states), L = angular_momentum(doll.body, doll.states);
  EXPECT_GT(project_velocities(doll.body, doll.states), 0.1);
  const double after = mechanical_energy(doll.body, doll.states);
  EXPECT_LT(after, before);
  EXPECT_LT((linear_momentum(doll.body, doll.states) - p).norm(), 73 * 100 * kEps);
  EXPECT_LT((angular_momentum(doll.body, doll.states) - L).norm(), 73 * 100 * kEps);
  EXPECT_LT(project_velocities(doll.body, doll.states), 100 * kEps);  // nothing is left to take
  EXPECT_NEAR(mechanical_energy(doll.body, doll.states), after, 1000 * kEps * after);
}

TEST(JointProjection, PutsACoordinateBeyondItsRangeOntoTheLimit) {
  RigidDoll doll = make_rigid_doll();
  const Joint& elbow = doll.body.joints[kLeftForearm - 1];
  BodyState& forearm = doll.states[kLeftForearm];
  forearm.q_WB = rotation_by(Vec3(0, 0.07, 0));  // 0.02 rad more than an elbow can overstretch
  EXPECT_NEAR(coordinate_row(elbow, doll.states).error, 0.07, 1e-15);
  EXPECT_LE(project_positions(doll.body, doll.states).error, 1e-13);
  EXPECT_NEAR(coordinate_row(elbow, doll.states).error, elbow.range->high, 1e-13);
}

TEST(JointProjection, SaysWhenTheStatesAreNotNumbers) {
  RigidDoll doll = make_rigid_doll();
  doll.states[3].p_WB.x() = std::nan("");
  EXPECT_TRUE(std::isnan(project_positions(doll.body, doll.states).error));
  EXPECT_TRUE(std::isnan(constrained_accelerations(doll.body, doll.states).accelerations[0].linear.x()));
  EXPECT_TRUE(std::isnan(joint_error(doll.body, doll.states)));
}

}  // namespace
}  // namespace plumbline
