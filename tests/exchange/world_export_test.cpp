// Worlds on their way out: what stands in the files, and that every loss is named.
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plumbline/exchange/world_export.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

Scenario everything() {
  return read_scenario_file(std::string(PLUMBLINE_SOURCE_DIR) + "/tests/exchange/everything.toml").front().scenario;
}

bool names(const std::vector<std::string>& losses, const std::string& part) {
  return std::any_of(losses.begin(), losses.end(), [&](const auto& loss) { return loss.find(part) != loss.npos; });
}

struct Losses {
  WorldFormat format;
  std::vector<std::string> expected;
};

TEST(WorldExport, EveryLossIsNamedAndNoOther) {
  const Losses cases[] = {
      {WorldFormat::kMjcf, {"force law on 'can'", "restitution 0.25"}},
      {WorldFormat::kSdf,
       {"force law on 'can'", "spring 'rubber'", "joint 'rod'", "initial velocity of 'can'",
        "initial velocity of 'sled'", "initial velocity of 'bob'", "initial velocity of 'rodded'"}},
      {WorldFormat::kUrdf,
       {"force law on 'can'", "spring 'rubber'", "joint 'rod'", "joint 'socket'", "half_space 'floor'", "gravity",
        "restitution 0.25 and friction 0.4", "initial velocity of 'can'", "initial velocity of 'sled'",
        "initial velocity of 'bob'", "initial velocity of 'rodded'", "stiffness of joint 'shoulder'",
        "stiffness of joint 'track'", "duration and scales"}},
  };
  for (const Losses& c : cases) {
    const ExportedWorld world = export_world(everything(), c.format);
    for (const std::string& loss : c.expected) EXPECT_TRUE(names(world.losses, loss)) << loss;
    EXPECT_EQ(world.losses.size(), c.expected.size()) << ::testing::PrintToString(world.losses);
    for (const std::string& loss : world.losses) EXPECT_NE(world.text.find(loss), std::string::npos) << loss;
  }
}

TEST(WorldExport, FilesAreWellFormedWhateverTheNames) {
  Scenario scenario = everything();
  scenario.bodies[2].name = "<can> & \"tin\" -- 'x'";
  for (const auto format : {WorldFormat::kMjcf, WorldFormat::kSdf, WorldFormat::kUrdf}) {
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(export_world(scenario, format).text.c_str()), tinyxml2::XML_SUCCESS);
    ASSERT_NE(document.RootElement(), nullptr);
  }
}

TEST(WorldExport, MjcfStatesTheWholeHinge) {
  tinyxml2::XMLDocument document;
  document.Parse(export_world(everything(), WorldFormat::kMjcf).text.c_str());
  const auto* body = document.RootElement()->FirstChildElement("worldbody")->FirstChildElement("body");
  while (body != nullptr && std::string(body->Attribute("name")) != "arm") body = body->NextSiblingElement("body");
  ASSERT_NE(body, nullptr);
  const auto* joint = body->FirstChildElement("joint");
  ASSERT_NE(joint, nullptr);
  EXPECT_STREQ(joint->Attribute("pos"), "-0.5 0 0");
  EXPECT_STREQ(joint->Attribute("range"), "-0.5 1.25");
  EXPECT_DOUBLE_EQ(joint->DoubleAttribute("stiffness"), 4);
  EXPECT_DOUBLE_EQ(joint->DoubleAttribute("springref"), 0.3);
  // What is glued to the arm is a body within it, without joint.
  const auto* tip = body->FirstChildElement("body");
  ASSERT_NE(tip, nullptr);
  EXPECT_STREQ(tip->Attribute("name"), "tip");
  EXPECT_EQ(tip->FirstChildElement("joint"), nullptr);
}

TEST(WorldExport, UrdfPutsTheFrameAtTheJoint) {
  tinyxml2::XMLDocument document;
  document.Parse(export_world(everything(), WorldFormat::kUrdf).text.c_str());
  const auto* link = document.RootElement()->FirstChildElement("link");
  while (link != nullptr && std::string(link->Attribute("name")) != "tip") link = link->NextSiblingElement("link");
  ASSERT_NE(link, nullptr);
  // Glued at x = 1 m, its centre of mass at 1.2 m.
  double x = 0;
  ASSERT_EQ(std::sscanf(link->FirstChildElement("inertial")->FirstChildElement("origin")->Attribute("xyz"), "%lf", &x),
            1);
  EXPECT_NEAR(x, 0.2, 1e-15);
}

TEST(WorldExport, AScenarioThatIsNotSoundIsRefused) {
  Scenario scenario = everything();
  scenario.bodies[2].mass = std::nan("");
  EXPECT_THROW(export_world(scenario, WorldFormat::kSdf), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
