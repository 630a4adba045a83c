// Foreign links and joints on their way into a scenario.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plumbline/exchange/scenario_text.hpp"
#include "plumbline/exchange/world_draft.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

constexpr double kRounding = 1e-15;

DraftShape ball(double radius, const Vec3& at) {
  DraftShape shape;
  shape.kind = "sphere";
  shape.shape = Sphere{radius};
  shape.at.p_WF = at;
  return shape;
}

DraftLink link(const std::string& name, const Vec3& at) {
  DraftLink result;
  result.name = name;
  result.mass = 2;
  result.inertia_com_W = Vec3(1, 2, 2.5).asDiagonal();
  result.com.p_WF = at;
  return result;
}

WorldDraft two_balls() {
  WorldDraft draft;
  draft.format = "test";
  for (const double x : {0.0, 3.0}) {
    draft.links.push_back(link(x == 0 ? "one" : "two", {x, 0, 0}));
    draft.links.back().shapes.push_back(ball(0.5, {x, 0, 0}));
  }
  draft.contacts.push_back({0, 1, {0.5, 0.1}});
  return draft;
}

bool names(const std::vector<std::string>& list, const std::string& part) {
  return std::any_of(list.begin(), list.end(), [&](const auto& line) { return line.find(part) != line.npos; });
}

TEST(WorldAssembly, WhatFitsIsTakenWithoutLoss) {
  const ImportedWorld world = assemble(two_balls());
  EXPECT_TRUE(world.losses.empty()) << ::testing::PrintToString(world.losses);
  ASSERT_EQ(world.scenario.bodies.size(), 2u);
  ASSERT_TRUE(world.scenario.contact);
  EXPECT_EQ(world.scenario.contact->restitution, 0.5);
  EXPECT_EQ(world.scenario.contact->friction, 0.1);
}

