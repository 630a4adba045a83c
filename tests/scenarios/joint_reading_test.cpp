// [[joint]] and named solutions in scenario files: what they become, and what is said of faulty ones.
#include <gtest/gtest.h>

#include <string>

#include "plumbline/core/feature.hpp"
#include "plumbline/core/joints/joint_equations.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

// Lines are counted from id = 1; the joint's table begins in line 18.
const std::string kSound = R"(id = "test/arm"
about = "an arm on a post"
source = "none"
duration = 1
gravity = [0, 0, -10]
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "arm"
shape = { sphere = 0.1 }
mass = 1
position = [2, 0, 1]
[reference]
kind = "solution"
solution = "planar_pendulum"
[[joint]]
name = "pin"
kind = "hinge"
between = ["world", "arm"]
anchor = [1, 0, 1]
axis = [0, 2, 0]
)";

std::string with(const std::string& sound, const std::string& faulty) {
  std::string text = kSound;
  const std::size_t at = text.find(sound);
  if (at == std::string::npos) throw std::invalid_argument("the row does not fit the file above: " + sound);
  return text.replace(at, sound.size(), faulty);
}

std::string fault(const std::string& text) {
  try {
    read_scenario(text, "f.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no error";
}

TEST(JointReader, PutsTheFramesWhereTheFileSays) {
  const Scenario s = read_scenario(kSound, "f.toml").at(0).scenario;
  ASSERT_EQ(s.joints.size(), 1U);
  const Joint& joint = s.joints[0];
  EXPECT_EQ(joint.name, "pin");
  EXPECT_EQ(joint.kind, JointKind::kHinge);
  EXPECT_EQ(joint.a, kWorld);
  EXPECT_EQ(joint.b, 0U);
  EXPECT_LE((joint.on_a.anchor - Vec3(1, 0, 1)).norm(), 1e-15);
  EXPECT_LE((joint.on_b.anchor - Vec3(-1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((joint.on_a.axis() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LE((joint.on_b.axis() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(needs(s), FeatureSet({Feature::kHinge}));
}

TEST(JointReader, TurnsAJointToTheWorldRoundWhenTheWorldStandsSecond) {
  const Scenario s = read_scenario(with("[\"world\", \"arm\"]", "[\"arm\", \"world\"]"), "f.toml").at(0).scenario;
  EXPECT_EQ(s.joints.at(0).a, kWorld);
  EXPECT_EQ(s.joints.at(0).b, 0U);
}

TEST(JointReader, ReadsARodFromItsEnds) {
  std::string text = with("anchor = [1, 0, 1]\naxis = [0, 2, 0]\n", "anchors = [[2, 0, 4], [2, 0, 1]]\n");
  text.replace(text.find("\"hinge\""), 7, "\"distance\"");
  text.replace(text.find("kind = \"solution\"\nsolution = \"planar_pendulum\""), 46, "kind = \"closed_form\"");
  const Scenario s = read_scenario(text, "f.toml").at(0).scenario;
  EXPECT_EQ(s.joints.at(0).kind, JointKind::kDistance);
  EXPECT_DOUBLE_EQ(s.joints[0].length, 3);
  EXPECT_EQ(s.joints[0].on_b.anchor, Vec3::Zero());
  std::vector<BodyState> states = {s.bodies[0].initial};
  EXPECT_LE(joint_error(articulated_body(s), states), 1e-15);
}

TEST(JointReader, SaysWhatIsWrongAndTheWayOut) {
  EXPECT_EQ(
      fault(with("kind = \"hinge\"", "kind = \"hing\"")),
      "f.toml:20:8: /joint/0/kind: unknown joint 'hing'; did you mean 'hinge'? known: ball, hinge, slider, fixed, "
      "distance");
  EXPECT_EQ(fault(with("[\"world\", \"arm\"]", "[\"world\", \"leg\"]")),
            "f.toml:21:21: /joint/0/between/1: there is no body 'leg'; the bodies are: arm");
  EXPECT_EQ(fault(with("[\"world\", \"arm\"]", "[\"arm\", \"arm\"]")),
            "f.toml:21:11: /joint/0/between: a body cannot be tied to itself; name two bodies, or one and \"world\"");
  EXPECT_EQ(fault(with("[\"world\", \"arm\"]", "[\"world\", \"world\"]")),
            "f.toml:21:11: /joint/0/between: both ends are at rest; name a body that moves");
  EXPECT_EQ(fault(with("axis = [0, 2, 0]\n", "")),
            "f.toml:18:1: /joint/0/axis: is missing; add axis = [0, 1, 0]  # at the start, world frame");
  EXPECT_EQ(fault(with("[0, 2, 0]", "[0, 0, 0]")),
            "f.toml:23:8: /joint/0/axis: must not be the zero vector; [0, 1, 0] turns in the x-z plane");
  EXPECT_EQ(fault(with("kind = \"hinge\"", "kind = \"ball\"")),
            "f.toml:23:8: /joint/0/axis: only hinges and sliders have an axis; remove this line");
  EXPECT_EQ(fault(with("kind = \"hinge\"", "kind = \"distance\"")),
            "f.toml:22:10: /joint/0/anchor: a distance joint has two ends; write anchors = [[x, y, z], [x, y, z]]");
  EXPECT_EQ(fault(with("name = \"arm\"", "name = \"world\"")),
            "f.toml:11:8: /body/0/name: 'world' is what joints call the rest frame; choose another name");
  EXPECT_EQ(fault(with("position = [2, 0, 1]", "position = [2, 0, 1]\nvelocity = [0.5, 0, 0]")),
            "f.toml:19:1: /joint/0: the hinge joint 'pin' would come apart: the bodies start with 0.5 a second across "
            "it; correct their velocity or angular_velocity");
}

TEST(NamedSolution, RefusesAScenarioThatItDoesNotSolve) {
  // The list goes on with whatever solutions there are.
  const std::string unknown = fault(with("planar_pendulum", "planar_pendulums"));
  EXPECT_TRUE(
      unknown.starts_with("f.toml:17:12: /reference/solution: unknown solution 'planar_pendulums'; did you "
                          "mean 'planar_pendulum'? known: torque_free_rotation, planar_pendulum"))
      << unknown;
  EXPECT_EQ(fault(with("planar_pendulum", "torque_free_rotation")),
            "f.toml:17:12: /reference/solution: torque_free_rotation does not solve this scenario: nothing but gravity "
            "may act on the bodies: no force, joint, spring or contact");
  EXPECT_EQ(fault(with("[0, 2, 0]", "[0, 2, 1]")),
            "f.toml:17:12: /reference/solution: planar_pendulum does not solve this scenario: the hinge's axis must be "
            "at right angles to gravity");
  EXPECT_EQ(fault(with("[0, 0, -10]", "[0, 0, 0]")),
            "f.toml:17:12: /reference/solution: planar_pendulum does not solve this scenario: the hinge's axis must be "
            "at right angles to gravity");
}

// The same motion on a hinge that stands obliquely in space, with an arm that does not point along an axis of the body.
TEST(NamedSolution, SwingsAboutAnyAxisAtRightAnglesToGravity) {
  std::string text = with("position = [2, 0, 1]", "position = [1.6, 0.8, 1.5]");
  text.replace(text.find("[0, 2, 0]"), 9, "[-4, 3, 0]");
  const Case c = read_scenario(text, "f.toml").at(0);
  const Scenario& s = c.scenario;
  const ArticulatedBody body = articulated_body(s);
  std::vector<BodyState> start = {c.reference->at(0, 0)};
  const double energy = mechanical_energy(body, start);
  for (double t = 0; t <= 1; t += 0.125) {
    const std::vector<BodyState> now = {c.reference->at(0, t)};
    EXPECT_LE(joint_error(body, now), 1e-14) << t;
    EXPECT_NEAR(mechanical_energy(body, now), energy, 1e-13 * 30) << t;
  }
}

}  // namespace
}  // namespace plumbline
