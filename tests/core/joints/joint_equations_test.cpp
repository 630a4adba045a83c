// The rows of every joint against differences of what they are rates of.
#include "plumbline/core/joints/joint_equations.hpp"

#include <gtest/gtest.h>

#include "jointed_scenes.hpp"
#include "plumbline/core/integration/attitude.hpp"

namespace plumbline {
namespace {

using namespace jointed;

constexpr JointKind kKinds[] = {JointKind::kBall, JointKind::kHinge, JointKind::kSlider, JointKind::kFixed,
                                JointKind::kDistance};

// A motion without acceleration: straight, and turning about a fixed axis with constant w.
std::vector<BodyState> coasted(std::vector<BodyState> states, double t) {
  for (BodyState& s : states) {
    s.p_WB += t * s.v_WB;
    s.q_WB = turned(s.q_WB, t * s.w_WB);
  }
  return states;
}

std::vector<BodyState> random_states(Random& random) {
  std::vector<BodyState> states(2);
  for (BodyState& s : states) s = {random.vector(1), random.attitude(), random.vector(1), random.vector(1)};
  return states;
}

Joint random_joint(Random& random, JointKind kind) {
  return {kind, random.below(3) == 0 ? kWorld : 0, 1, random_frame(random), random_frame(random), std::nullopt, 1, {}};
}

// Central differences of fourth order: their error is h^4/30 times a fifth derivative, below 100 for these sizes
// (lengths up to 4 m, rates up to 3.5 rad/s: bodies move as products of few sines), plus rounding 1.5 * 4 eps/h.
constexpr double kStep = 1e-3;
constexpr double kDifferenceTolerance = 4000 * kStep * kStep * kStep * kStep / 30 + 60 * kEps / kStep;

// Along a rod every derivative also brings a factor (speed across it)/(its length); speeds reach 7 m/s.
double difference_tolerance(const Joint& joint, const std::vector<BodyState>& states) {
  if (joint.kind != JointKind::kDistance) return kDifferenceTolerance;
  return kDifferenceTolerance * std::pow(1 + 7 / PlacedJoint(joint, states).gap.norm(), 4);
}

template <class F>
double difference(F f) {
  return (8 * (f(kStep) - f(-kStep)) - (f(2 * kStep) - f(-2 * kStep))) / (12 * kStep);
}

TEST(JointRows, AreTheRatesOfTheErrors) {
  Random random(1);
  for (int n = 0; n < 200; ++n) {
    for (const JointKind kind : kKinds) {
      const Joint joint = random_joint(random, kind);
      const std::vector<BodyState> states = random_states(random);
      const std::vector<JointRow> rows = joint_rows(joint, states);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const double expected = difference([&](double t) { return joint_rows(joint, coasted(states, t))[k].error; });
        EXPECT_NEAR(rate(rows[k], states), expected, difference_tolerance(joint, states));
      }
    }
  }
}

TEST(JointRows, HaveTheirBiasAsTheSecondDerivativeOfACoastingPair) {
  Random random(2);
  for (int n = 0; n < 200; ++n) {
    for (const JointKind kind : kKinds) {
      const Joint joint = random_joint(random, kind);
      const std::vector<BodyState> states = random_states(random);
      const std::vector<JointRow> rows = joint_rows(joint, states);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const double expected = difference([&](double t) {
          const std::vector<BodyState> later = coasted(states, t);
          return rate(joint_rows(joint, later)[k], later);
        });
        EXPECT_NEAR(rows[k].bias, expected, difference_tolerance(joint, states));
      }
    }
  }
}

// force x lever + torque_a + torque_b = 0: no joint turns the pair as a whole, wherever it is.
TEST(JointRows, PushWithoutTurningThePair) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    for (const JointKind kind : kKinds) {
      Joint joint = random_joint(random, kind);
      joint.a = 0;
      std::vector<BodyState> states = random_states(random);
      std::vector<JointRow> rows = joint_rows(joint, states);
      if (kind == JointKind::kBall || kind == JointKind::kHinge || kind == JointKind::kFixed) {
        // Their anchors must coincide for the two equal forces to have one line of action.
        states[1].p_WB -= PlacedJoint(joint, states).gap;
        rows = joint_rows(joint, states);
      }
      for (const JointRow& row : rows) {
        const Vec3 turn = (states[1].p_WB - states[0].p_WB).cross(row.force_W) + row.torque_a_W + row.torque_b_W;
        EXPECT_LT(turn.norm(), 40 * kEps);  // sums of some ten products of numbers up to 4
      }
    }
  }
}

TEST(JointRows, AreAsManyAsTheJointHolds) {
  const std::vector<BodyState> states(2);
  const std::size_t expected[] = {3, 5, 5, 6, 1};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(joint_rows(Joint{kKinds[k], 0, 1, {}, {}, std::nullopt, 0, {}}, states).size(), expected[k]);
  }
}

