// Does an adapter hand the stated problem to its engine, and the engine's answer back, without bending either?
// Free bodies: mass properties, frames, signs, forces, settings. Contacts are in contact_conformance_test.cpp.
#include <cmath>
#include <cstring>
#include <set>

#include "conformance_row.hpp"

namespace plumbline {
namespace {

using Conformance = ConformanceCase;
INSTANTIATE_TEST_SUITE_P(Rows, Conformance, testing::ValuesIn(conformance_rows({Profile::kDefault, Profile::kMatched})),
                         [](const auto& row) { return row_name(row.param); });

// Rounding of a one-step change of velocity: the inputs (force, step, inverse mass), two products and a sum are rounded
// once each; a rotation to the body's frame and back adds three products and two sums, twice. 16 roundings bound it.
constexpr double kOneStepRoundings = 16;

std::vector<Vec3> axes_of_motion(bool planar) {
  if (planar) return {Vec3::UnitX(), Vec3::UnitZ()};
  return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
}
std::vector<Vec3> axes_of_rotation(bool planar) {
  if (planar) return {Vec3::UnitY()};
  return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
}

TEST_P(Conformance, RowsDescribeThemselves) {
  EXPECT_FALSE(info().name.empty());
  EXPECT_FALSE(info().library.empty());
  EXPECT_FALSE(info().version.empty());
  EXPECT_FALSE(info().scheme.empty());
  EXPECT_EQ(info().dimension, planar() ? 2 : 3);
  std::set<std::string> names;
  for (const Setting& s : info().settings) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name << " is listed twice";
    EXPECT_FALSE(s.meaning.empty()) << s.name;
    EXPECT_EQ(s.default_value.index(), s.matched_value.index()) << s.name << " changes its type";
  }
  std::set<std::string> rows;
  for (const auto& e : linked_engines()) EXPECT_TRUE(rows.insert(e->info().name).second) << e->info().name;
}

// A knob that is printed in a report but not read would be a lie.
TEST_P(Conformance, EveryListedSettingIsRead) {
  Scenario scenario;
  scenario.contact = ContactMaterial{0.5, 0.5};
  scenario.bodies = {half_space(Vec3::UnitZ()), ball("ball", 0.1, 1, Vec3(0, 0, 1))};
  EXPECT_NO_THROW(build(scenario));
  for (const Setting& s : info().settings) {
    Settings without = settings();
    without.erase(s.name);
    EXPECT_THROW(engine().build(scenario, without), std::invalid_argument) << s.name << " is not read";
    Settings mistyped = settings();
    const bool is_text = std::holds_alternative<std::string>(s.default_value);
    mistyped[s.name] = is_text ? SettingValue(1.0) : SettingValue(std::string("no such value"));
    EXPECT_THROW(engine().build(scenario, mistyped), std::invalid_argument) << s.name << " takes anything";
  }
}

TEST_P(Conformance, MovingBodyWithoutMassIsRefusedByName) {
  Scenario scenario;
  scenario.bodies = {ball("feather", 0.1, 1, Vec3::Zero())};
  for (double bad : {0.0, -1.0, std::nan("")}) {
    scenario.bodies[0].mass = bad;
    try {
      build(scenario);
      ADD_FAILURE() << "mass " << bad << " was accepted";
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find("feather"), std::string::npos) << error.what();
    }
  }
}

TEST_P(Conformance, UnitForceShowsTheStatedMass) {
  if (!has(Feature::kForce)) GTEST_SKIP() << "no forces";
  for (const Vec3& axis : axes_of_motion(planar())) {
    for (double mass : {0.3, 2500.0}) {
      Scenario scenario;
      scenario.bodies = {ball("ball", 0.7, mass, Vec3::Zero())};
      const auto world = build(scenario);
      const Wrench wrench{axis, Vec3::Zero()};
      world->apply({&wrench, 1});
      const BodyState s = run(*world, scenario, kStep, 1)[0];
      const double dv = kStep / mass;
      EXPECT_LE((s.v_WB - dv * axis).norm(), kOneStepRoundings * roundoff() * dv) << axis.transpose();
      EXPECT_EQ(s.w_WB.norm(), 0) << "a force on the centre of mass turned the body";
    }
  }
}

