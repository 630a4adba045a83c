#include "plumbline/adapters/joint_tree.hpp"

#include <gtest/gtest.h>

#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {
namespace {

Body ball_at(const Vec3& p_WB) {
  Body body;
  body.shape = Sphere{0.1};
  body.mass = 1;
  body.inertia = Vec3::Constant(0.1);
  body.initial.p_WB = p_WB;
  return body;
}

// Four balls along x, and a floor among them.
Scenario row_of_balls() {
  Scenario s;
  Body floor;
  floor.shape = HalfSpace{Vec3::UnitZ()};
  floor.fixed = true;
  s.bodies = {ball_at({0, 0, 1}), floor, ball_at({1, 0, 1}), ball_at({2, 0, 1}), ball_at({3, 0, 1})};
  return s;
}

void tie(Scenario& s, JointKind kind, std::size_t a, std::size_t b, const Vec3& anchor) {
  std::vector<BodyState> states;
  for (const Body& body : s.bodies) states.push_back(body.initial);
  s.joints.push_back(joint_at(kind, a, b, states, anchor, Vec3::UnitY()));
}

TEST(JointTree, LetsUntiedBodiesFloatAndFixedOnesOut) {
  const JointTree tree = joint_tree(row_of_balls());
  ASSERT_EQ(tree.links.size(), 4U);
  const std::size_t order[] = {0, 2, 3, 4};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(tree.links[k].body, order[k]);
    EXPECT_FALSE(tree.links[k].joint);
  }
  EXPECT_TRUE(tree.left_over.empty());
}

TEST(JointTree, HangsChainsFromTheWorldAndTurnsJointsThatAreStatedTheOtherWay) {
  Scenario s = row_of_balls();
  tie(s, JointKind::kHinge, 4, 3, {2.5, 0, 1});  // stated from the outer ball to the inner one
  tie(s, JointKind::kHinge, kWorld, 3, {2, 0, 1.5});
  const JointTree tree = joint_tree(s);
  ASSERT_EQ(tree.links.size(), 4U);
  EXPECT_EQ(tree.links[0].body, 3U);
  EXPECT_EQ(tree.links[0].joint->a, kWorld);
  EXPECT_EQ(tree.links[0].stated, 1U);
  EXPECT_EQ(tree.links[1].body, 4U);
  EXPECT_EQ(tree.links[1].joint->a, 3U);
  EXPECT_EQ(tree.links[1].joint->b, 4U);
  EXPECT_EQ(tree.links[1].stated, 0U);
  EXPECT_LE((tree.links[1].joint->on_b.anchor - Vec3(-0.5, 0, 0)).norm(), 1e-15);
}

TEST(JointTree, LeavesOverRodsAndWhatWouldCloseALoop) {
  Scenario s = row_of_balls();
  tie(s, JointKind::kBall, kWorld, 0, {0, 0, 2});
  tie(s, JointKind::kBall, 0, 2, {0.5, 0, 1});
  tie(s, JointKind::kBall, kWorld, 2, {1, 0, 2});  // over the world
  s.joints.push_back(
      rod_between(3, 4, {s.bodies[0].initial, {}, {}, s.bodies[3].initial, s.bodies[4].initial}, {2, 0, 1}, {3, 0, 1}));
  const JointTree tree = joint_tree(s);
  ASSERT_EQ(tree.links.size(), 4U);
  // Level by level: both balls that the world holds come first, so that the joint between them is the one left over.
  EXPECT_EQ(tree.left_over, (std::vector<std::size_t>{1, 3}));
  EXPECT_FALSE(tree.links[2].joint);
  EXPECT_FALSE(tree.links[3].joint);
}

TEST(JointTree, FloatsAGroupByTheBodyThatIsStatedFirst) {
  Scenario s = row_of_balls();
  tie(s, JointKind::kSlider, 4, 0, {0, 0, 1});
  const JointTree tree = joint_tree(s);
  EXPECT_EQ(tree.links[0].body, 0U);
  EXPECT_FALSE(tree.links[0].joint);
  EXPECT_EQ(tree.links[1].body, 4U);
  EXPECT_EQ(tree.links[1].joint->a, 0U);
}

TEST(JointTree, TellsTheRatesThatTheStartHas) {
  Scenario s = row_of_balls();
  s.bodies[0].initial.w_WB = Vec3(0, 0.5, 0);
  s.bodies[2].initial.w_WB = Vec3(0, 2, 0);
  tie(s, JointKind::kHinge, 0, 2, {0.5, 0, 1});
  EXPECT_NEAR(initial_rate(s, s.joints[0]), 1.5, 1e-15);
  EXPECT_NEAR(initial_rate(s, reversed(s.joints[0])), -1.5, 1e-15);
  s.bodies[3].initial.v_WB = Vec3(0, 3, 0);
  tie(s, JointKind::kSlider, kWorld, 3, {2, 0, 1});
  EXPECT_NEAR(initial_rate(s, s.joints[1]), 3, 1e-15);
  tie(s, JointKind::kBall, 0, 2, {0.5, 0, 1});
  s.bodies[2].initial.q_WB = rotation_by(Vec3(0, 0, std::acos(0.0)));
  // (0, 1.5, 0) in axes of b that are turned by a quarter about z: along its x.
  EXPECT_LE((initial_relative_rotation(s, s.joints[2]) - Vec3(1.5, 0, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace plumbline
