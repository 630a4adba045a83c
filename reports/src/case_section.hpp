// The flat lists of a report, grouped the way people read them: case, then engine and profile, then dt.
#pragma once

#include <string>
#include <vector>

#include "plumbline/core/run_result.hpp"
#include "plumbline/reports/progress.hpp"

namespace plumbline::reports {

// One engine and profile over every dt of a case.
struct CaseRow {
  std::string engine;
  Profile profile = Profile::kDefault;
  std::vector<const RunResult*> runs;        // parallel to CaseSection::steps; nullptr: not run
  const Convergence* convergence = nullptr;  // of position.max

  std::string name() const { return engine + "." + std::string(profile_name(profile)); }
};

// Pointers reach into the report, which must outlive the section.
struct CaseSection {
  std::string case_name;
  const ScenarioSummary* scenario = nullptr;
  std::vector<double> steps;  // largest first [s]
  std::vector<CaseRow> rows;  // every engine of the report under every profile that was run, worst first
  std::vector<const Divergence*> divergence;
};

// Worst case first.
std::vector<CaseSection> case_sections(const Report& report);

// The run that a row is summarised by: the worst verdict, then the largest position error; nullptr: nothing was run.
const RunResult* worst_run(const CaseRow& row);

// Whether a is worse than b: by verdict, then by position.max, NaN being the largest.
bool is_worse(const RunResult& a, const RunResult& b);

// The pair of engines that are farthest apart.
struct WidestPair {
  const Divergence* where = nullptr;
  std::string a, b;
  double distance = 0;  // [m]
};
WidestPair widest_pair(const CaseSection& section);

VerdictCounts count_verdicts(const Report& report);

}  // namespace plumbline::reports
