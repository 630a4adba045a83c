// The kit must be able to fail: every lie is caught by the check that was made for it, every check catches one.
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <set>

#include "lying_engine.hpp"
#include "plumbline/harness/conformance.hpp"

namespace plumbline {
namespace {

using testing_support::Lie;
using Kind = ConformanceAnswer::Kind;

ConformanceAnswer ask_liar(const Lie& lie, const std::string& check, Profile profile) {
  const auto engine = testing_support::lying_engine(lie);
  return ask(check, *engine, profile, [&](const Engine& e, const Scenario& s, const Settings& settings) {
    return testing_support::build_lying(lie, e, s, settings);
  });
}

void expect_honest(const Lie& lie, const std::set<std::string>& may_lack) {
  for (const ConformanceCheck& check : conformance_checks()) {
    for (Profile profile : {Profile::kDefault, Profile::kMatched}) {
      if (check.matched_only && profile != Profile::kMatched) continue;
      const ConformanceAnswer answer = ask_liar(lie, check.name, profile);
      EXPECT_TRUE(answer.kind == Kind::kHolds || (answer.kind == Kind::kNotAsked && may_lack.contains(check.name)))
          << lie.name << ", " << profile_name(profile) << ", " << check.name << ": " << answer.text;
    }
  }
}

TEST(ConformanceKit, AnHonestEngineHoldsEverything) { expect_honest(testing_support::honest(), {}); }

TEST(ConformanceKit, AnHonestPlanarEngineHoldsAllThatIsAskedInThePlane) {
  expect_honest(
      testing_support::honest_in_the_plane(),
      {"inertia_turns_with_the_body", "angular_velocity_is_in_world_axes", "free_body_keeps_its_angular_momentum",
       "friction_is_a_cone", "axis_may_be_oblique", "stops_of_an_oblique_axis", "cylinder_rests_on_its_end"});
}

TEST(ConformanceKit, WhatARowLacksIsNotAskedAndNamed) {
  Lie bare = testing_support::honest();
  bare.describe = [](EngineInfo& info) { info.features = {}; };
  const ConformanceAnswer joints = ask_liar(bare, "joints_keep_momentum", Profile::kMatched);
  EXPECT_EQ(joints.kind, Kind::kNotAsked);
  EXPECT_NE(joints.text.find("joints"), std::string::npos) << joints.text;
  const ConformanceAnswer hinge = ask_liar(bare, "hinge_moves_as_stated", Profile::kMatched);
  EXPECT_EQ(hinge.kind, Kind::kNotAsked);
  EXPECT_EQ(hinge.text, "the engine has no external forces");
  EXPECT_EQ(ask_liar(bare, "same_run_same_bits", Profile::kDefault).kind, Kind::kHolds);
}

TEST(ConformanceKit, ACheckThatDoesNotExistIsRefused) {
  EXPECT_THROW(ask_liar(testing_support::honest(), "no_such_check", Profile::kDefault), std::invalid_argument);
}

class ConformanceLie : public ::testing::TestWithParam<std::size_t> {};

// A check that ends with an exception says so too: through a worker it is an error.
TEST_P(ConformanceLie, IsCaught) {
  const Lie& lie = testing_support::lies()[GetParam()];
  ASSERT_FALSE(lie.caught_by.empty()) << lie.name;
  for (const std::string& check : lie.caught_by) {
    try {
      const ConformanceAnswer answer = ask_liar(lie, check, Profile::kMatched);
      EXPECT_EQ(answer.kind, Kind::kBroken) << "an engine that " << lie.name << " passes " << check;
      EXPECT_FALSE(answer.text.empty());
    } catch (const std::exception& error) {
      ADD_FAILURE() << "an engine that " << lie.name << " ends " << check << " with: " << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, ConformanceLie, ::testing::Range(std::size_t{0}, testing_support::lies().size()),
                         [](const auto& lie) {
                           std::string name = testing_support::lies()[lie.param].name;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

TEST(ConformanceKit, EveryCheckCatchesALie) {
  std::set<std::string> catching;
  for (const Lie& lie : testing_support::lies()) catching.insert(lie.caught_by.begin(), lie.caught_by.end());
  for (const ConformanceCheck& check : conformance_checks()) {
    EXPECT_TRUE(catching.contains(check.name)) << "nothing proves that " << check.name << " can fail";
    catching.erase(check.name);
  }
  for (const std::string& name : catching) ADD_FAILURE() << "there is no check " << name;
}

TEST(ConformanceKit, ItsPageListsEveryCheckWithQuestionAndTolerance) {
  std::ifstream file(PLUMBLINE_SOURCE_DIR "/docs/conformance.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  std::size_t rows = 0;
  for (const ConformanceCheck& check : conformance_checks()) {
    const std::string row = "| `" + check.name + "` | " + check.question +
                            (check.matched_only ? " (matched only)" : "") + " | " +
                            (check.tolerance.empty() ? "exact" : check.tolerance) + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << "docs/conformance.md lacks this row:\n" << row;
  }
  for (std::size_t at = 0; (at = page.find("\n| `", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, conformance_checks().size()) << "docs/conformance.md lists checks that are gone";
}

}  // namespace
}  // namespace plumbline
