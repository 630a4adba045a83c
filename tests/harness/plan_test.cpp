#include "plumbline/harness/plan.hpp"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

CaseInput case_of(const std::string& id, Tier tier) {
  CaseInput input;
  input.scenario.id = id;
  input.scenario.tier = tier;
  input.scenario.steps = {0.02, 0.01};
  return input;
}

std::vector<std::string> names(Tier tier) {
  const std::vector<CaseInput> cases = {case_of("a/quick", Tier::kSmoke), case_of("a/usual", Tier::kStandard),
                                        case_of("a/long", Tier::kFull)};
  EngineInfo engine;
  engine.name = "one";
  std::vector<std::string> result;
  for (const PlannedRun& run :
       plan_runs(cases, {engine}, {Profile::kMatched}, tier, [](const std::string&) { return true; })) {
    result.push_back(cases[run.case_index].scenario.id + " " + shortest(run.dt));
  }
  return result;
}

TEST(Plan, SmokeTakesOneStepOfTheQuickCases) {
  EXPECT_EQ(names(Tier::kSmoke), std::vector<std::string>{"a/quick 0.02"});
}

TEST(Plan, EveryTierHoldsTheOnesBefore) {
  const std::vector<std::string> standard = {"a/quick 0.02", "a/quick 0.01", "a/usual 0.02", "a/usual 0.01"};
  EXPECT_EQ(names(Tier::kStandard), standard);
  std::vector<std::string> full = standard;
  full.insert(full.end(), {"a/long 0.02", "a/long 0.01"});
  EXPECT_EQ(names(Tier::kFull), full);
}

}  // namespace
}  // namespace plumbline