TEST(WorldAssembly, ProductsOfInertiaTurnTheFrame) {
  WorldDraft draft;
  draft.links.push_back(link("brick", Vec3::Zero()));
  const Quat turn(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  const Mat3 r = turn.toRotationMatrix(), principal = Vec3(1, 2, 2.5).asDiagonal();
  draft.links[0].inertia_com_W = r * principal * r.transpose();
  const ImportedWorld world = assemble(draft);
  ASSERT_EQ(world.scenario.bodies.size(), 1u);
  const Body& body = world.scenario.bodies[0];
  const Mat3 back = inertia_in_world(body, body.initial.q_WB);
  EXPECT_LE((back - draft.links[0].inertia_com_W).norm(), 16 * kRounding);
  EXPECT_LE((body.inertia - Vec3(1, 2, 2.5)).norm(), 16 * kRounding);
  EXPECT_TRUE(names(world.notes, "principal axes"));
  EXPECT_TRUE(world.losses.empty());
}

// Off-diagonal rounding must not turn a body whose moments are equal: any axes are principal there, and the shape's are
// the ones that collide.
TEST(WorldAssembly, RoundingDoesNotTurnACube) {
  WorldDraft draft = two_balls();
  draft.links[0].inertia_com_W = Mat3::Identity();
  draft.links[0].inertia_com_W(0, 1) = draft.links[0].inertia_com_W(1, 0) = 1e-17;
  draft.links[0].shapes[0].kind = "box";
  draft.links[0].shapes[0].shape = Box{Vec3(1, 1, 1)};
  const ImportedWorld world = assemble(draft);
  EXPECT_TRUE(world.losses.empty()) << ::testing::PrintToString(world.losses);
  EXPECT_EQ(world.scenario.bodies[0].initial.q_WB.w(), 1);
}

TEST(WorldAssembly, WhatHasNoPlaceIsNamed) {
  struct Change {
    std::string expected;
    void (*apply)(WorldDraft&);
  };
  const Change changes[] = {
      {"link 'one' has no mass", [](WorldDraft& d) { d.links[0].mass = 0; }},
      {"do not have, mesh 'hull'",
       [](WorldDraft& d) {
         d.links[0].shapes[0].shape.reset();
         d.links[0].shapes[0].kind = "mesh";
         d.links[0].shapes[0].name = "hull";
       }},
      {"'one' has its sphere 0.25 m away", [](WorldDraft& d) { d.links[0].shapes[0].at.p_WF.x() += 0.25; }},
      {"out of line with the principal axes",
       [](WorldDraft& d) {
         d.links[0].shapes[0].shape = Box{Vec3(1, 2, 3)};
         d.links[0].shapes[0].at.q_WF = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
       }},
      {"'one' collides with several shapes",
       [](WorldDraft& d) { d.links[0].shapes.push_back(ball(0.1, Vec3::Zero())); }},
      {"'one' carries a plane", [](WorldDraft& d) { d.links[0].shapes[0].shape = HalfSpace{Vec3::UnitZ()}; }},
      {"inertia that no body has", [](WorldDraft& d) { d.links[0].inertia_com_W << 1, 3, 0, 3, 1, 0, 0, 0, 1; }},
      {"'two' does not collide with anything", [](WorldDraft& d) { d.links[1].shapes.clear(); }},
      {"has friction 0.9",
       [](WorldDraft& d) {
         d.links.push_back(d.links[1]);
         d.links[2].name = "three";
         d.contacts.push_back({1, 2, {0.5, 0.9}});
         d.contacts.push_back({0, 2, {0.5, 0.1}});
       }},
      {"'two' and 'three' do not collide in the file",
       [](WorldDraft& d) {
         d.links.push_back(d.links[1]);
         d.links[2].name = "three";
         d.contacts.push_back({0, 2, {0.5, 0.1}});
       }},
      {"'one' and 'two' collide although a joint ties them",
       [](WorldDraft& d) {
         d.joints.emplace_back();
         d.joints[0].a = 0;
         d.joints[0].b = 1;
       }},
      {"contact law out of range", [](WorldDraft& d) { d.contacts[0].material.restitution = 1.5; }},
      {"its range [1, 2]",
       [](WorldDraft& d) {
         d.joints.emplace_back();
         d.joints[0].kind = JointKind::kSlider;
         d.joints[0].b = 1;
         d.joints[0].range = JointRange{1, 2};
       }},
      {"ball joint has no spring",
       [](WorldDraft& d) {
         d.joints.emplace_back();
         d.joints[0].b = 1;
         d.joints[0].damping = 1;
       }},
  };
  for (const Change& change : changes) {
    WorldDraft draft = two_balls();
    change.apply(draft);
    EXPECT_TRUE(names(assemble(draft).losses, change.expected)) << change.expected << '\n'
                                                                << ::testing::PrintToString(assemble(draft).losses);
  }
}

TEST(WorldAssembly, ThousandsOfPairsAreNotListedOneByOne) {
  WorldDraft draft = two_balls();
  for (int i = 0; i < 40; ++i) {
    draft.links.push_back(link("b" + std::to_string(i), {10.0 + i, 0, 0}));
    draft.links.back().shapes.push_back(ball(0.1, {10.0 + i, 0, 0}));
  }
  const ImportedWorld world = assemble(draft);
  EXPECT_LE(world.losses.size(), 20u);
  EXPECT_TRUE(names(world.losses, "further pairs"));
}

TEST(WorldAssembly, AJointToTheWorldCountsFromTheWorld) {
  WorldDraft draft = two_balls();
  draft.joints.emplace_back();
  DraftJoint& joint = draft.joints[0];
  joint.name = "door";
  joint.kind = JointKind::kHinge;
  joint.a = 1;
  joint.b = kWorld;
  joint.axis_W = Vec3::UnitZ();
  joint.range = JointRange{-0.5, 1};
  joint.stiffness = 3;
  joint.rest = 0.25;
  const ImportedWorld world = assemble(draft);
  ASSERT_EQ(world.scenario.joints.size(), 1u);
  const Joint& made = world.scenario.joints[0];
  EXPECT_EQ(made.a, kWorld);
  EXPECT_EQ(made.b, 1u);
  EXPECT_EQ(made.range->low, -1);
  EXPECT_EQ(made.range->high, 0.5);
  EXPECT_EQ(world.scenario.joint_springs[0].rest, -0.25);
}

// The text holds every number to the last bit.
TEST(ScenarioText, ReadsBackAsTheSameWorld) {
  const std::string file = std::string(PLUMBLINE_SOURCE_DIR) + "/tests/exchange/everything.toml";
  const Scenario before = read_scenario_file(file).front().scenario;
  const Scenario after = read_scenario(scenario_text(before, {"a comment\nof two lines"}), "text").front().scenario;
  ASSERT_EQ(after.bodies.size(), before.bodies.size());
  for (std::size_t i = 0; i < after.bodies.size(); ++i) {
    const Body &a = after.bodies[i], &b = before.bodies[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.shape.index(), b.shape.index());
    EXPECT_EQ(a.fixed, b.fixed);
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.inertia, b.inertia);
    EXPECT_EQ(a.initial.p_WB, b.initial.p_WB);
    EXPECT_EQ(a.initial.v_WB, b.initial.v_WB);
    EXPECT_EQ(a.initial.w_WB, b.initial.w_WB);
    EXPECT_LE(geodesic_angle(a.initial.q_WB, b.initial.q_WB), 4 * kRounding);  // normalised once more
  }
  ASSERT_EQ(after.joints.size(), before.joints.size());
  for (std::size_t i = 0; i < after.joints.size(); ++i) {
    EXPECT_EQ(after.joints[i].kind, before.joints[i].kind);
    EXPECT_EQ(after.joints[i].a, before.joints[i].a);
    EXPECT_LE((after.joints[i].on_b.anchor - before.joints[i].on_b.anchor).norm(), 8 * kRounding);
    EXPECT_EQ(after.joints[i].range.has_value(), before.joints[i].range.has_value());
  }
  EXPECT_EQ(after.springs.size(), before.springs.size());
  EXPECT_EQ(after.joint_springs.size(), before.joint_springs.size());
  EXPECT_EQ(after.gravity, before.gravity);
  EXPECT_EQ(after.steps, before.steps);
  EXPECT_EQ(after.scales.energy(), before.scales.energy());
}

TEST(ScenarioText, AsksForEnergyOnlyWhereNothingTakesIt) {
  WorldDraft draft = two_balls();
  draft.contacts[0].material = {1, 0};
  EXPECT_NE(scenario_text(assemble(draft).scenario, {}).find("energy.max"), std::string::npos);
  draft.contacts[0].material = {0.5, 0};
  EXPECT_EQ(scenario_text(assemble(draft).scenario, {}).find("energy.max"), std::string::npos);
}

}  // namespace
}  // namespace plumbline
