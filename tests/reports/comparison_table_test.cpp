#include "plumbline/reports/comparison_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "approved.hpp"

namespace plumbline {
namespace {

using Kind = RunChange::Kind;

std::string printed(const std::vector<RunChange>& changes, bool color) {
  std::ostringstream out;
  print_changes(changes, {color, false, 100}, out);
  return std::move(out).str();
}

std::vector<RunChange> changes() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto change = [](const char* engine, Kind kind, Verdict before, Verdict after, double a, double b) {
    return RunChange{
        "particle/falling_box", engine, Profile::kMatched, 1.0 / 60, kind, before, after, "position.max", a, b};
  };
  RunChange verdict_only = change("zeta", Kind::kChanged, Verdict::kCrashed, Verdict::kTimedOut, nan, nan);
  verdict_only.metric.clear();
  return {change("alpha", Kind::kSame, Verdict::kPass, Verdict::kPass, 0.1, 0.1),
          change("beta", Kind::kBetter, Verdict::kFail, Verdict::kPass, 0.5, 0.1),
          change("gamma", Kind::kWorse, Verdict::kPass, Verdict::kPass, 0.1, 0.2),
          change("delta", Kind::kWorse, Verdict::kPass, Verdict::kDiverged, 0.1, nan),
          change("epsilon", Kind::kWorse, Verdict::kPass, Verdict::kFail, 0, 1e-3),
          verdict_only,
          change("eta", Kind::kAdded, Verdict::kError, Verdict::kPass, nan, 0.25),
          change("theta", Kind::kRemoved, Verdict::kPass, Verdict::kError, 0.25, nan)};
}

TEST(ComparisonTable, PlainIsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(printed(changes(), false), "changes_plain.txt"));
}

TEST(ComparisonTable, ColouredIsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(printed(changes(), true), "changes_color.txt"));
}

TEST(ComparisonTable, WorseRunsComeFirstTheFarthestOnTop) {
  const std::string text = printed(changes(), false);
  EXPECT_LT(text.find("delta"), text.find("gamma"));    // nan is worse than twice as far
  EXPECT_LT(text.find("epsilon"), text.find("gamma"));  // from nothing to something is farther than twice
  EXPECT_LT(text.find("gamma"), text.find("beta"));
  EXPECT_EQ(text.find("alpha"), std::string::npos);  // the same: only counted
}

TEST(ComparisonTable, NothingToTellIsSaidInWords) {
  EXPECT_EQ(printed({}, false), "Nothing to compare: neither file holds a run.\n");
  EXPECT_EQ(printed({changes().front()}, false), "1 run: 1 the same\n");
}

}  // namespace
}  // namespace plumbline
