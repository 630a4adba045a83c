#include "plumbline/core/force_element.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinetic_scenes.hpp"
#include "plumbline/core/feature.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/force_following.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

// A few roundings of numbers of the order of 10.
constexpr double kRounding = 2e-14;

// Two bodies that are turned and move, with a spring between points off their centres.
struct SpringPair {
  std::vector<BodyState> states{2};
  Spring spring;
  SpringPair() {
    states[0].p_WB = Vec3(1, -0.5, 0.25);
    states[0].q_WB = rotation_by(Vec3(0.3, -0.2, 0.9));
    states[0].v_WB = Vec3(0.2, 0.1, -0.4);
    states[0].w_WB = Vec3(-1, 0.5, 2);
    states[1].p_WB = Vec3(-0.5, 1, 1.5);
    states[1].q_WB = rotation_by(Vec3(-0.7, 0.4, 0.1));
    states[1].w_WB = Vec3(0.4, -0.3, 0.2);
    spring = {"spring", 0, 1, Vec3(0.1, 0.2, -0.3), Vec3(-0.2, 0.1, 0.4), 40, 3, 0.5};
  }
  Vec3 end(std::size_t body, const Vec3& on_body) const { return states[body].p_WB + states[body].q_WB * on_body; }
};

TEST(Spring, PullsAlongItsLineByHookesLawAndDampsWhatChangesItsLength) {
  std::vector<BodyState> states(1);
  states[0].p_WB = Vec3(3, 0, 4);
  states[0].v_WB = Vec3(1, 7, 2);  // 0.6 + 1.6 of it along the line
  const Spring spring{"spring", kWorld, 0, Vec3::Zero(), Vec3::Zero(), 10, 2, 1};
  std::vector<Wrench> wrenches(1);
  add_wrenches(spring, states, wrenches);
  const double pull = 10 * (5 - 1) + 2 * 2.2;
  EXPECT_LE((wrenches[0].f_W + pull * Vec3(0.6, 0, 0.8)).norm(), kRounding);
  EXPECT_EQ(wrenches[0].tau_W, Vec3::Zero());
}

TEST(Spring, PushesWhenItIsShort) {
  std::vector<BodyState> states(1);
  states[0].p_WB = Vec3(0.5, 0, 0);
  std::vector<Wrench> wrenches(1);
  add_wrenches({"spring", kWorld, 0, Vec3::Zero(), Vec3::Zero(), 10, 0, 2}, states, wrenches);
  EXPECT_LE((wrenches[0].f_W - Vec3(15, 0, 0)).norm(), kRounding);
}

TEST(Spring, ActsOnBothEndsAlikeSoThatMomentumIsKept) {
  const SpringPair pair;
  std::vector<Wrench> wrenches(2);
  add_wrenches(pair.spring, pair.states, wrenches);
  EXPECT_GT(wrenches[0].f_W.norm(), 1);
  EXPECT_LE((wrenches[0].f_W + wrenches[1].f_W).norm(), 0);
  Vec3 moment = Vec3::Zero();  // about the origin
  for (std::size_t i = 0; i < 2; ++i) moment += pair.states[i].p_WB.cross(wrenches[i].f_W) + wrenches[i].tau_W;
  EXPECT_LE(moment.norm(), 100 * kRounding);
}

// The power of an undamped spring is what its store loses, by a difference of the store along the motion.
TEST(Spring, GivesThePowerThatItsStoreLoses) {
  SpringPair pair;
  pair.spring.damping = 0;
  std::vector<Wrench> wrenches(2);
  add_wrenches(pair.spring, pair.states, wrenches);
  double power = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    power += wrenches[i].f_W.dot(pair.states[i].v_WB) + wrenches[i].tau_W.dot(pair.states[i].w_WB);
  }
  const auto store_after = [&](double h) {
    std::vector<BodyState> moved = pair.states;
    for (BodyState& s : moved) {
      s.p_WB += h * s.v_WB;
      s.q_WB = rotation_by(h * s.w_WB) * s.q_WB;
    }
    return stored_energy(pair.spring, moved);
  };
  // Central difference: off by h^2/6 times a third derivative, some 1e3 J/s^3 here, and by 1e-14 J/h.
  const double h = 1e-5;
  EXPECT_NEAR(power, -(store_after(h) - store_after(-h)) / (2 * h), 1e-6);
}

TEST(Spring, HasNoDirectionWhereItsEndsMeet) {
  std::vector<BodyState> states(1);
  states[0].v_WB = Vec3(1, 2, 3);
  std::vector<Wrench> wrenches(1);
  add_wrenches({"spring", kWorld, 0, Vec3::Zero(), Vec3::Zero(), 10, 5, 0}, states, wrenches);
  EXPECT_EQ(wrenches[0].f_W, Vec3::Zero());
}

TEST(Spring, LetsNaNThrough) {
  std::vector<BodyState> states(1);
  states[0].p_WB.x() = std::numeric_limits<double>::quiet_NaN();
  std::vector<Wrench> wrenches(1);
  add_wrenches({"spring", kWorld, 0, Vec3::Zero(), Vec3::Zero(), 10, 5, 1}, states, wrenches);
  EXPECT_TRUE(wrenches[0].f_W.hasNaN());
}

