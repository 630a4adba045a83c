#include "deviation_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "usage_error.hpp"

namespace plumbline {
namespace {

class DeviationFile : public ::testing::Test {
 protected:
  DeviationLists read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_deviations(file_);
  }
  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const UsageError& e) {
      return e.what();
    }
    return "no complaint";
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("deviations-" + std::to_string(getpid()) + ".toml");
};

const std::string kWhole = R"([[deviation]]
engines = ["row"]
scenario = "family/case"
parameters = { e = 1 }
profile = "default"
dt = ["1/60", 0.02]
limits = { "position.max" = 0.5, "energy.max" = inf }
why = "the cause"
link = "a link"
)";

TEST_F(DeviationFile, GivesOneDeviationPerLimit) {
  const auto deviations = read(kWhole).deviations;
  ASSERT_EQ(deviations.size(), 2u);
  EXPECT_EQ(deviations[0].metric, "energy.max");
  EXPECT_TRUE(std::isinf(deviations[0].limit));
  EXPECT_EQ(deviations[1].metric, "position.max");
  EXPECT_EQ(deviations[1].limit, 0.5);
  EXPECT_EQ(deviations[1].dt, (std::vector<double>{1.0 / 60, 0.02}));
  EXPECT_EQ(deviations[1].profile, Profile::kDefault);
  EXPECT_EQ(deviations[1].place.line, 1);
}

TEST_F(DeviationFile, GivesHowARunEnds) {
  const auto deviations =
      read("[[deviation]]\nscenario = \"a/b\"\nends = \"timed_out\"\nwhy = \"small steps\"\n").deviations;
  ASSERT_EQ(deviations.size(), 1u);
  EXPECT_EQ(deviations[0].ends, Verdict::kTimedOut);
  EXPECT_TRUE(deviations[0].metric.empty());
}

TEST_F(DeviationFile, AnAbsentFileIsAnEmptyList) {
  EXPECT_TRUE(read_deviations("/nonexistent.toml").deviations.empty());
  EXPECT_TRUE(read_deviations("/nonexistent.toml").known_failures.empty());
}

const std::string kKnown = R"([[conformance]]
check = "huge_speed_is_kept"
engines = ["row", "other"]
profile = "default"
why = "the cause"
link = "a link"

[[conformance]]
check = "friction_is_a_cone"
why = "another"

[[conformance]]
checks = ["a_step_lasts_dt", "motion_across_the_plane"]
why = "one cause for two"
)";

TEST_F(DeviationFile, GivesKnownFailuresOfChecks) {
  const auto known = read(kWhole + "\n" + kKnown).known_failures;
  ASSERT_EQ(known.size(), 4u);
  EXPECT_EQ(known[0].check, "huge_speed_is_kept");
  EXPECT_EQ(known[0].link, "a link");
  EXPECT_TRUE(known[0].covers("other", Profile::kDefault, "huge_speed_is_kept"));
  EXPECT_FALSE(known[0].covers("other", Profile::kMatched, "huge_speed_is_kept"));
  EXPECT_FALSE(known[0].covers("third", Profile::kDefault, "huge_speed_is_kept"));
  EXPECT_TRUE(known[1].covers("any", Profile::kMatched, "friction_is_a_cone"));
  EXPECT_FALSE(known[1].covers("any", Profile::kMatched, "huge_speed_is_kept"));
  EXPECT_EQ(known[2].check, "a_step_lasts_dt");
  EXPECT_EQ(known[3].check, "motion_across_the_plane");
  EXPECT_EQ(known[3].why, "one cause for two");
}

TEST_F(DeviationFile, ComplainsAboutKnownFailuresWithThePlace) {
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = kKnown;
    text.replace(text.find(from), from.size(), to);
    return complaint(text);
  };
  const std::string name = file_.string();
  EXPECT_EQ(replaced("huge_speed_is_kept", "huge").find(name + ":2:9: there is no check 'huge'"), 0u);
  EXPECT_EQ(replaced("a_step_lasts_dt", "a_step").find(name + ":13:11: there is no check 'a_step'"), 0u);
  EXPECT_EQ(replaced("why = \"the cause\"", "").find(name + ":1:1: a known failure must say why"), 0u);
  EXPECT_EQ(replaced("check = \"friction_is_a_cone\"", "").find(name + ":8:1: a known failure must name"), 0u);
  EXPECT_EQ(replaced("link =", "dt =").find(name + ":6:"), 0u);
  EXPECT_EQ(replaced("[[conformance]]", "[[conformity]]").find(name + ":1:"), 0u);
}

TEST_F(DeviationFile, ComplainsWithThePlace) {
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = kWhole;
    text.replace(text.find(from), from.size(), to);
    return complaint(text);
  };
  const std::string name = file_.string();
  EXPECT_EQ(replaced("why = \"the cause\"", "").find(name + ":1:1: a deviation must say why"), 0u);
  EXPECT_EQ(replaced("position.max", "position.most").find(name + ":7:"), 0u);
  EXPECT_EQ(replaced("link =", "lnk =").find(name + ":9:"), 0u);
  EXPECT_EQ(replaced("profile = \"default\"", "profile = 3").find(name + ":5:"), 0u);
  EXPECT_EQ(replaced("0.5", "-0.5").find(name + ":7:"), 0u);
  EXPECT_EQ(replaced("0.5", "nan").find(name + ":7:"), 0u);
  EXPECT_EQ(replaced("dt = [", "dt = [[").find(name + ":"), 0u);
}

}  // namespace
}  // namespace plumbline
