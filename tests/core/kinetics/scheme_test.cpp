// A scheme names itself, says where it is possible, and its choices do what they say.
#include "plumbline/core/kinetics/scheme.hpp"

#include <gtest/gtest.h>

#include <set>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum ImpactRule;
using enum GyroscopicTerm;

Scenario free_ball() { return free_flight(ball("b", 1, 1, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), 1); }
Scenario ball_on_ground() { return on_ground(ball("b", 1, 1, Vec3::Zero(), Vec3::Zero()), 0, 0, 1); }
Scenario tumbling_box() {
  Body box = solid("box", Box{Vec3(0.1, 0.4, 0.9)}, 10, Vec3::Zero(), Vec3::Zero());
  box.initial.w_WB = Vec3(0.1, 5, 0.1);
  return free_flight(box, Vec3::Zero(), 1);
}

TEST(Scheme, NamesAllItsChoices) {
  EXPECT_EQ(name({kVelocityVerlet, kExactTime}),
            "velocity Verlet, explicit gyroscopic term, impacts at their exact time");
  EXPECT_EQ(name({kSemiImplicitEuler, kStepStart, kImplicit, ForceSampling::kHeld, 2}),
            "semi-implicit Euler, implicit gyroscopic term, impacts at the start of the step, 2 substeps");
  EXPECT_EQ(name({kRungeKutta4, kExactTime, kExplicit, ForceSampling::kFollowed}, free_ball()),
            "Runge-Kutta 4, forces followed within the step");
}

TEST(Scheme, NamesOnlyWhatMattersInAScenario) {
  const Scheme scheme{kSemiImplicitEuler, kExactTime};
  EXPECT_EQ(name(scheme, free_ball()), "semi-implicit Euler");
  EXPECT_EQ(name(scheme, ball_on_ground()), "semi-implicit Euler, impacts at their exact time");
  EXPECT_EQ(name(scheme, tumbling_box()), "semi-implicit Euler, explicit gyroscopic term");
  Scenario not_turning = tumbling_box();
  not_turning.bodies[0].initial.w_WB.setZero();
  EXPECT_EQ(name(scheme, not_turning), "semi-implicit Euler");
}

TEST(Scheme, CandidatesAreAllDifferentAlsoByName) {
  const std::pair<Scenario, std::size_t> expected[] = {{free_ball(), 3}, {ball_on_ground(), 9}, {tumbling_box(), 9}};
  for (const auto& [scenario, count] : expected) {
    std::set<std::string> names;
    for (const Scheme& scheme : candidate_schemes(scenario)) {
      EXPECT_NO_THROW(require_possible(scheme, scenario)) << name(scheme);
      names.insert(name(scheme, scenario));
    }
    EXPECT_EQ(names.size(), count);
    EXPECT_EQ(candidate_schemes(scenario).size(), count);
  }
}

TEST(Scheme, RefusesChoicesThatCannotGoTogether) {
  const Scenario free = free_ball(), touching = ball_on_ground();
  EXPECT_THROW(require_possible({kRungeKutta4}, free), std::invalid_argument);
  EXPECT_THROW(require_possible({kPositionVerlet}, free), std::invalid_argument);
  EXPECT_THROW(require_possible({kSemiImplicitEuler, kExactTime, kExact}, touching), std::invalid_argument);
  const Scheme followed{kVelocityVerlet, kExactTime, kExplicit, ForceSampling::kFollowed};
  EXPECT_NO_THROW(require_possible(followed, free));
  EXPECT_THROW(require_possible(followed, touching), std::invalid_argument);
  EXPECT_THROW(Simulator(free, followed), std::invalid_argument);  // its forces come from outside
  Scheme none;
  none.substeps = 0;
  EXPECT_THROW(simulate(free, none, 0.1), std::invalid_argument);
}

// n substeps of dt/n under held forces are n steps of dt/n under forces that do not change.
TEST(Scheme, SubstepsAreShorterSteps) {
  Scenario s = on_ground(solid("box", Box{Vec3(1, 0.6, 0.4)}, 2, Vec3(0, 0, 2), Vec3(1, 0.5, 0)), 0.4, 0.3, 2);
  s.bodies[1].initial.w_WB = Vec3(1, 2, 0.5);
  for (Scheme scheme : candidate_schemes(s)) {
    const Trajectory fine = simulate(s, scheme, 1.0 / 256);
    scheme.substeps = 4;
    const Trajectory coarse = simulate(s, scheme, 1.0 / 64);
    for (std::size_t k = 0; k < coarse.samples(); ++k) {
      EXPECT_EQ(coarse.at(k, 1).p_WB, fine.at(4 * k, 1).p_WB) << name(scheme);
    }
  }
}

}  // namespace
}  // namespace plumbline
