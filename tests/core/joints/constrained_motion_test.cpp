// Maximal coordinates: against reduced ones, closed forms, published numbers, and the statics of hinges.
#include "plumbline/core/joints/constrained_motion.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "jointed_scenes.hpp"
#include "plumbline/core/exact/lagrange_top.hpp"
#include "plumbline/core/integration/reference_integration.hpp"
#include "plumbline/core/joints/reduced_tree.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace jointed;
using Vector = Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

Vector random_vector(Random& random, Eigen::Index n, double size) {
  Vector v(n);
  for (Eigen::Index k = 0; k < n; ++k) v[k] = random.in(-size, size);
  return v;
}

TEST(ConstrainedMotion, HasTheAccelerationsOfReducedCoordinatesOnRandomTrees) {
  Random random(21);
  double largest = 0;
  for (int n = 0; n < 100; ++n) {
    const ArticulatedBody body = random_tree(random, 1 + random.below(8));
    const ReducedTree tree(body);
    const Eigen::Index d = tree.freedoms();
    const Vector q = random_vector(random, d, 2), qd = random_vector(random, d, 2);
    const auto expected = tree.body_accelerations(q, qd, tree.accelerations(q, qd));
    const auto actual = constrained_accelerations(body, tree.states(q, qd));
    EXPECT_EQ(actual.rank, static_cast<Eigen::Index>(6 * body.bodies.size()) - d);
    double scale = 0;
    for (const Acceleration& a : expected) scale = std::max({scale, a.linear.norm(), a.angular.norm()});
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double error = std::max((actual.accelerations[i].linear - expected[i].linear).norm(),
                                    (actual.accelerations[i].angular - expected[i].angular).norm());
      EXPECT_LT(error, 1e-12 * scale);  // some 1e4 roundings: conditions of M up to 1e3 times sums of some ten terms
      largest = max_or_nan(largest, error / scale);
    }
  }
  RecordProperty("relative_1e-18", std::to_string(largest * 1e18));
}

// Both descriptions of the same motion, each with its own integrator and its own equations.
TEST(ConstrainedMotion, FollowsTheDoublePendulumToItsPublishedState) {
  const ArticulatedBody body = equimomental_double_pendulum();
  Vector q(2), rest = Vector::Zero(2);
  q << kPi / 2, 0;
  const double times[] = {1.0};
  const ReferenceRun run =
      integrate_reference(constrained_field(body), 0, ReducedTree(body).states(q, rest), times, 1e-14);
  const auto angle = [&](std::size_t i) {
    const Vec3 down = run.states[i].q_WB * -Vec3::UnitZ();
    return std::atan2(down.x(), -down.z());
  };
  EXPECT_NEAR(angle(0), -0.6250876998063906, 1e-11);
  EXPECT_NEAR(angle(1), -1.034585085680012, 1e-11);
  EXPECT_NEAR(-run.states[0].w_WB.y(), -3.922279572887977, 1e-10);
  EXPECT_NEAR(-run.states[1].w_WB.y(), -1.303099248696331, 1e-10);
  EXPECT_LT(joint_error(body, run.states), 1e-11);
  EXPECT_NEAR(mechanical_energy(body, run.states), mechanical_energy(body, ReducedTree(body).states(q, rest)), 1e-10);
  RecordProperty("angle_error_1e-18", std::to_string(std::abs(angle(0) + 0.6250876998063906) * 1e18));
}

TEST(ConstrainedMotion, SpinsTheHeavyTopOnABallJointAsTheExactOne) {
  // The heavy top of Terze, Mueller and Zlatar, Multibody System Dynamics 38 (2016) 201.
  const TopBody top{15, Vec3::UnitY(), 0.46875, 0.234375, 9.81};
  const Vec3 w(0, 150, -4.61538);
  const BodyState start{Vec3::UnitY(), Quat::Identity(), w.cross(Vec3::UnitY()), w};
  ArticulatedBody body;
  body.gravity_W = Vec3(0, 0, -9.81);
  body.bodies = {{15, Vec3(0.234375, 0.46875, 0.234375).asDiagonal()}};
  body.joints = {joint_at(JointKind::kBall, kWorld, 0, {start}, Vec3::Zero())};
  EXPECT_NEAR(mechanical_energy(body, {start}), 5435.69679, 5e-6);  // as published
  const double times[] = {0.2, 1.0};
  const ReferenceRun run = integrate_reference(constrained_field(body), 0, {&start, 1}, times, 1e-15);
  EXPECT_LT((run.states[0].p_WB - Vec3(0.60555056, 0.59895768, -0.52398303)).norm(), 1e-8);
  const LagrangeTop exact(top, start);
  double largest = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT((run.states[k].p_WB - exact.at(times[k]).p_WB).norm(), 1e-10);
    EXPECT_LT(geodesic_angle(run.states[k].q_WB, exact.at(times[k]).q_WB), 1e-10);
    largest = max_or_nan(largest, geodesic_angle(run.states[k].q_WB, exact.at(times[k]).q_WB));
  }
  RecordProperty("attitude_1e-18", std::to_string(largest * 1e18));
}

