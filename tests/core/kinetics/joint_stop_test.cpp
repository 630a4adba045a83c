// Stops of joints as the simulator meets them: at the exact moment, plastic, and for good while something leans on
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/joints/joint_equations.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

constexpr double kEps = 0x1p-53;

double coordinate(const Scenario& s, std::span<const BodyState> states) {
  return coordinate_row(s.joints[0], states).error;
}
double coordinate_rate(const Scenario& s, std::span<const BodyState> states) {
  return rate(coordinate_row(s.joints[0], states), states);
}

std::vector<BodyState> start_of(const Scenario& s) {
  std::vector<BodyState> states;
  for (const Body& body : s.bodies) states.push_back(body.initial);
  return states;
}

// Two boxes in free space on one slider along z, 2 kg and 3 kg, 0.25 m of play either way.
Scenario sliding_pair(double speed) {
  Scenario s = free_flight(solid("rail", Box{Vec3(0.3, 0.2, 0.4)}, 2, Vec3(0, 0, 0), Vec3::Zero()), Vec3::Zero(), 1);
  s.bodies.push_back(solid("sledge", Box{Vec3(0.1, 0.2, 0.3)}, 3, Vec3(0, 0, 0.5), Vec3(0, 0, speed)));
  s.joints = {joint_at(JointKind::kSlider, 0, 1, start_of(s), Vec3(0, 0, 0.5), Vec3::UnitZ())};
  s.joints[0].range = JointRange{-0.25, 0.25};
  return s;
}

// m v = (m + M) V. The way to the stop takes 0.25 s, which falls into the middle of a step; until then one body moves.
TEST(JointStop, SharesTheMomentumOfASliderAtTheExactMoment) {
  for (const double direction : {1.0, -1.0}) {
    const Scenario s = sliding_pair(direction);
    for (const Scheme& scheme : candidate_schemes(s)) {
      const Trajectory t = simulate(s, scheme, 1.0 / 30);
      const auto end = t.states().last(2);
      const double shared = direction * 3.0 / 5, rest = t.time(t.samples() - 1) - 0.25;
      // Rounding of some operations in each of 30 steps; the stop is met to 1e-12 m.
      EXPECT_NEAR(end[0].v_WB.z(), shared, 30 * 16 * kEps) << name(scheme, s);
      EXPECT_NEAR(end[1].v_WB.z(), shared, 30 * 16 * kEps);
      EXPECT_NEAR(end[0].p_WB.z(), shared * rest, 2e-12);
      EXPECT_NEAR(end[1].p_WB.z(), 0.5 + direction * 0.25 + shared * rest, 2e-12);
    }
  }
}

// A box that swings down about an axis of its own against a stop, then leans on it. Angle by the exact pendulum.
Scenario dropped(const Vec3& axis_in_plane, double stop) {
  const Vec3 axis = axis_in_plane.normalized();  // level, so that the box starts level too
  const Vec3 arm = axis.cross(Vec3::UnitZ());
  Scenario s = free_flight(solid("flap", Box{Vec3(0.4, 0.2, 0.3)}, 2, arm, Vec3::Zero()), Vec3(0, 0, -kG), 1.5);
  s.joints = {joint_at(JointKind::kHinge, kWorld, 0, start_of(s), Vec3::Zero(), axis)};
  // Gravity turns arm towards -z: about axis, from axis x z towards -z, that is the positive sense.
  s.joints[0].range = JointRange{-0.1, stop};
  return s;
}

double final_error_of_flap(const Scheme& scheme, double dt) {
  const Scenario s = dropped(Vec3(1, 2, 0), 2.2);  // past the lowest point, on its way up
  const Trajectory t = simulate(s, scheme, dt);
  const double inertia = s.joints[0].on_b.axis().cwiseProduct(s.bodies[0].inertia).dot(s.joints[0].on_b.axis()) + 2;
  const double w0 = std::sqrt(2 * kG / inertia), quarter = std::acos(0.0);
  // The pendulum's angle counts from straight down; ours from level.
  const PlanarPendulum fall(w0, {-quarter, 0});
  double early = 0.1, late = fall.period() / 2;
  for (int k = 0; k < 100; ++k) (fall.at((early + late) / 2).angle < 2.2 - quarter ? early : late) = (early + late) / 2;
  // Stopped dead, it falls back from there.
  const PlanarPendulum back(w0, {2.2 - quarter, 0});
  return std::abs(coordinate(s, t.states().last(1)) - quarter - back.at(t.time(t.samples() - 1) - early).angle);
}