// A rod of inertia 3 kg m^2 about the hinge at its end, turned by 0.4 rad with 0.5 rad/s.
Scenario turned_rod(const Vec3& axis) {
  Scenario s = free_flight(solid("rod", Box{Vec3(1, 0.1, 0.1)}, 1, Vec3(1, 0, 0), Vec3::Zero()), Vec3::Zero(), 1);
  s.joints = {joint_at(JointKind::kHinge, kWorld, 0, {s.bodies[0].initial}, Vec3::Zero(), axis)};
  BodyState& state = s.bodies[0].initial;
  const Quat turn = rotation_by(0.4 * axis);
  state.q_WB = turn;
  state.p_WB = turn * Vec3(1, 0, 0);
  state.w_WB = 0.5 * axis;
  state.v_WB = state.w_WB.cross(state.p_WB);
  return s;
}

TEST(JointSpring, TurnsTowardsItsRestAndBrakes) {
  for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
    Scenario s = turned_rod(axis);
    s.joint_springs = {{0, 8, 2, -0.1}};
    const std::vector<BodyState> states = {s.bodies[0].initial};
    EXPECT_NEAR(effort_of(s.joint_springs[0], s.joints[0], states), -(8 * 0.5 + 2 * 0.5), kRounding);
    std::vector<Wrench> wrenches(1);
    evaluate_forces(s, 0, states, wrenches);
    EXPECT_LE((wrenches[0].tau_W + 5 * axis).norm(), kRounding);
    EXPECT_LE(wrenches[0].f_W.norm(), kRounding);
    EXPECT_NEAR(stored_energy(s.joint_springs[0], s.joints[0], states), 0.5 * 8 * 0.25, kRounding);
    EXPECT_NEAR(energy(s, states) - energy(turned_rod(axis), states), 1, kRounding);
  }
}

TEST(JointDrive, ReadsTimeCoordinateAndRate) {
  Scenario s = turned_rod(Vec3::UnitY());
  double t = 0, q = 0, rate = 0;
  s.drives.push_back({0,
                      [&](double at, double coordinate, double speed) {
                        t = at;
                        q = coordinate;
                        rate = speed;
                        return 7.0;
                      },
                      "7"});
  std::vector<Wrench> wrenches(1);
  evaluate_forces(s, 3, std::vector<BodyState>{s.bodies[0].initial}, wrenches);
  EXPECT_EQ(t, 3);
  EXPECT_NEAR(q, 0.4, kRounding);
  EXPECT_NEAR(rate, 0.5, kRounding);
  EXPECT_LE((wrenches[0].tau_W - Vec3(0, 7, 0)).norm(), kRounding);
}

TEST(ForceElements, ThatAnEngineHasItselfAreNotApplied) {
  Scenario s = turned_rod(Vec3::UnitY());
  s.joint_springs = {{0, 8, 2, -0.1}};
  s.springs = {{"spring", kWorld, 0, Vec3(0, 0, 1), Vec3::Zero(), 10, 0, 0.1}};
  const FeatureSet both{Feature::kSpring, Feature::kJointSpring}, one{Feature::kSpring};
  EXPECT_TRUE(has_forces(s, {}));
  EXPECT_TRUE(has_forces(s, one));
  EXPECT_FALSE(has_forces(s, both));
  const std::vector<BodyState> states = {s.bodies[0].initial};
  std::vector<Wrench> wrenches(1);
  evaluate_forces(s, 0, states, wrenches, both);
  EXPECT_EQ(wrenches[0].f_W, Vec3::Zero());
  EXPECT_EQ(wrenches[0].tau_W, Vec3::Zero());
  evaluate_forces(s, 0, states, wrenches, one);
  EXPECT_LE(wrenches[0].f_W.norm(), kRounding);
  EXPECT_GT(wrenches[0].tau_W.norm(), 1);
}

TEST(ForceElements, OfAMassOnASpringSwingWithItsFrequency) {
  Scenario s = free_flight(ball("ball", 0.1, 2, Vec3(1.5, 0, 0), Vec3::Zero()), Vec3::Zero(), 1);
  s.springs = {{"spring", kWorld, 0, Vec3(0, 0, 0), Vec3::Zero(), 50, 0, 1}};
  const Scheme scheme{Integrator::kRungeKutta4, ImpactRule::kExactTime, GyroscopicTerm::kExplicit,
                      ForceSampling::kFollowed};
  const double dt = 1e-3;
  const Trajectory t = simulate(s, scheme, dt);
  // Runge-Kutta's error over 1 s of a motion with w = 5/s is below (w dt)^4 w t.
  for (std::size_t k = 0; k < t.samples(); ++k) {
    EXPECT_NEAR(t.at(k, 0).p_WB.x(), 1 + 0.5 * std::cos(5 * t.time(k)), 1e-8);
  }
}

TEST(ForceElements, ThatAreUnsoundAreNamed) {
  const auto complaint = [](const Scenario& s) -> std::string {
    try {
      require_sound(s);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  Scenario s = turned_rod(Vec3::UnitY());
  s.springs = {{"coil", kWorld, 0, Vec3::Zero(), Vec3::Zero(), -1, 0, 1}};
  EXPECT_NE(complaint(s).find("spring 'coil': stiffness"), std::string::npos) << complaint(s);
  s.springs[0].stiffness = 1;
  s.springs[0].b = 5;
  EXPECT_NE(complaint(s).find("must tie two bodies"), std::string::npos) << complaint(s);
  s.springs.clear();
  s.joint_springs = {{3, 1, 0, 0}};
  EXPECT_NE(complaint(s).find("does not exist"), std::string::npos) << complaint(s);
  s.joint_springs.clear();
  s.joints[0] = joint_at(JointKind::kBall, kWorld, 0, {s.bodies[0].initial}, Vec3::Zero());
  s.drives = {{0, [](double, double, double) { return 0.0; }, "0"}};
  EXPECT_NE(complaint(s).find("needs a hinge or a slider"), std::string::npos) << complaint(s);
}

}  // namespace
}  // namespace plumbline