// A pair that satisfies its joint and moves as it allows, by the joint's own coordinate at the rate 0.7.
struct MovingPair {
  Joint joint;
  double start = 0;
  std::vector<BodyState> at(const std::vector<BodyState>& base, double t) const {
    std::vector<BodyState> states = coasted(base, t);
    const double x = start + 0.7 * t;
    const BodyState A = joint.a == kWorld ? BodyState{} : states[joint.a];
    const Quat E = A.q_WB * joint.on_a.attitude;
    const bool slides = joint.kind == JointKind::kSlider;
    const Vec3 axis = joint.kind == JointKind::kBall ? Vec3::UnitX() : Vec3::UnitZ();
    const Quat turn = slides ? Quat(Quat::Identity()) : rotation_by(x * axis);
    BodyState& B = states[joint.b];
    B.q_WB = (E * turn * joint.on_b.attitude.conjugate()).normalized();
    B.w_WB = A.w_WB + (slides ? Vec3(Vec3::Zero()) : Vec3(0.7 * (E * axis)));
    const Vec3 z = E * Vec3::UnitZ(), reach = A.q_WB * joint.on_a.anchor + (slides ? x : 0) * z;
    B.p_WB = A.p_WB + reach - B.q_WB * joint.on_b.anchor;
    B.v_WB = A.v_WB + A.w_WB.cross(reach) + (slides ? 0.7 : 0) * z - B.w_WB.cross(B.q_WB * joint.on_b.anchor);
    return states;
  }
};

TEST(JointCoordinate, IsTheAngleOrTravelAndChangesAtItsRowsRate) {
  Random random(4);
  for (int n = 0; n < 100; ++n) {
    for (const JointKind kind : {JointKind::kBall, JointKind::kHinge, JointKind::kSlider}) {
      MovingPair pair{random_joint(random, kind), random.in(0.5, 2)};
      const std::vector<BodyState> base = random_states(random), states = pair.at(base, 0);
      const JointRow row = coordinate_row(pair.joint, states);
      EXPECT_NEAR(row.error, pair.start, 30 * kEps);
      EXPECT_NEAR(rate(row, states), 0.7, 60 * kEps);
      for (const JointRow& held : joint_rows(pair.joint, states)) {
        EXPECT_NEAR(held.error, 0, 30 * kEps);
        EXPECT_NEAR(rate(held, states), 0, 60 * kEps);
      }
      // Its rate stays 0.7: J a + bias = 0 with the accelerations that the pair has.
      const auto velocity = [&](std::size_t i, auto part) {
        Vec3 result;
        for (int c = 0; c < 3; ++c) result[c] = difference([&](double t) { return part(pair.at(base, t)[i])[c]; });
        return result;
      };
      const auto v = [](const BodyState& s) { return s.v_WB; };
      const auto w = [](const BodyState& s) { return s.w_WB; };
      const bool world = pair.joint.a == kWorld;
      const Vec3 a_A = world ? Vec3(Vec3::Zero()) : velocity(0, v),
                 alpha_A = world ? Vec3(Vec3::Zero()) : velocity(0, w);
      EXPECT_NEAR(row.rate(a_A, alpha_A, velocity(1, v), velocity(1, w)) + row.bias, 0, 10 * kDifferenceTolerance);
    }
  }
}

TEST(JointValidity, IsRefusedWithTheReason) {
  ArticulatedBody body;
  body.bodies = {{1, Mat3::Identity()}, {1, Mat3::Identity()}};
  const Joint good{JointKind::kHinge, 0, 1, {}, {}, JointRange{-1, 1}, 0, {}};
  body.joints = {good};
  EXPECT_NO_THROW(require_valid(body));
  const auto refused = [&](auto change) {
    ArticulatedBody bad = body;
    change(bad);
    EXPECT_THROW(require_valid(bad), std::invalid_argument);
  };
  refused([](ArticulatedBody& bad) { bad.bodies[0].mass = 0; });
  refused([](ArticulatedBody& bad) { bad.bodies[0].mass = std::nan(""); });
  refused([](ArticulatedBody& bad) { bad.bodies[1].inertia_B(2, 2) = 0; });
  refused([](ArticulatedBody& bad) { bad.joints[0].b = 2; });
  refused([](ArticulatedBody& bad) { bad.joints[0].b = kWorld; });
  refused([](ArticulatedBody& bad) { bad.joints[0].a = 1; });
  refused([](ArticulatedBody& bad) { bad.joints[0].on_a.attitude = Quat(2, 0, 0, 0); });
  refused([](ArticulatedBody& bad) { bad.joints[0].range = JointRange{1, 1}; });
  refused([](ArticulatedBody& bad) { bad.joints[0].range = JointRange{-4, 1}; });
  refused([](ArticulatedBody& bad) { bad.joints[0].kind = JointKind::kFixed; });
  refused([](ArticulatedBody& bad) { bad.joints[0].kind = JointKind::kBall; });  // its low must be 0
  EXPECT_THROW(coordinate_row(Joint{JointKind::kFixed, 0, 1, {}, {}, std::nullopt, 0, {}}, std::vector<BodyState>(2)),
               std::invalid_argument);
  EXPECT_THROW(frame_along(Vec3::Zero(), Vec3::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
