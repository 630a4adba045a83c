#include "plumbline/core/deviation.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace plumbline {
namespace {

Scenario two_sphere() {
  Scenario s;
  s.id = "collision/two_sphere";
  s.parameters = {{"e", 0.5}, {"b", 0}};
  return s;
}

Deviation anything() {
  Deviation d;
  d.scenario = "collision/two_sphere";
  return d;
}

TEST(Deviation, CoversEverythingThatItDoesNotRestrict) {
  EXPECT_TRUE(anything().covers(two_sphere(), "row", Profile::kDefault, 0.02));
  EXPECT_TRUE(anything().covers(two_sphere(), "other", Profile::kMatched, 0.001));
}

TEST(Deviation, CoversOnlyItsScenario) {
  Scenario other = two_sphere();
  other.id = "collision/two_spheres";
  EXPECT_FALSE(anything().covers(other, "row", Profile::kDefault, 0.02));
}

TEST(Deviation, CoversOnlyItsEngines) {
  Deviation d = anything();
  d.engines = {"a", "b"};
  EXPECT_TRUE(d.covers(two_sphere(), "b", Profile::kDefault, 0.02));
  EXPECT_FALSE(d.covers(two_sphere(), "c", Profile::kDefault, 0.02));
}

TEST(Deviation, CoversOnlyItsProfile) {
  Deviation d = anything();
  d.profile = Profile::kMatched;
  EXPECT_TRUE(d.covers(two_sphere(), "row", Profile::kMatched, 0.02));
  EXPECT_FALSE(d.covers(two_sphere(), "row", Profile::kDefault, 0.02));
}

TEST(Deviation, CoversOnlyItsParameters) {
  Deviation d = anything();
  d.parameters = {{"e", 0.5}};
  EXPECT_TRUE(d.covers(two_sphere(), "row", Profile::kDefault, 0.02));
  d.parameters = {{"e", 1}};
  EXPECT_FALSE(d.covers(two_sphere(), "row", Profile::kDefault, 0.02));
  d.parameters = {{"unknown", 0.5}};
  EXPECT_FALSE(d.covers(two_sphere(), "row", Profile::kDefault, 0.02));
}

TEST(Deviation, CoversAStepWrittenWithFewDigits) {
  Deviation d = anything();
  d.dt = {0.0166667, 0.001};
  EXPECT_TRUE(d.covers(two_sphere(), "row", Profile::kDefault, 1.0 / 60));
  EXPECT_TRUE(d.covers(two_sphere(), "row", Profile::kDefault, 0.001));
  EXPECT_FALSE(d.covers(two_sphere(), "row", Profile::kDefault, 0.02));
}

EngineInfo three_knobs() {
  EngineInfo info;
  info.settings = {{"sleeping", true, false, "", ""},
                   {"slop", 0.01, 0.0, "m", ""},
                   {"solver", std::string("fast"), std::string("exact"), "", ""}};
  return info;
}

TEST(Settings, FollowTheProfile) {
  const Settings usual = settings_of(three_knobs(), Profile::kDefault);
  EXPECT_TRUE(setting_bool(usual, "sleeping"));
  EXPECT_EQ(setting_number(usual, "slop"), 0.01);
  EXPECT_EQ(setting_text(usual, "solver"), "fast");
  const Settings matched = settings_of(three_knobs(), Profile::kMatched);
  EXPECT_FALSE(setting_bool(matched, "sleeping"));
  EXPECT_EQ(setting_number(matched, "slop"), 0.0);
  EXPECT_EQ(setting_text(matched, "solver"), "exact");
}

TEST(Settings, NameWhatIsMissingOrOfAnotherType) {
  const Settings settings = settings_of(three_knobs(), Profile::kDefault);
  const auto message = [](const auto& access) -> std::string {
    try {
      access();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "nothing was thrown";
  };
  EXPECT_NE(message([&] { setting_number(settings, "gravity"); }).find("gravity"), std::string::npos);
  EXPECT_NE(message([&] { setting_number(settings, "sleeping"); }).find("'sleeping' must be a number"),
            std::string::npos);
  EXPECT_NE(message([&] { setting_bool(settings, "slop"); }).find("'slop' must be true or false"), std::string::npos);
  EXPECT_NE(message([&] { setting_text(settings, "slop"); }).find("'slop' must be a word"), std::string::npos);
}

TEST(Settings, ProfilesAndPrecisionsHaveTheirNumbers) {
  EXPECT_EQ(profile_name(Profile::kDefault), "default");
  EXPECT_EQ(profile_name(Profile::kMatched), "matched");
  EngineInfo info;
  EXPECT_EQ(info.unit_roundoff(), 0x1p-53);
  info.precision = Precision::kSingle;
  EXPECT_EQ(info.unit_roundoff(), 0x1p-24);
}

}  // namespace
}  // namespace plumbline
