#include "plumbline/harness/change.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline {
namespace {

using Kind = RunChange::Kind;

Report report_with(Verdict verdict, double value, const std::string& engine = "row") {
  RunResult run;
  run.case_name = "family/case";
  run.engine = engine;
  run.dt = 0.01;
  run.verdict = verdict;
  run.metrics = {{"position.max", value}, {"velocity.max", 1.0}};
  run.gates = {{"position.max", value, 0.1, value <= 0.1, "reason", "", {}}};
  Report report;
  report.runs = {run};
  return report;
}

Kind kind(const Report& before, const Report& after) { return changes(before, after, 0.01).at(0).kind; }

TEST(Changes, JudgesTheVerdictFirst) {
  EXPECT_EQ(kind(report_with(Verdict::kPass, 0.05), report_with(Verdict::kFail, 0.2)), Kind::kWorse);
  EXPECT_EQ(kind(report_with(Verdict::kCrashed, 0.05), report_with(Verdict::kFail, 0.2)), Kind::kBetter);
  EXPECT_EQ(kind(report_with(Verdict::kFail, 0.2), report_with(Verdict::kNondeterministic, 0.2)), Kind::kChanged);
}

TEST(Changes, JudgesGatedMetricsByTheirRatio) {
  EXPECT_EQ(kind(report_with(Verdict::kPass, 0.05), report_with(Verdict::kPass, 0.0504)), Kind::kSame);
  EXPECT_EQ(kind(report_with(Verdict::kPass, 0.05), report_with(Verdict::kPass, 0.051)), Kind::kWorse);
  EXPECT_EQ(kind(report_with(Verdict::kPass, 0.05), report_with(Verdict::kPass, 0.04)), Kind::kBetter);
  EXPECT_EQ(kind(report_with(Verdict::kPass, 0.05), report_with(Verdict::kPass, std::nan(""))), Kind::kWorse);
  EXPECT_EQ(kind(report_with(Verdict::kPass, 1e-16), report_with(Verdict::kPass, 5e-16)), Kind::kSame)
      << "rounding noise far below the limit is not judged";
  EXPECT_EQ(kind(report_with(Verdict::kPass, 0), report_with(Verdict::kPass, 0.05)), Kind::kWorse);
}

TEST(Changes, NamesRunsThatCameAndWentAndPutsTheWorstFirst) {
  Report before = report_with(Verdict::kPass, 0.05, "a");
  Report after = report_with(Verdict::kFail, 0.2, "a");
  before.runs.push_back(report_with(Verdict::kPass, 0.05, "gone").runs[0]);
  after.runs.push_back(report_with(Verdict::kPass, 0.05, "new").runs[0]);
  const auto found = changes(before, after);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].kind, Kind::kWorse);
  EXPECT_EQ(found[0].metric, "position.max");
  EXPECT_EQ(found[1].kind, Kind::kRemoved);
  EXPECT_EQ(found[2].kind, Kind::kAdded);
}

}  // namespace
}  // namespace plumbline
