// Lying, drifting, dying engines: each must get its verdict, and the rest of the campaign must not notice.
#include "plumbline/harness/campaign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "free_flight.hpp"

namespace plumbline {
namespace {

using testing_support::free_flight;

class CampaignTest : public ::testing::Test {
 protected:
  Report campaign(const std::vector<std::string>& names, CampaignOptions options = {}, std::size_t stop_after = 1000) {
    std::vector<EngineRow> rows;
    std::vector<EngineInfo> infos;
    for (const std::string& name : names) {
      for (const EngineInfo& info : pool_.programs()[0].engines) {
        if (info.name != name) continue;
        rows.push_back({info, 0, deviations_});
        infos.push_back(info);
      }
    }
    EXPECT_EQ(rows.size(), names.size());
    const auto plan =
        plan_runs(cases_, infos, {Profile::kMatched}, Tier::kFull, [](const std::string&) { return true; });
    std::atomic<bool> stop = false;
    std::size_t finished = 0;
    CampaignObserver observer;
    observer.finished = [&](RunResult&, const Trajectory&) { stop = ++finished >= stop_after; };
    Report report;
    run_campaign(cases_, rows, plan, pool_, options, observer, stop, report);
    return report;
  }

  static RunResult result(const Report& report, const std::string& engine, double dt) {
    const auto found = std::find_if(report.runs.begin(), report.runs.end(),
                                    [&](const RunResult& r) { return r.engine == engine && r.dt == dt; });
    return found == report.runs.end() ? RunResult{} : *found;
  }

  Deviation deviation(const std::string& engine, double limit) {
    Deviation d;
    d.engines = {engine};
    d.scenario = "test/free_flight";
    d.metric = "position.max";
    d.limit = limit;
    d.why = "it lies by one percent";
    return d;
  }