// Uniform rod or point-like bob, whatever: at rest the hinge carries m g. Let go level, m d^2 + I = I_p about the
// pivot, energy gives w^2 = 2 m g d/I_p at the bottom, and the hinge carries m g + m d w^2: 3 m g for a point mass.
TEST(JointReaction, IsTheWeightAtRestAndThriceForAPointMassAtTheBottom) {
  for (const double inertia : {1e-9, 1.0 / 12}) {
    const ArticulatedBody body = planar_chain({2}, {1}, {1}, {inertia});
    const ReducedTree tree(body);
    const Vector hanging = Vector::Zero(1);
    const double weight = 2 * 9.81, moment = 2 + inertia;
    const auto rest = constrained_accelerations(body, tree.states(hanging, hanging));
    EXPECT_LT((rest.reactions[0].f_W - Vec3(0, 0, weight)).norm(), 20 * kEps * weight);
    EXPECT_LT(rest.reactions[0].tau_W.norm(), 20 * kEps * weight);
    Vector w(1);
    w << std::sqrt(2 * weight / moment);
    const auto bottom = constrained_accelerations(body, tree.states(hanging, w));
    EXPECT_NEAR(bottom.reactions[0].f_W.z(), weight * (1 + 4 / moment), 100 * kEps * weight);
    EXPECT_NEAR(bottom.reactions[0].f_W.z(), 3 * weight, 2 * inertia * weight + 100 * kEps * weight);
  }
}

// A door of 20 kg, 0.9 m wide, on two hinges 1.6 m apart: ten rows, five of which say it all.
TEST(JointReaction, OfADoorOnTwoHingesSumsToWhatOneHingeWouldCarry) {
  ArticulatedBody door;
  door.gravity_W = Vec3(0, 0, -9.81);
  door.bodies = {{20, Vec3(6, 7.35, 1.35).asDiagonal()}};
  std::vector<BodyState> states(1);
  const double w = 1.5;
  states[0] = {Vec3(0.45, 0, 0), Quat::Identity(), Vec3(0, 0.45 * w, 0), Vec3(0, 0, w)};
  for (const double z : {-0.8, 0.8}) {
    door.joints.push_back(joint_at(JointKind::kHinge, kWorld, 0, states, Vec3(0, 0, z)));
  }
  const auto solved = constrained_accelerations(door, states);
  EXPECT_EQ(solved.rank, 5);
  const double weight = 20 * 9.81, scale = 100 * kEps * weight;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // about the centre of mass
  for (std::size_t k = 0; k < 2; ++k) {
    const JointReaction& r = solved.reactions[k];
    force += r.f_W;
    torque += r.tau_W + (door.joints[k].on_a.anchor - states[0].p_WB).cross(r.f_W);
  }
  // Upwards the weight, inwards m w^2 r, and no torque: the door keeps turning evenly.
  EXPECT_LT((force - Vec3(-20 * w * w * 0.45, 0, weight)).norm(), scale);
  EXPECT_LT(torque.norm(), scale);
  EXPECT_LT((solved.accelerations[0].linear - Vec3(-0.45 * w * w, 0, 0)).norm(), scale / 20);
  EXPECT_LT(solved.accelerations[0].angular.norm(), scale);
}

// Two rods in a line, hinged end to end and free; the outer end of one is struck at right angles by P. With the hinge's
// own impulse R, v1 = (P - R)/m, w1 = -6 (P + R)/(m l), v2 = R/m, w2 = -6 R/(m l); that the hinge stays together,
// v1 + w1 l/2 = v2 - w2 l/2, gives R = -P/4: the far rod starts backwards.
TEST(JointImpulse, TravelsThroughTheHingeOfTwoRods) {
  ArticulatedBody rods;
  const double m = 2, l = 1.2, I = m * l * l / 12, P = 3;
  rods.bodies = {{m, I * Mat3::Identity()}, {m, I * Mat3::Identity()}};
  std::vector<BodyState> states(2);
  states[0].p_WB.x() = -l / 2;
  states[1].p_WB.x() = l / 2;
  rods.joints = {joint_at(JointKind::kHinge, 0, 1, states, Vec3::Zero())};
  apply_impulse(rods, states, 0, Vec3(-l, 0, 0), Vec3(0, P, 0));
  EXPECT_NEAR(states[0].v_WB.y(), 1.25 * P / m, 20 * kEps * P);
  EXPECT_NEAR(states[1].v_WB.y(), -0.25 * P / m, 20 * kEps * P);
  EXPECT_NEAR(states[0].w_WB.z(), -4.5 * P / (m * l), 50 * kEps * P);
  EXPECT_NEAR(states[1].w_WB.z(), 1.5 * P / (m * l), 50 * kEps * P);
}

// On a tree, the same jump by reduced coordinates: M dq' = (partial point/partial q)^T P.
TEST(JointImpulse, ChangesAllBodiesAsReducedCoordinatesDo) {
  Random random(23);
  for (int n = 0; n < 50; ++n) {
    const ArticulatedBody body = random_tree(random, 1 + random.below(6));
    const ReducedTree tree(body);
    const Eigen::Index d = tree.freedoms();
    const Vector q = random_vector(random, d, 2), qd = random_vector(random, d, 1);
    std::vector<BodyState> states = tree.states(q, qd);
    const std::size_t hit = random.below(states.size());
    const Vec3 point = states[hit].p_WB + random.vector(1), impulse = random.vector(2);
    Vector generalized(d);
    for (Eigen::Index j = 0; j < d; ++j) {
      const BodyState s = tree.states(q, Vector::Unit(d, j))[hit];
      generalized[j] = (s.v_WB + s.w_WB.cross(point - s.p_WB)).dot(impulse);
    }
    ArticulatedBody still = body;  // accelerations without gravity from rest under tau are M^-1 tau
    still.gravity_W.setZero();
    const Vector jump = ReducedTree(still).accelerations(q, Vector::Zero(d), generalized);
    const std::vector<BodyState> expected = tree.states(q, qd + jump);
    apply_impulse(body, states, hit, point, impulse);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double scale = 1e-12 * (1 + expected[i].v_WB.norm() + expected[i].w_WB.norm() + jump.norm() * 10);
      EXPECT_LT((states[i].v_WB - expected[i].v_WB).norm(), scale);
      EXPECT_LT((states[i].w_WB - expected[i].w_WB).norm(), scale);
    }
  }
}

}  // namespace
}  // namespace plumbline
