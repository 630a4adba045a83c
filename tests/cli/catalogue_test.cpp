// What the whole catalogue gave, on every engine that was built. No engine is named here: rows are told apart by what
// they declare.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "plumbline/core/verdict.hpp"

namespace plumbline {
namespace {

using nlohmann::json;

const json& results() {
  static const json document = json::parse(std::ifstream(PLUMBLINE_RESULTS "/results.json"));
  return document;
}

// Of the scenarios that were run with all their steps.
const json& results_of_all_steps() {
  static const json document = json::parse(std::ifstream(PLUMBLINE_RESULTS "_orders/results.json"));
  return document;
}

std::map<std::string, json> engines() {
  std::map<std::string, json> by_name;
  for (const json& engine : results().at("engines")) by_name[engine.at("name")] = engine;
  return by_name;
}

TEST(Catalogue, EveryCellHasAVerdictAndNoneIsBlank) {
  std::set<std::string> seen;
  std::size_t cases_times_steps = 0;
  for (const json& s : results().at("scenarios")) cases_times_steps += s.at("cases").size() * s.at("steps").size();
  for (const json& run : results().at("runs")) {
    const std::string verdict = run.at("verdict");
    ASSERT_TRUE(verdict_named(verdict)) << verdict;
    EXPECT_TRUE(verdict == "pass" || !run.at("reason").get<std::string>().empty()) << run;
    seen.insert(run.at("case").get<std::string>() + run.at("engine").get<std::string>() +
                run.at("profile").get<std::string>() + run.at("dt").dump());
  }
  EXPECT_EQ(seen.size(), results().at("runs").size()) << "a run stands twice";
  EXPECT_EQ(seen.size(), cases_times_steps * engines().size() * 2);
}

TEST(Catalogue, TheThreeNamedScenariosRunOnEveryEngine) {
  const auto rows = engines();
  EXPECT_GE(rows.size(), 11U);
  for (const json& run : results().at("runs")) {
    const std::string id = run.at("scenario");
    if (id != "particle/falling_box" && id != "particle/drag_ship" && id != "collision/two_sphere") continue;
    // A row without a law of restitution is asked only for impacts without rebound.
    const json& features = rows.at(run.at("engine")).at("features");
    const bool rebounds = std::find(features.begin(), features.end(), "restitution") != features.end();
    const bool asked = id != "collision/two_sphere" || run.at("parameters").at("e") == 0 || rebounds;
    EXPECT_EQ(run.at("verdict") == "unsupported", !asked) << run.at("engine") << ' ' << run.at("case");
  }
}

TEST(Catalogue, EveryUnsupportedRunNamesWhatIsMissing) {
  for (const json& run : results().at("runs")) {
    if (run.at("verdict") != "unsupported") continue;
    EXPECT_TRUE(run.at("reason").get<std::string>().starts_with("the engine has no ")) << run.at("reason");
  }
}

// g t dt/2 with g = 9.8, t = 2 s, dt = 0.02 s. Double precision adds some 100 roundings of numbers up to 16; in
// single precision the same sum is bounded by 100 * 2^-24 * 16 = 1e-4.
TEST(Catalogue, SemiImplicitEnginesDropTheBoxByTheirSchemesError) {
  const auto rows = engines();
  int checked = 0;
  for (const json& run : results_of_all_steps().at("runs")) {
    if (run.at("scenario") != "particle/falling_box" || run.at("dt") != 0.02 || run.at("profile") != "matched")
      continue;
    const json& engine = rows.at(run.at("engine"));
    if (!engine.at("scheme").get<std::string>().starts_with("semi-implicit Euler")) continue;
    const double tolerance = engine.at("precision") == "single" ? 1e-4 : 1e-9;
    EXPECT_NEAR(run.at("metrics").at("position.max").get<double>(), 0.196, tolerance) << run.at("engine");
    EXPECT_TRUE(run.at("explanation").at("scheme").get<std::string>().starts_with("semi-implicit Euler")) << run;
    EXPECT_LT(run.at("explanation").at("distance").get<double>(), tolerance) << run.at("engine");
    ++checked;
  }
  EXPECT_GE(checked, 1);
}

TEST(Catalogue, FirstOrderSchemesConvergeWithFirstOrderOnTheShip) {
  const auto rows = engines();
  int checked = 0;
  for (const json& c : results_of_all_steps().at("convergence")) {
    if (!c.at("case").get<std::string>().starts_with("particle/drag_ship") || c.at("metric") != "position.max")
      continue;
    if (c.at("profile") != "matched") continue;  // an engine may brake its bodies unless told otherwise
    if (!rows.at(c.at("engine")).at("scheme").get<std::string>().starts_with("semi-implicit Euler")) continue;
    ASSERT_TRUE(c.at("order").is_number()) << c;
    EXPECT_NEAR(c.at("order").get<double>(), 1.0, 0.02) << c;
    ++checked;
  }
  EXPECT_GE(checked, 2);
}

TEST(Catalogue, PlanarEnginesSayThatTheyRanTheProjection) {
  const auto rows = engines();
  for (const json& run : results().at("runs")) {
    if (run.at("scenario") != "particle/falling_box") continue;
    const bool planar = rows.at(run.at("engine")).at("dimension") == 2;
    EXPECT_EQ(!run.at("notes").empty(), planar) << run.at("engine");
    if (planar) {
      EXPECT_TRUE(run.at("notes")[0].get<std::string>().starts_with("planar projection"));
    }
  }
}

TEST(Catalogue, EveryRunShowsItsSettingsAndItsTrajectory) {
  const auto rows = engines();
  for (const json& run : results().at("runs")) {
    EXPECT_EQ(run.at("settings").size(), rows.at(run.at("engine")).at("settings").size()) << run.at("engine");
    if (run.at("verdict") == "unsupported") continue;
    const std::string file = run.at("trajectory");
    EXPECT_TRUE(std::filesystem::exists(PLUMBLINE_RESULTS "/" + file)) << file;
  }
}

TEST(Catalogue, ThePageIsThere) {
  EXPECT_GT(std::filesystem::file_size(PLUMBLINE_RESULTS "/report.html"), 10'000u);
  // A run brings a row of a table, a curve and its cells in the matrices of who agrees with whom: some kilobytes.
  EXPECT_LT(std::filesystem::file_size(PLUMBLINE_RESULTS "/report.html"), 3'000 * results().at("runs").size());
}

}  // namespace
}  // namespace plumbline