  std::vector<CaseInput> cases_ = {free_flight()};
  WorkerPool pool_{{PLUMBLINE_FAKE_WORKER}};
  std::vector<Deviation> deviations_;
};

TEST_F(CampaignTest, GivesEveryMisbehaviourItsVerdict) {
  CampaignOptions options;
  options.jobs = 2;
  options.limit = WorkerPool::Seconds(1);
  const Report report = campaign({"fake-honest", "fake-aborts", "fake-hangs", "fake-nan", "fake-throws", "fake-lies",
                                  "fake-gains-energy", "fake-chatty"},
                                 options);
  EXPECT_EQ(report.runs.size(), 8u * 3u);
  const std::pair<const char*, Verdict> expected[] = {
      {"fake-honest", Verdict::kPass},       {"fake-aborts", Verdict::kCrashed}, {"fake-hangs", Verdict::kTimedOut},
      {"fake-nan", Verdict::kDiverged},      {"fake-throws", Verdict::kError},   {"fake-lies", Verdict::kFail},
      {"fake-gains-energy", Verdict::kFail}, {"fake-chatty", Verdict::kPass}};
  for (const auto& [engine, verdict] : expected) {
    const RunResult run = result(report, engine, 0.001);
    EXPECT_EQ(run.verdict, verdict) << engine << ": " << verdict_name(run.verdict) << ", " << run.reason;
    EXPECT_EQ(run.reason.empty(), verdict == Verdict::kPass) << engine << ": " << run.reason;
  }
  EXPECT_TRUE(std::isnan(result(report, "fake-nan", 0.001).metric("position.max")));
}

TEST_F(CampaignTest, ExpectsTheEndingsThatAreListedAndNoOthers) {
  const std::pair<const char*, Verdict> listed[] = {{"fake-aborts", Verdict::kCrashed},
                                                    {"fake-nan", Verdict::kDiverged},
                                                    {"fake-throws", Verdict::kError},
                                                    {"fake-honest", Verdict::kError},
                                                    {"fake-chatty", Verdict::kTimedOut}};
  for (const auto& [engine, ends] : listed) {
    Deviation d = deviation(engine, 0);
    d.metric.clear();
    d.ends = ends;
    deviations_.push_back(d);
  }
  const Report report = campaign({"fake-honest", "fake-aborts", "fake-nan", "fake-throws", "fake-chatty"});
  for (const char* engine : {"fake-aborts", "fake-nan", "fake-throws"}) {
    const RunResult run = result(report, engine, 0.001);
    EXPECT_EQ(run.verdict, Verdict::kExpectedFail) << engine << ": " << run.reason;
    EXPECT_EQ(run.reason, "it lies by one percent");
  }
  EXPECT_EQ(result(report, "fake-honest", 0.001).verdict, Verdict::kUnexpectedPass);
  EXPECT_EQ(result(report, "fake-chatty", 0.001).verdict, Verdict::kPass) << "in time here, too late elsewhere";
}

TEST_F(CampaignTest, AnEndingThatIsNotTheListedOneIsNoExcuse) {
  Deviation d = deviation("fake-throws", 0);
  d.metric.clear();
  d.ends = Verdict::kCrashed;
  deviations_ = {d};
  EXPECT_EQ(result(campaign({"fake-throws"}), "fake-throws", 0.001).verdict, Verdict::kError);
}

TEST_F(CampaignTest, ExplainsAnHonestErrorByItsScheme) {
  const Report report = campaign({"fake-honest"});
  const RunResult run = result(report, "fake-honest", 0.001);
  // Semi-implicit Euler is g t dt/2 low after t = 1 s; summing 1000 steps rounds by far less than 1e-12.
  EXPECT_NEAR(run.metric("position.max"), 9.81 * 0.001 / 2, 1e-12);
  EXPECT_EQ(run.explanation.scheme.find("semi-implicit Euler"), 0u) << run.explanation.scheme;
  EXPECT_LT(run.explanation.distance, 1e-12);
  EXPECT_GT(run.explanation.share, 0.999999);
}

TEST_F(CampaignTest, DoesNotExplainALie) {
  const RunResult run = result(campaign({"fake-lies"}), "fake-lies", 0.001);
  EXPECT_LT(run.explanation.share, 0.5);
}

TEST_F(CampaignTest, FindsTheOrderOfAnHonestEngine) {
  const Report report = campaign({"fake-honest"});
  const auto found = std::find_if(report.convergence.begin(), report.convergence.end(),
                                  [](const Convergence& c) { return c.metric == "position.max"; });
  ASSERT_NE(found, report.convergence.end());
  EXPECT_NEAR(found->order, 1.0, 1e-6);
  EXPECT_EQ(found->points, 3u);
}

TEST_F(CampaignTest, MeasuresWhoDisagreesWithWhom) {
  const Report report = campaign({"fake-honest", "fake-chatty", "fake-lies"});
  ASSERT_EQ(report.divergence.size(), 3u);  // one matrix per dt
  const Divergence& d = report.divergence[0];
  ASSERT_EQ(d.engines.size(), 3u);
  EXPECT_EQ(d.distance[0 * 3 + 1], 0.0) << "two engines that do the same";
  EXPECT_GT(d.distance[0 * 3 + 2], 0.04) << "one percent of some five metres";
  EXPECT_EQ(d.distance[0 * 3 + 2], d.distance[2 * 3 + 0]);
}

TEST_F(CampaignTest, RepetitionsMustGiveTheSameBits) {
  CampaignOptions options;
  options.repeat = 3;
  const Report report = campaign({"fake-honest", "fake-random"}, options);
  EXPECT_EQ(result(report, "fake-honest", 0.001).verdict, Verdict::kPass);
  const RunResult run = result(report, "fake-random", 0.001);
  EXPECT_EQ(run.verdict, Verdict::kNondeterministic);
  EXPECT_NE(run.reason.find("step 3"), std::string::npos) << run.reason;
}

TEST_F(CampaignTest, AKnownDeviationIsExpectedToFail) {
  deviations_ = {deviation("fake-lies", 0.2)};
  const RunResult run = result(campaign({"fake-lies"}), "fake-lies", 0.001);
  EXPECT_EQ(run.verdict, Verdict::kExpectedFail);
  EXPECT_EQ(run.reason, "it lies by one percent");
}

TEST_F(CampaignTest, ADeviationThatGrewFails) {
  deviations_ = {deviation("fake-lies", 0.01)};
  EXPECT_EQ(result(campaign({"fake-lies"}), "fake-lies", 0.001).verdict, Verdict::kFail);
}

TEST_F(CampaignTest, ADeviationThatIsGoneIsAnUnexpectedPass) {
  deviations_ = {deviation("fake-honest", 0.2)};
  EXPECT_EQ(result(campaign({"fake-honest"}), "fake-honest", 0.001).verdict, Verdict::kUnexpectedPass);
}

TEST_F(CampaignTest, ADeviationMayBeGoneForParametersItWasNotMadeFor) {
  deviations_ = {deviation("fake-honest", 0.2)};
  CampaignOptions options;
  options.deviations_must_apply = false;
  EXPECT_EQ(result(campaign({"fake-honest"}, options), "fake-honest", 0.001).verdict, Verdict::kPass);
}

TEST_F(CampaignTest, ADeviationDoesNotExcuseNaN) {
  deviations_ = {deviation("fake-nan", std::numeric_limits<double>::infinity())};
  EXPECT_EQ(result(campaign({"fake-nan"}), "fake-nan", 0.001).verdict, Verdict::kDiverged);
}

TEST_F(CampaignTest, WhatAnEngineCannotDoIsUnsupportedAndNamed) {
  cases_[0].scenario.bodies.push_back(cases_[0].scenario.bodies[0]);
  cases_[0].scenario.contact = ContactMaterial{0.5, 0.2};
  const Report report = campaign({"fake-honest"});
  for (const RunResult& run : report.runs) {
    EXPECT_EQ(run.verdict, Verdict::kUnsupported);
    EXPECT_EQ(run.reason, "the engine has no contact of a sphere with a sphere, restitution, friction");
  }
}

TEST_F(CampaignTest, KeepsWhatItHadWhenInterrupted) {
  CampaignOptions options;
  options.jobs = 1;
  const Report report = campaign({"fake-honest", "fake-chatty", "fake-lies"}, options, 4);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(report.runs.size(), 4u);
}

}  // namespace
}  // namespace plumbline
