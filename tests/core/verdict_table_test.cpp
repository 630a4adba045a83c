#include <gtest/gtest.h>

#include <set>

#include "plumbline/core/run_result.hpp"
#include "plumbline/core/verdict.hpp"

namespace plumbline {
namespace {

TEST(VerdictTable, HasARowPerVerdictInTheOrderOfTheEnum) {
  static_assert(static_cast<std::size_t>(Verdict::kError) + 1 == kVerdictCount, "kError is the last verdict");
  for (std::size_t k = 0; k < kVerdictCount; ++k) {
    EXPECT_EQ(verdict_table()[k].verdict, static_cast<Verdict>(k)) << k;
    EXPECT_FALSE(verdict_table()[k].meaning.empty()) << k;
  }
}

TEST(VerdictTable, NamesAndMarksAreUniqueAndReadBack) {
  std::set<std::string_view> names;
  std::set<char> marks;
  for (const VerdictRow& row : verdict_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(marks.insert(row.mark).second) << row.mark;
    EXPECT_EQ(verdict_named(row.name), row.verdict);
    EXPECT_EQ(verdict_name(row.verdict), row.name);
    EXPECT_EQ(&row_of(row.verdict), &row);
  }
  EXPECT_EQ(verdict_named("passed"), std::nullopt);
}

TEST(VerdictTable, WhatBreaksTheBuildIsWorseThanWhatDoesNot) {
  for (const VerdictRow& bad : verdict_table()) {
    for (const VerdictRow& good : verdict_table()) {
      if (bad.breaks_build && !good.breaks_build) {
        EXPECT_GT(bad.badness, good.badness) << bad.name << " " << good.name;
      }
    }
    if (bad.infrastructure) {
      EXPECT_TRUE(bad.breaks_build) << bad.name;
    }
  }
  EXPECT_FALSE(row_of(Verdict::kPass).breaks_build);
  EXPECT_TRUE(row_of(Verdict::kUnexpectedPass).breaks_build);
}

TEST(RunResult, AMetricThatWasNotMeasuredIsNan) {
  RunResult run;
  run.metrics = {{"position.max", 0.5}};
  EXPECT_EQ(run.metric("position.max"), 0.5);
  EXPECT_FALSE(within(run.metric("velocity.max"), 1e300));
}

}  // namespace
}  // namespace plumbline
