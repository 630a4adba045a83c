// What there is to run: the cases of the scenario files and the engines of the workers.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "installation.hpp"
#include "plumbline/core/run_result.hpp"
#include "plumbline/harness/campaign.hpp"
#include "plumbline/harness/plan.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {

struct ScenarioInventory {
  std::vector<CaseInput> cases;
  std::vector<ScenarioSummary> summaries;  // one per file
};

// Reads all files named or found below the folders named; without any, the catalogue of the installation. Every
// broken file is reported before the one UsageError is thrown that stops the program; but a file that is only broken
// by the overrides is left out when none of its cases is wanted: -P e=1 was meant for others.
ScenarioInventory load_scenarios(const Installation& installation, const std::vector<std::string>& paths,
                                 const Overrides& overrides, const std::function<bool(const Scenario&)>& wanted);

struct EngineInventory {
  std::unique_ptr<WorkerPool> pool;
  std::vector<EngineRow> rows;
  std::vector<MissingEngine> missing;
};

// Starts every worker once and asks it for its engines. Throws UsageError for a broken list of deviations.
EngineInventory load_engines(const Installation& installation);

// Keeps the rows that one of the selectors names (all for none). Throws UsageError for a selector that names none.
void select_engines(EngineInventory& engines, const std::vector<std::string>& selectors);

}  // namespace plumbline
