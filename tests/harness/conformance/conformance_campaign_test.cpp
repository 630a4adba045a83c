// The kit through real workers that crash, hang and throw, held against a list.
#include "plumbline/harness/conformance_campaign.hpp"

#include <gtest/gtest.h>

#include <map>

namespace plumbline {
namespace {

constexpr const char* kGravity = "gravity_pulls_where_it_is_stated";

class ConformanceCampaign : public ::testing::Test {
 protected:
  // The matched profile's answers to one check, by engine.
  std::map<std::string, ConformanceResult> ask_all(const std::vector<std::string>& names, const std::string& check,
                                                   const std::vector<KnownFailure>& known = {}) {
    std::vector<EngineRow> rows;
    for (const EngineInfo& info : pool_.programs()[0].engines) {
      if (std::find(names.begin(), names.end(), info.name) != names.end()) rows.push_back({info, 0, {}, known});
    }
    EXPECT_EQ(rows.size(), names.size());
    Report report;
    ConformanceOptions options;
    options.profiles = {Profile::kMatched};
    options.selected = [&](const std::string& name) { return name == check; };
    options.limit = WorkerPool::Seconds(1);
    std::size_t told = 0;
    run_conformance(
        rows, pool_, options,
        [&](std::size_t, std::size_t total, const ConformanceResult&) {
          EXPECT_EQ(total, names.size());
          ++told;
        },
        stop_, report);
    EXPECT_EQ(told, names.size());
    EXPECT_EQ(report.conformance_checks.size(), 1u);
    std::map<std::string, ConformanceResult> results;
    for (const ConformanceResult& r : report.conformance) results[r.engine] = r;
    return results;
  }

  WorkerPool pool_{{PLUMBLINE_FAKE_WORKER}};
  std::atomic<bool> stop_ = false;
};

TEST_F(ConformanceCampaign, EveryEndHasItsVerdict) {
  auto results =
      ask_all({"fake-honest", "fake-aborts", "fake-hangs", "fake-throws", "fake-nan", "fake-chatty"}, kGravity);
  EXPECT_EQ(results["fake-honest"].verdict, Verdict::kPass) << results["fake-honest"].text;
  EXPECT_EQ(results["fake-aborts"].verdict, Verdict::kCrashed);
  EXPECT_EQ(results["fake-aborts"].text, "killed by signal 6 (Aborted)");
  EXPECT_EQ(results["fake-hangs"].verdict, Verdict::kTimedOut);
  EXPECT_EQ(results["fake-throws"].verdict, Verdict::kError);
  EXPECT_EQ(results["fake-throws"].text, "the solver lost its matrix");
  EXPECT_EQ(results["fake-nan"].verdict, Verdict::kFail);
  EXPECT_EQ(results["fake-chatty"].messages, "") << "what a passing engine prints is not kept";
}

TEST_F(ConformanceCampaign, WhatIsListedIsExpectedACrashTooAndNothingElse) {
  const std::vector<KnownFailure> known = {{{}, kGravity, Profile::kMatched, "the cause", "a link", {}}};
  auto results = ask_all({"fake-honest", "fake-aborts"}, kGravity, known);
  EXPECT_EQ(results["fake-honest"].verdict, Verdict::kUnexpectedPass);
  EXPECT_EQ(results["fake-aborts"].verdict, Verdict::kExpectedFail);
  EXPECT_EQ(results["fake-aborts"].why, "the cause (a link)");
  EXPECT_EQ(results["fake-aborts"].text, "killed by signal 6 (Aborted)");
  // Lists for another profile or row do not apply, and what is not asked stays so.
  const KnownFailure other_profile{{}, kGravity, Profile::kDefault, "the cause", "", {}};
  const KnownFailure other_row{{"fake-aborts"}, kGravity, {}, "the cause", "", {}};
  EXPECT_EQ(ask_all({"fake-honest"}, kGravity, {other_profile, other_row})["fake-honest"].verdict, Verdict::kPass);
  const KnownFailure joints{{}, "hinge_moves_as_stated", {}, "the cause", "", {}};
  const auto lacking = ask_all({"fake-honest"}, "hinge_moves_as_stated", {joints})["fake-honest"];
  EXPECT_EQ(lacking.verdict, Verdict::kUnsupported);
  EXPECT_EQ(lacking.text, "the engine has no hinges");
}

TEST_F(ConformanceCampaign, StopsWhenAsked) {
  stop_ = true;
  Report report;
  run_conformance({{pool_.programs()[0].engines[0], 0, {}, {}}}, pool_, {}, nullptr, stop_, report);
  EXPECT_TRUE(report.conformance.empty());
  EXPECT_TRUE(report.interrupted);
}

}  // namespace
}  // namespace plumbline
