// [[spring]], and range, stiffness, damping, rest and drive of a [[joint]]: what they become, and their faults.
#include <gtest/gtest.h>

#include <cmath>

#include "faulty_copy.hpp"

namespace plumbline {
namespace {

// Lines are counted from id = 1; the joint begins in line 27, the spring in line 36.
const std::string kSound = R"toml(id = "test/arm"
about = "an arm on a post, and a ball on a spring"
source = "none"
duration = 1
[parameters]
k = 8
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "arm"
shape = { sphere = 0.1 }
mass = 1
position = [2, 0, 1]
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1
position = [0, 0, 5]
attitude = ["sqrt(0.5)", 0, "sqrt(0.5)", 0]
[[body]]
name = "post"
shape = { box = [1, 1, 1] }
fixed = true
position = [0, 0, 9]
[[joint]]
name = "pin"
kind = "hinge"
between = ["world", "arm"]
anchor = [1, 0, 1]
axis = [0, 1, 0]
range = ["-pi/2", 0.5]
stiffness = "k/2"
drive = "k*sin(2*t) - 3*q + dq"
[[spring]]
name = "coil"
between = ["ball", "post"]
anchors = [[0, 0, 6], [0, 0, 8.5]]
stiffness = "k"
damping = 0.25
[reference]
kind = "closed_form"
[[gate]]
metric = "position.max"
limit = 1
reason = "none"
)toml";

std::string fault(const std::string& sound, const std::string& faulty) {
  return fault_of(replaced(kSound, sound, faulty));
}

Scenario read(const std::string& text) { return read_scenario(text, "f.toml").at(0).scenario; }

TEST(SpringReader, PutsTheEndsOnTheBodiesAndTheWorldFirst) {
  const Scenario s = read(kSound);
  ASSERT_EQ(s.springs.size(), 1U);
  const Spring& spring = s.springs[0];
  EXPECT_EQ(spring.name, "coil");
  EXPECT_EQ(spring.a, kWorld) << "a fixed body is a place in the world";
  EXPECT_EQ(spring.b, 1U);
  EXPECT_EQ(spring.on_a, Vec3(0, 0, 8.5));
  EXPECT_LE((spring.on_b - Vec3(-1, 0, 0)).norm(), 1e-15) << "the ball is turned by a right angle about y";
  EXPECT_EQ(spring.stiffness, 8);
  EXPECT_EQ(spring.damping, 0.25);
  EXPECT_EQ(spring.length, 2.5) << "as long as at the start";
  EXPECT_EQ(read(replaced(kSound, "damping = 0.25", "length = 0")).springs[0].length, 0);
}

TEST(SpringReader, SaysWhatIsWrongAndTheWayOut) {
  EXPECT_EQ(fault("between = [\"ball\", \"post\"]", "between = [\"world\", \"post\"]"),
            "f.toml:38:11: /spring/0/between: both ends are at rest; name a body that moves");
  EXPECT_EQ(fault("between = [\"ball\", \"post\"]", "between = [\"ball\", \"ball\"]"),
            "f.toml:38:11: /spring/0/between: a body cannot pull itself; name two bodies, or one and \"world\"");
  EXPECT_EQ(
      fault("between = [\"ball\", \"post\"]", "between = [\"bal\", \"post\"]"),
      "f.toml:38:12: /spring/0/between/0: there is no body 'bal'; did you mean 'ball'? the bodies are: arm, ball, "
      "post");
  EXPECT_EQ(fault("anchors = [[0, 0, 6], [0, 0, 8.5]]", "anchors = [[0, 0, 6]]"),
            "f.toml:39:11: /spring/0/anchors: must have 2 components, has 1");
  EXPECT_EQ(
      fault("anchors = [[0, 0, 6], [0, 0, 8.5]]\n", ""),
      "f.toml:36:1: /spring/0/anchors: is missing; add anchors = [[0, 0, 1], [0, 0, 0]]  # its ends at the start, "
      "world frame");
  EXPECT_EQ(fault("stiffness = \"k\"", "stiffness = \"-k\""), "f.toml:40:13: /spring/0/stiffness: must be >= 0, is -8");
  EXPECT_EQ(fault("damping = 0.25", "damping = -1"), "f.toml:41:11: /spring/0/damping: must be >= 0, is -1");
  EXPECT_EQ(fault("damping = 0.25", "lenght = 1"),
            "f.toml:41:1: /spring/0/lenght: unknown key; did you mean 'length'? allowed here: name, between, anchors, "
            "stiffness, damping, length");
}

TEST(JointReader, ReadsRangeSpringAndDrive) {
  const Scenario s = read(kSound);
  ASSERT_TRUE(s.joints.at(0).range.has_value());
  EXPECT_DOUBLE_EQ(s.joints[0].range->low, -std::acos(0.0));
  EXPECT_EQ(s.joints[0].range->high, 0.5);
  ASSERT_EQ(s.joint_springs.size(), 1U);
  EXPECT_EQ(s.joint_springs[0].joint, 0U);
  EXPECT_EQ(s.joint_springs[0].stiffness, 4);
  EXPECT_EQ(s.joint_springs[0].damping, 0);
  EXPECT_EQ(s.joint_springs[0].rest, 0);
  ASSERT_EQ(s.drives.size(), 1U);
  EXPECT_EQ(s.drives[0].joint, 0U);
  EXPECT_EQ(s.drives[0].text, "k*sin(2*t) - 3*q + dq");
  EXPECT_DOUBLE_EQ(s.drives[0].effort(0.25, 2, 10), 8 * std::sin(0.5) - 6 + 10);
}

TEST(JointReader, SaysWhatIsWrongWithRangeSpringAndDrive) {
  const std::string range = "range = [\"-pi/2\", 0.5]";
  EXPECT_EQ(fault(range, "range = [0.1, 0.5]"),
            "f.toml:33:9: /joint/0/range: must hold 0, where the joint starts: [low, high] with low <= 0 <= high");
  EXPECT_EQ(fault(range, "range = [0, 0]"),
            "f.toml:33:9: /joint/0/range: must hold 0, where the joint starts: [low, high] with low <= 0 <= high");
  EXPECT_EQ(fault(range, "range = [-4, 0]"),
            "f.toml:33:9: /joint/0/range: the angle of a hinge is known within (-pi, pi); take bounds inside it");
  EXPECT_EQ(
      fault("stiffness = \"k/2\"", "rest = 1"),
      "f.toml:34:8: /joint/0/rest: without stiffness there is nothing to rest; add stiffness or remove this line");
  EXPECT_EQ(fault("stiffness = \"k/2\"", "damping = -2"), "f.toml:34:11: /joint/0/damping: must be >= 0, is -2");
  EXPECT_EQ(fault("- 3*q + dq", "- 3*angle"),
            "f.toml:35:9: /joint/0/drive: unknown symbol 'angle' in \"k*sin(2*t) - 3*angle\"; known here: k, t, q, dq, "
            "pi");
  const std::string hinge = "kind = \"hinge\"\nbetween = [\"world\", \"arm\"]\nanchor = [1, 0, 1]\naxis = [0, 1, 0]\n";
  const std::string ball = "kind = \"ball\"\nbetween = [\"world\", \"arm\"]\nanchor = [1, 0, 1]\n";
  EXPECT_EQ(fault(hinge, ball),
            "f.toml:32:9: /joint/0/range: only hinges and sliders have a coordinate to bound; remove this line");
  EXPECT_EQ(
      fault(hinge + range + "\n", ball),
      "f.toml:32:13: /joint/0/stiffness: only hinges and sliders have a coordinate that it can act on; remove this "
      "line");
  EXPECT_EQ(fault(hinge + range + "\nstiffness = \"k/2\"\n", ball),
            "f.toml:32:9: /joint/0/drive: only hinges and sliders have a coordinate that it can act on; remove this "
            "line");
}

TEST(JointReader, KeepsTheCoordinatesNameForTheDrive) {
  EXPECT_EQ(fault("k = 8", "k = 8\nq = 2"),
            "f.toml:36:9: /joint/0/drive: 'q' is the joint's coordinate here; give the parameter another name");
}

}  // namespace
}  // namespace plumbline
