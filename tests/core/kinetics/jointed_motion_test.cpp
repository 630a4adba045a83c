// Bodies that joints hold, stepped by the simulator: the order of each scheme, and what a closed system keeps.
#include <gtest/gtest.h>

#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/joints/joint_equations.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

// A box on a hinge that starts 1 m beside it.
Scenario pendulum(double duration) {
  Scenario s =
      free_flight(solid("bob", Box{Vec3(0.4, 0.2, 0.3)}, 2, Vec3(1, 0, 0), Vec3::Zero()), Vec3(0, 0, -kG), duration);
  s.joints = {joint_at(JointKind::kHinge, kWorld, 0, {s.bodies[0].initial}, Vec3::Zero(), Vec3::UnitY())};
  return s;
}

// Distance from the exact pendulum at the end.
double final_error(const Scheme& scheme, double dt) {
  const Scenario s = pendulum(1);
  const double inertia = s.bodies[0].inertia.y() + 2;
  const PlanarPendulum exact(std::sqrt(2 * kG / inertia), {std::acos(0.0), 0});
  const Trajectory t = simulate(s, scheme, dt);
  const double angle = exact.at(1).angle;
  return (t.at(t.samples() - 1, 0).p_WB - Vec3(std::sin(angle), 0, -std::cos(angle))).norm();
}

double observed_order(const Scheme& scheme) {
  return std::log2(final_error(scheme, 1.0 / 512) / final_error(scheme, 1.0 / 1024));
}

TEST(JointedMotion, HasTheOrderOfItsIntegrator) {
  // The observed order is off by what the next term of the error's series brings, c dt. With steps twice as long
  // Verlet, the worst, was 0.057 off: 0.03 is left here.
  EXPECT_NEAR(observed_order({Integrator::kSemiImplicitEuler}), 1, 0.05);
  EXPECT_NEAR(observed_order({Integrator::kExplicitEuler}), 1, 0.05);
  EXPECT_NEAR(observed_order({Integrator::kVelocityVerlet}), 2, 0.05);
  Scheme followed{Integrator::kRungeKutta4};
  followed.forces = ForceSampling::kFollowed;
  EXPECT_NEAR(observed_order(followed), 4, 0.1);
}

TEST(JointedMotion, NeverLetsAJointComeApart) {
  for (const Scheme& scheme : candidate_schemes(pendulum(1))) {
    const Scenario s = pendulum(3);
    const ArticulatedBody body = articulated_body(s);
    const Trajectory t = simulate(s, scheme, 1.0 / 50);
    for (std::size_t k = 0; k < t.samples(); ++k) {
      EXPECT_LE(joint_error(body, t.states().subspan(k, 1)), 1e-12) << name(scheme, s);
    }
  }
}

// Two boxes tied by a joint, turning freely: nothing outside acts on the pair.
TEST(JointedMotion, KeepsTheMomentaOfAFreePair) {
  for (const JointKind kind :
       {JointKind::kBall, JointKind::kHinge, JointKind::kSlider, JointKind::kFixed, JointKind::kDistance}) {
    Scenario s =
        free_flight(solid("one", Box{Vec3(1, 0.5, 0.3)}, 2, Vec3(0, 0, 0), Vec3(0.3, 0, 0.1)), Vec3::Zero(), 2);
    s.bodies.push_back(solid("two", Box{Vec3(0.4, 0.6, 0.8)}, 1, Vec3(1, 0.2, 0), Vec3::Zero()));
    const Vec3 w(0.2, 1.1, -0.4);  // both turn as one, which every joint allows
    for (Body& body : s.bodies) {
      body.initial.w_WB = w;
      body.initial.v_WB = Vec3(0.3, 0, 0.1) + w.cross(body.initial.p_WB);
    }
    const std::vector<BodyState> start = {s.bodies[0].initial, s.bodies[1].initial};
    s.joints = {kind == JointKind::kDistance ? rod_between(0, 1, start, Vec3(0.5, 0, 0), Vec3(0.8, 0.2, 0))
                                             : joint_at(kind, 0, 1, start, Vec3(0.6, 0.1, 0), Vec3(0.3, 1, 0.2))};
    require_sound(s);
    const Trajectory t = simulate(s, {Integrator::kVelocityVerlet}, 1.0 / 200);
    const Vec3 p0 = momentum(s, start), L0 = angular_momentum(s, start);
    const auto end = t.states().last(2);
    // Forces come in pairs: only rounding, one of numbers up to 1 for each of 400 steps and some 100 operations.
    EXPECT_LE((momentum(s, end) - p0).norm(), 400 * 100 * 0x1p-53) << joint_name(kind);
    // The scheme turns the whole with an error of second order: (w dt)^2/12 of |L| over 2 s, and as much in the joint.
    const double dt = 1.0 / 200, turning = w.norm() * w.norm() * w.norm() * dt * dt * 2;
    EXPECT_LE((angular_momentum(s, end) - L0).norm(), turning * L0.norm()) << joint_name(kind);
    const double e0 = energy(s, start);
    EXPECT_NEAR(energy(s, end), e0, 2 * turning * e0) << joint_name(kind);
  }
}

TEST(JointedMotion, IsRefusedBesideContact) {
  Scenario s = pendulum(1);
  s.contact = ContactMaterial{};
  EXPECT_THROW(Simulator(s, Scheme{}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