TEST(JointStop, IsMetAtTheExactMomentSoThatTheOrderStays) {
  // A step that is cut in two is one more step of the same order.
  const auto order = [](const Scheme& scheme) {
    return std::log2(final_error_of_flap(scheme, 1.0 / 512) / final_error_of_flap(scheme, 1.0 / 1024));
  };
  EXPECT_NEAR(order({Integrator::kSemiImplicitEuler}), 1, 0.05);
  EXPECT_NEAR(order({Integrator::kVelocityVerlet}), 2, 0.05);
  Scheme followed{Integrator::kRungeKutta4};
  followed.forces = ForceSampling::kFollowed;
  EXPECT_LT(final_error_of_flap(followed, 1.0 / 128),
            1e-8);  // dt^4 = 4e-9, times the fourth power of w0 T of some units
}

TEST(JointStop, NeverIsPassedNorLeft) {
  for (const double stop : {0.5, 1.5}) {  // both before the lowest point: gravity keeps the box there
    const Scenario s = dropped(Vec3(-3, 1, 0), stop);
    for (const Scheme& scheme : candidate_schemes(s)) {
      const Trajectory t = simulate(s, scheme, 1.0 / 50);
      bool arrived = false;
      for (std::size_t k = 0; k < t.samples(); ++k) {
        const auto states = t.states().subspan(k, 1);
        EXPECT_LE(coordinate(s, states), stop + 2e-12) << name(scheme, s);
        if (arrived) {
          EXPECT_NEAR(coordinate(s, states), stop, 2e-12);
          EXPECT_NEAR(coordinate_rate(s, states), 0, 1e-12);
        }
        arrived = arrived || coordinate(s, states) > stop - 1e-9;
      }
      EXPECT_TRUE(arrived);
    }
  }
}

// A torque presses the forearm against its stop while both tumble freely: the axis turns, the stop has to follow it.
TEST(JointStop, HoldsBetweenTwoBodiesThatTumble) {
  Scenario s = free_flight(solid("upper", Box{Vec3(1, 0.5, 0.3)}, 2, Vec3(0, 0, 0), Vec3::Zero()), Vec3::Zero(), 2);
  s.bodies.push_back(solid("fore", Box{Vec3(0.4, 0.6, 0.8)}, 1, Vec3(1, 0.2, 0), Vec3::Zero()));
  const Vec3 w(0.2, 1.1, -0.4), axis = Vec3(0.3, 1, 0.2).normalized(), anchor(0.6, 0.1, 0);
  for (Body& body : s.bodies) {
    body.initial.w_WB = w;
    body.initial.v_WB = w.cross(body.initial.p_WB);
  }
  s.bodies[1].initial.w_WB += 0.8 * axis;
  s.bodies[1].initial.v_WB += 0.8 * axis.cross(s.bodies[1].initial.p_WB - anchor);
  s.joints = {joint_at(JointKind::kHinge, 0, 1, start_of(s), anchor, axis)};
  s.joints[0].range = JointRange{-1, 0.2};
  s.drives = {{0, [](double, double, double) { return 0.3; }, "0.3"}};
  require_sound(s);
  const Vec3 p0 = momentum(s, start_of(s)), L0 = angular_momentum(s, start_of(s));
  const double dt = 1.0 / 100;
  const Trajectory t = simulate(s, {Integrator::kVelocityVerlet}, dt);
  std::size_t held = 0;
  for (std::size_t k = 0; k < t.samples(); ++k) {
    const auto states = t.states().subspan(2 * k, 2);
    const double q = coordinate(s, states);
    EXPECT_LE(q, 0.2 + 2e-12);
    EXPECT_LE(joint_error(articulated_body(s), states), 1e-12);
    if (q > 0.2 - 1e-11) ++held;
  }
  EXPECT_GT(held, t.samples() / 2);  // 0.8 rad/s and more cover 0.2 rad within 0.25 s of 2 s
  const auto end = t.states().last(2);
  // Forces, impulses and drives come in pairs: rounding. The scheme turns the whole with an error of second order.
  EXPECT_LE((momentum(s, end) - p0).norm(), 200 * 100 * kEps);
  const double fastest = w.norm() + 0.8;
  EXPECT_LE((angular_momentum(s, end) - L0).norm(), std::pow(fastest, 3) * dt * dt * 2 * L0.norm());
}

TEST(JointStop, RefusesAnIntegratorThatNeedsThePreviousStep) {
  const Scenario s = sliding_pair(1);
  Scheme scheme{Integrator::kPositionVerlet};
  scheme.forces = ForceSampling::kFollowed;
  EXPECT_THROW(simulate(s, scheme, 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
