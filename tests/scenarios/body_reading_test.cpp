// Bodies of every shape, moving and fixed: what they become, and their faults.
#include <gtest/gtest.h>

#include "faulty_copy.hpp"

namespace plumbline {
namespace {

// The body begins in line 9.
const std::string kSound = R"toml(id = "test/shapes"
about = "one body beside another"
source = "none"
duration = 1
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "log"
shape = { cylinder = [2, 6] }
mass = 3
position = [0, 5, 0]
attitude = ["sqrt(0.5)", "-sqrt(0.5)", 0, 0]
[[body]]
name = "wall"
shape = { box = [1, 2, 3] }
fixed = true
position = [1, 0, 0]
attitude = [0, 0, 0, 2]
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

TEST(BodyReader, ReadsACylinderWithItsMomentsAlongItsOwnAxis) {
  const Body log = read_scenario(kSound, "f.toml").at(0).scenario.bodies.at(0);
  ASSERT_TRUE(std::holds_alternative<Cylinder>(log.shape));
  EXPECT_EQ(std::get<Cylinder>(log.shape).radius, 2);
  EXPECT_EQ(std::get<Cylinder>(log.shape).height, 6);
  EXPECT_LE((log.inertia - Vec3(12, 12, 6)).norm(), 1e-14) << "m (3 r^2 + h^2)/12 twice, m r^2/2";
  EXPECT_LE((log.initial.q_WB * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-15) << "planar engines want the axis along y";
}

TEST(BodyReader, LetsAnyShapeStandStill) {
  const Body wall = read_scenario(kSound, "f.toml").at(0).scenario.bodies.at(1);
  EXPECT_TRUE(wall.fixed);
  EXPECT_EQ(wall.initial.p_WB, Vec3(1, 0, 0));
  EXPECT_EQ(wall.initial.q_WB.coeffs(), Eigen::Vector4d(0, 0, 1, 0)) << "normalised";
  const Body moving =
      read_scenario(replaced(kSound, "fixed = true", "fixed = false\nmass = 12"), "f.toml").at(0).scenario.bodies.at(1);
  EXPECT_FALSE(moving.fixed);
  EXPECT_EQ(moving.mass, 12);
}

TEST(BodyReader, SaysWhatIsWrongAndTheWayOut) {
  EXPECT_EQ(fault("[2, 6]", "[2]"), "f.toml:11:22: /body/0/shape/cylinder: must have 2 components, has 1");
  EXPECT_EQ(fault("[2, 6]", "[2, 0]"), "f.toml:11:26: /body/0/shape/cylinder/1: must be > 0, is 0");
  EXPECT_EQ(
      fault("cylinder", "cilinder"),
      "f.toml:11:11: /body/0/shape/cilinder: unknown shape; did you mean 'cylinder'? write { sphere = r }, { box = "
      "[x, y, z] }, { cylinder = [r, h] } or { half_space = [nx, ny, nz] }");
  EXPECT_EQ(fault("fixed = true", "fixed = true\nmass = 1"),
            "f.toml:19:8: /body/1/mass: a fixed body never moves; remove this line, or fixed");
  EXPECT_EQ(fault("fixed = true", "fixed = true\nvelocity = [1, 0, 0]"),
            "f.toml:19:12: /body/1/velocity: a fixed body never moves; remove this line, or fixed");
  EXPECT_EQ(fault("fixed = true", "fixed = 1"), "f.toml:18:9: /body/1/fixed: must be true or false, is a number");
  EXPECT_EQ(fault("fixed = true\n", ""), "f.toml:15:1: /body/1/mass: is missing; add mass = 1.0  # kg");
  EXPECT_EQ(fault("{ box = [1, 2, 3] }\nfixed = true", "{ half_space = [0, 0, 1] }\nfixed = false"),
            "f.toml:18:9: /body/1/fixed: a half_space is always fixed; remove this line");
  EXPECT_EQ(fault("kind = \"closed_form\"", "kind = \"closed_form\"\nwall.x = 1"),
            "f.toml:23:1: /reference/wall: 'wall' is fixed and keeps its place; remove this");
}

}  // namespace
}  // namespace plumbline
