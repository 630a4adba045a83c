#include "plumbline/core/invariant.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

struct TwoBodies {
  TwoBodies() {
    scenario.gravity = Vec3(0, 0, -10);
    scenario.bodies.resize(3);
    scenario.bodies[0].mass = 2;
    scenario.bodies[0].inertia = Vec3(1, 2, 3);
    scenario.bodies[1].mass = 3;
    scenario.bodies[1].inertia = Vec3(1, 1, 1);
    scenario.bodies[2].fixed = true;
    scenario.bodies[2].mass = 1e9;  // must not count
    states[0].p_WB = Vec3(0, 0, 5);
    states[0].v_WB = Vec3(1, 2, 0);
    states[0].w_WB = Vec3(0, 1, 1);
    states[1].p_WB = Vec3(1, 0, 0);
    states[1].v_WB = Vec3(0, 0, -1);
    states[2].v_WB = Vec3(1, 1, 1);
  }
  Scenario scenario;
  std::array<BodyState, 3> states;
};

TEST(Invariants, AreTheSumsOverMovingBodies) {
  const TwoBodies two;
  // 1/2*2*5 + 1/2*(2*1 + 3*1) + 2*10*5 and 1/2*3*1.
  EXPECT_NEAR(energy(two.scenario, two.states), 5 + 2.5 + 100 + 1.5, 256 * kEps);
  EXPECT_EQ(momentum(two.scenario, two.states), Vec3(2, 4, -3));
  // (0,0,5) x (2,4,0) = (-20,10,0); I w = (0,2,3); (1,0,0) x (0,0,-3) = (0,3,0).
  EXPECT_LT((angular_momentum(two.scenario, two.states) - Vec3(-20, 15, 3)).norm(), 64 * kEps);
}

TEST(Invariants, InThePlaneLeaveOutWhatIsAcross) {
  const TwoBodies two;
  EXPECT_NEAR(energy(two.scenario, two.states, true), 1 + 1 + 100 + 1.5, 256 * kEps);
  EXPECT_EQ(momentum(two.scenario, two.states, true), Vec3(2, 0, -3));
  EXPECT_LT((angular_momentum(two.scenario, two.states, true) - Vec3(0, 15, 0)).norm(), 64 * kEps);
}

TEST(Invariants, UseTheInertiaOfTheTurnedBody) {
  TwoBodies two;
  two.states[0].q_WB = Quat(0.5, 0.5, 0.5, 0.5);  // x -> y -> z -> x
  two.states[0].w_WB = Vec3(0, 1, 0);             // now the body's own x axis, of moment 1
  two.states[0].p_WB = two.states[1].p_WB = Vec3::Zero();
  EXPECT_LT((angular_momentum(two.scenario, two.states) - Vec3(0, 1, 0)).norm(), 16 * kEps);
}

}  // namespace
}  // namespace plumbline
