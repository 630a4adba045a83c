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
  std::vector<Deviation> read(const std::string& text) {
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
  const auto deviations = read(kWhole);
  ASSERT_EQ(deviations.size(), 2u);
  EXPECT_EQ(deviations[0].metric, "energy.max");
  EXPECT_TRUE(std::isinf(deviations[0].limit));
  EXPECT_EQ(deviations[1].metric, "position.max");
  EXPECT_EQ(deviations[1].limit, 0.5);
  EXPECT_EQ(deviations[1].dt, (std::vector<double>{1.0 / 60, 0.02}));
  EXPECT_EQ(deviations[1].profile, Profile::kDefault);
  EXPECT_EQ(deviations[1].place.line, 1);
}

TEST_F(DeviationFile, AnAbsentFileIsAnEmptyList) { EXPECT_TRUE(read_deviations("/nonexistent.toml").empty()); }

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