TEST_P(Conformance, UnitTorqueShowsTheStatedInertia) {
  if (!has(Feature::kTorque)) GTEST_SKIP() << "no torques";
  Scenario scenario;
  scenario.bodies = {box("box", Vec3(1, 1, 1), 2, Vec3::Zero())};
  // Unlike that of any homogeneous box of this shape, so that one derived from the shape is noticed.
  scenario.bodies[0].inertia = Vec3(0.3, 0.5, 0.7);
  for (const Vec3& axis : axes_of_rotation(planar())) {
    const auto world = build(scenario);
    const Wrench wrench{Vec3::Zero(), axis};
    world->apply({&wrench, 1});
    const BodyState s = run(*world, scenario, kStep, 1)[0];
    const double dw = kStep / axis.dot(scenario.bodies[0].inertia);
    EXPECT_LE((s.w_WB - dw * axis).norm(), kOneStepRoundings * roundoff() * dw) << axis.transpose();
    EXPECT_EQ(s.v_WB.norm(), 0) << "a torque moved the centre of mass";
  }
}

TEST_P(Conformance, InertiaTurnsWithTheBody) {
  if (!has(Feature::kTorque) || planar()) GTEST_SKIP() << "no torques about axes in the plane";
  Scenario scenario;
  scenario.bodies = {box("box", Vec3(1, 1, 1), 2, Vec3::Zero())};
  scenario.bodies[0].inertia = Vec3(0.3, 0.5, 0.7);
  scenario.bodies[0].initial.q_WB = quarter_turn_about_y();
  const auto world = build(scenario);
  const Wrench wrench{Vec3::Zero(), Vec3::UnitX()};
  world->apply({&wrench, 1});
  // After the quarter turn the body's z axis points along x of the world.
  const double dw = kStep / 0.7;
  const BodyState s = run(*world, scenario, kStep, 1)[0];
  EXPECT_LE((s.w_WB - dw * Vec3::UnitX()).norm(), kOneStepRoundings * roundoff() * dw);
}

TEST_P(Conformance, ForceAndTorqueLastOneStep) {
  if (!has(Feature::kForce) || !has(Feature::kTorque)) GTEST_SKIP() << "no forces or no torques";
  Scenario scenario;
  scenario.bodies = {ball("ball", 0.5, 2, Vec3::Zero())};
  const auto world = build(scenario);
  const Wrench wrench{Vec3(3, 0, -2), Vec3(0, 0.25, 0)};
  world->apply({&wrench, 1});
  const BodyState pushed = run(*world, scenario, kStep, 1)[0];
  EXPECT_GT(pushed.v_WB.norm(), 0);
  EXPECT_GT(pushed.w_WB.norm(), 0);
  const BodyState later = run(*world, scenario, kStep, 10)[0];
  // Ten free steps may round; a force that stays would add as much again with each of them.
  EXPECT_LE((later.v_WB - pushed.v_WB).norm(), 10 * kOneStepRoundings * roundoff() * pushed.v_WB.norm());
  EXPECT_LE((later.w_WB - pushed.w_WB).norm(), 10 * kOneStepRoundings * roundoff() * pushed.w_WB.norm());
}

TEST_P(Conformance, ForcesGoToTheBodyTheyAreMeantFor) {
  if (!has(Feature::kForce)) GTEST_SKIP() << "no forces";
  Scenario scenario;
  scenario.bodies = {ball("third", 0.1, 1, Vec3(3, 0, 0)), half_space(Vec3::UnitZ(), Vec3(0, 0, -9)),
                     ball("first", 0.1, 1, Vec3(1, 0, 0)), ball("second", 0.1, 1, Vec3(2, 0, 0))};
  const auto world = build(scenario);
  std::vector<Wrench> wrenches(4);
  wrenches[2].f_W = Vec3(0, 0, 5);
  world->apply(wrenches);
  const auto s = run(*world, scenario, kStep, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(s[i].p_WB.x(), scenario.bodies[i].initial.p_WB.x()) << scenario.bodies[i].name;
    EXPECT_EQ(s[i].v_WB.z() > 0, i == 2) << scenario.bodies[i].name;
  }
}

TEST_P(Conformance, GravityPullsWhereItIsStated) {
  Scenario scenario;
  scenario.gravity = Vec3(1.5, 0, -9.81);
  scenario.bodies = {ball("ball", 0.5, 80, Vec3(0, 0, 2))};
  const auto world = build(scenario);
  const BodyState s = run(*world, scenario, kStep, 1)[0];
  const Vec3 dv = scenario.gravity * kStep;
  // A row that staggers its velocities is off by its declared share of a step.
  const double limit = (kOneStepRoundings * roundoff() + std::abs(info().velocity_offset)) * dv.norm();
  EXPECT_LE((s.v_WB - dv).norm(), limit);
  const BodyState later = run(*world, scenario, kStep, 9)[0];
  EXPECT_LT(later.p_WB.z(), 2);
  EXPECT_GT(later.p_WB.x(), 0);
}

