// Schemes whose forces are followed within the step have the order that their integrator promises.
#include "plumbline/core/kinetics/force_following.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/integration/stepper_table.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;

constexpr Integrator kAll[] = {kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet,
                               kPositionVerlet,    kRungeKutta4,   kDormandPrince8};

Scheme following(Integrator integrator) {
  return {integrator, ImpactRule::kExactTime, GyroscopicTerm::kExplicit, ForceSampling::kFollowed};
}

// x'' = -x with x(0) = 1 m, at rest: x = cos t.
Scenario oscillator() {
  Scenario s = free_flight(ball("bob", 0.1, 1, Vec3(1, 0, 0), Vec3::Zero()), Vec3::Zero(), 2);
  s.forces.push_back({0,
                      [](double, const BodyState& b) {
                        return Wrench{Vec3(-b.p_WB.x(), 0, 0), Vec3::Zero()};
                      },
                      false, false, ""});
  return s;
}

double error_at_the_end(const Scheme& scheme, double dt) {
  const Trajectory path = simulate(oscillator(), scheme, dt);
  return std::abs(path.at(path.samples() - 1, 0).p_WB.x() - std::cos(2.0));
}

TEST(ForceFollowing, NamesIntegratorsAsTheirTableDoes) {
  for (const Integrator integrator : kAll) EXPECT_EQ(make_stepper(integrator)->name(), name(integrator));
  EXPECT_EQ(std::size(kAll), stepper_kinds().size());
}

TEST(ForceFollowing, HasTheOrderOfTheIntegrator) {
  for (const Integrator integrator :
       {kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet, kPositionVerlet, kRungeKutta4}) {
    const double order = std::log2(error_at_the_end(following(integrator), 1.0 / 64) /
                                   error_at_the_end(following(integrator), 1.0 / 128));
    EXPECT_NEAR(order, make_stepper(integrator)->order(), 0.05) << name(integrator);
  }
  EXPECT_LT(error_at_the_end(following(kDormandPrince8), 1.0 / 8), 1e-11);
}

// What it costs to hold the forces: velocity Verlet falls back to first order.
TEST(ForceFollowing, IsWhatHeldForcesLoseTheSecondOrderBy) {
  const Scheme held{kVelocityVerlet};
  EXPECT_NEAR(std::log2(error_at_the_end(held, 1.0 / 64) / error_at_the_end(held, 1.0 / 128)), 1, 0.05);
}

// Euler's schemes look at their forces at the start of the step only: followed and held are the same thing.
TEST(ForceFollowing, IsTheSameAsHoldingForEuler) {
  for (const Integrator integrator : {kSemiImplicitEuler, kExplicitEuler}) {
    const double difference =
        error_at_the_end(following(integrator), 1.0 / 64) - error_at_the_end({integrator}, 1.0 / 64);
    EXPECT_LT(std::abs(difference), 128 * 4 * 2.2e-16);
  }
}

TEST(ForceFollowing, LeavesFixedBodiesAndTakesSubsteps) {
  Scenario s = oscillator();
  s.bodies.push_back(ball("wall", 1, 1, Vec3(5, 0, 0), Vec3(1, 1, 1)));
  s.bodies[1].fixed = true;
  s.gravity = Vec3(0, 0, -kG);
  s.bodies[1].initial.v_WB.setZero();
  Scheme scheme = following(kRungeKutta4);
  const Trajectory fine = simulate(s, scheme, 1.0 / 64);
  scheme.substeps = 2;
  const Trajectory coarse = simulate(s, scheme, 1.0 / 32);
  EXPECT_EQ(coarse.at(coarse.samples() - 1, 1).p_WB, Vec3(5, 0, 0));
  EXPECT_EQ(coarse.at(64, 0).p_WB, fine.at(128, 0).p_WB);
  s.bodies[0].mass = 0;
  EXPECT_THROW(simulate(s, scheme, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
