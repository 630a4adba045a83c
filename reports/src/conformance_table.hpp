// The results of the conformance kit as a table: a row a check, a column an engine and profile.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "plumbline/core/run_result.hpp"
#include "plumbline/reports/progress.hpp"

namespace plumbline::reports {

struct ConformanceTable {
  explicit ConformanceTable(const Report& report);

  // nullptr: not asked of that engine under that profile.
  const ConformanceResult* find(const std::string& engine, Profile profile, const std::string& check) const;

  std::vector<std::string> engines;  // that answered anything, in the report's order
  std::vector<Profile> profiles;     // that anything was asked of
  std::vector<ConformanceCheck> checks;
  VerdictCounts counts{};
  std::vector<const ConformanceResult*> failures;  // known or not, worst first

 private:
  std::map<std::tuple<std::string, Profile, std::string>, const ConformanceResult*> by_place_;
};

// The verdicts that occur, worst first.
std::vector<VerdictRow> counted_verdicts(const VerdictCounts& counts);

// What a verdict says of a check.
std::string_view conformance_meaning(Verdict verdict);

}  // namespace plumbline::reports