TEST_P(Conformance, InitialStateReadsBack) {
  Scenario scenario;
  scenario.bodies = {box("box", Vec3(1, 2, 3), 5, Vec3(1, 0, -3), Vec3(4, 0, 6)),
                     half_space(Vec3::UnitZ(), Vec3(7, 0, -8))};
  BodyState& stated = scenario.bodies[0].initial;
  stated.q_WB = rotation_by(Vec3(0, 0.7, 0));
  stated.w_WB = Vec3(0, 0.9, 0);
  if (!planar()) {
    stated.p_WB.y() = -2;
    stated.v_WB.y() = 5;
    stated.q_WB = rotation_by(Vec3(0.3, -1.1, 0.5));
    stated.w_WB = Vec3(-0.8, 0.9, 1.3);
  }
  const auto states = states_of(*build(scenario), scenario);
  // Each number is rounded once to the engine's precision.
  EXPECT_LE((states[0].p_WB - stated.p_WB).norm(), roundoff() * stated.p_WB.norm());
  EXPECT_LE((states[0].v_WB - stated.v_WB).norm(), roundoff() * stated.v_WB.norm());
  EXPECT_LE((states[0].w_WB - stated.w_WB).norm(), roundoff() * stated.w_WB.norm());
  // An attitude may be kept as a matrix: each entry has three products and two sums, its inverse a root and a
  // quotient, and the angle is twice the quaternion's error.
  EXPECT_LE(geodesic_angle(states[0].q_WB, stated.q_WB), 16 * roundoff());
  EXPECT_EQ(states[1].p_WB, scenario.bodies[1].initial.p_WB);
  EXPECT_EQ(states[1].v_WB.norm(), 0);
}

TEST_P(Conformance, SpinAboutYTurnsXTowardsMinusZ) {
  Scenario scenario;
  scenario.bodies = {box("cube", Vec3(1, 1, 1), 1, Vec3::Zero())};
  const double w = 1;
  scenario.bodies[0].initial.w_WB = Vec3(0, w, 0);
  const int steps = 32;
  const double angle = w * kStep * steps;
  const BodyState s = run(*build(scenario), scenario, kStep, steps)[0];
  // A quaternion advanced by Euler's rule and normalised turns by 2 atan(w dt/2) = w dt (1 - (w dt)^2/12 + ...) in a
  // step, the worst of the usual rules; each step rounds a product of quaternions (8 operations deep).
  const double limit = angle * std::pow(w * kStep, 2) / 12 + steps * 16 * roundoff();
  EXPECT_LE((s.q_WB * Vec3::UnitX() - Vec3(std::cos(angle), 0, -std::sin(angle))).norm(), limit);
  EXPECT_LE((s.w_WB - Vec3(0, w, 0)).norm(), steps * kOneStepRoundings * roundoff());
}

TEST_P(Conformance, TorqueAboutYTurnsXTowardsMinusZ) {
  if (!has(Feature::kTorque)) GTEST_SKIP() << "no torques";
  Scenario scenario;
  scenario.bodies = {box("cube", Vec3(1, 1, 1), 6, Vec3::Zero())};  // I = 1 kg m^2
  const auto world = build(scenario);
  const int steps = 32;
  for (int k = 0; k < steps; ++k) {
    const Wrench wrench{Vec3::Zero(), Vec3(0, 2, 0)};
    world->apply({&wrench, 1});
    world->step(kStep);
  }
  const BodyState s = states_of(*world, scenario)[0];
  const double w = 2 * kStep * steps;
  EXPECT_NEAR(s.w_WB.y(), w, (steps * kOneStepRoundings * roundoff() + std::abs(info().velocity_offset) / steps) * w);
  // phi = tau t^2/(2 I) up to half a step's worth of w, the difference between the first-order rules.
  const double phi = w * w / 4;
  const Vec3 x_W = s.q_WB * Vec3::UnitX();
  EXPECT_NEAR(std::atan2(-x_W.z(), x_W.x()), phi, w * kStep);
}

// A planar row runs the projection onto its plane; the others run the whole motion.
TEST_P(Conformance, MotionAcrossThePlaneIsWholeOrProjected) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.bodies = {ball("ball", 0.1, 1, Vec3(1, 2, 3), Vec3(4, 5, 6))};
  ASSERT_EQ(planar_view(scenario).planarity, Planarity::kProjection);
  const int steps = 16;
  const BodyState s = run(*build(scenario), scenario, kStep, steps)[0];
  const double y = planar() ? 0 : 2 + 5 * kStep * steps;
  // Uniform motion: each step rounds one product and one sum of numbers not above y.
  EXPECT_NEAR(s.p_WB.y(), y, 2 * steps * roundoff() * y);
  EXPECT_EQ(s.v_WB.y(), planar() ? 0 : 5);
  EXPECT_NEAR(s.p_WB.x(), 1 + 4 * kStep * steps, 2 * steps * roundoff() * 2);
}

}  // namespace
}  // namespace plumbline
