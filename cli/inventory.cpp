#include "inventory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "deviation_file.hpp"
#include "selection.hpp"
#include "usage_error.hpp"

namespace plumbline {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> scenario_files(const Installation& installation, const std::vector<std::string>& paths) {
  std::vector<fs::path> files;
  if (paths.empty()) return find_scenario_files(installation.scenarios);
  for (const std::string& path : paths) {
    if (fs::is_directory(path)) {
      const auto found = find_scenario_files(path);
      if (found.empty()) throw UsageError(fmt::format("{}: no scenario file (*.toml) in this folder", path));
      files.insert(files.end(), found.begin(), found.end());
    } else if (fs::exists(path)) {
      files.emplace_back(path);
    } else {
      throw UsageError(
          fmt::format("{}: no such file or folder; `plumbline list` shows the built-in scenarios, --filter "
                      "selects among them",
                      path));
    }
  }
  return files;
}

std::string file_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw UsageError(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

ScenarioSummary summary_of(const std::vector<Case>& cases, const fs::path& file) {
  const Scenario& first = cases.front().scenario;
  const Reference& reference = *cases.front().reference;
  ScenarioSummary summary{first.id,
                          first.about,
                          first.source,
                          file.filename().string(),
                          std::string(reference.kind()),
                          std::string(reference.citation()),
                          {},
                          first.steps};
  for (const Case& c : cases) summary.cases.push_back(c.scenario.case_name());
  return summary;
}

void refuse_unknown_parameters(const Overrides& overrides, const std::set<std::string>& known) {
  for (const auto& [name, values] : overrides) {
    if (known.contains(name)) continue;
    throw UsageError(fmt::format("-P {}: no selected scenario has such a parameter; they have {}", name,
                                 joined({known.begin(), known.end()})));
  }
}

// Whether a file is sound by itself and has no case that is wanted.
bool sound_but_not_wanted(const fs::path& file, const std::function<bool(const Scenario&)>& wanted) {
  try {
    const auto cases = read_scenario_file(file);
    return std::none_of(cases.begin(), cases.end(), [&](const Case& c) { return wanted(c.scenario); });
  } catch (const ScenarioError&) {
    return false;
  }
}

}  // namespace

ScenarioInventory load_scenarios(const Installation& installation, const std::vector<std::string>& paths,
                                 const Overrides& overrides, const std::function<bool(const Scenario&)>& wanted) {
  ScenarioInventory inventory;
  std::vector<std::string> problems;
  std::set<std::string> parameters, names;
  for (const fs::path& file : scenario_files(installation, paths)) {
    try {
      const auto text = std::make_shared<const std::string>(file_text(file));
      const auto cases = read_scenario_file(file, overrides);
      inventory.summaries.push_back(summary_of(cases, file));
      for (const Case& c : cases) {
        for (const auto& [name, value] : c.scenario.parameters) parameters.insert(name);
        if (!names.insert(c.scenario.case_name()).second) {
          throw ScenarioError(
              fmt::format("{}: the case {} exists already in another file; give this one an id of its "
                          "own",
                          file.string(), c.scenario.case_name()));
        }
        inventory.cases.push_back({c.scenario, c.reference, text, file.string()});
      }
    } catch (const ScenarioError& e) {
      if (!sound_but_not_wanted(file, wanted)) problems.emplace_back(e.what());
    }
  }
  if (!problems.empty()) throw UsageError(fmt::format("{}", fmt::join(problems, "\nerror: ")));
  refuse_unknown_parameters(overrides, parameters);
  return inventory;
}

EngineInventory load_engines(const Installation& installation) {
  EngineInventory engines;
  engines.pool = std::make_unique<WorkerPool>(installation.workers);
  std::set<std::string> names;
  for (std::size_t p = 0; p < engines.pool->programs().size(); ++p) {
    const WorkerProgram& program = engines.pool->programs()[p];
    if (!program.problem.empty()) {
      engines.missing.push_back({program.path.filename().string(), program.problem});
      continue;
    }
    const DeviationLists listed = read_deviations(program.path.string() + ".deviations.toml");
    for (const EngineInfo& info : program.engines) {
      // The first on the path wins, as with programs: an engine under test can stand in for the installed one.
      if (names.insert(info.name).second) engines.rows.push_back({info, p, listed.deviations, listed.known_failures});
    }
  }
  for (const LeftOutEngine& left_out : installation.left_out) {
    engines.missing.push_back({left_out.name, fmt::format("its library was not found when Plumbline was built; "
                                                          "apt-get install {}, then build again",
                                                          left_out.package)});
  }
  // The same order everywhere: by name, the in-house core like any other.
  std::sort(engines.rows.begin(), engines.rows.end(),
            [](const EngineRow& a, const EngineRow& b) { return a.info.name < b.info.name; });
  return engines;
}

void select_engines(EngineInventory& engines, const std::vector<std::string>& selectors) {
  if (selectors.empty()) return;
  for (const std::string& selector : selectors) {
    const bool names_one = std::any_of(engines.rows.begin(), engines.rows.end(),
                                       [&](const EngineRow& row) { return selects_engine(selector, row.info.name); });
    if (names_one) continue;
    for (const MissingEngine& missing : engines.missing) {
      if (missing.name.find(selector) != std::string::npos) {
        throw UsageError(fmt::format("engine '{}' is not available: {}", selector, missing.reason));
      }
    }
    std::vector<std::string> names;
    for (const EngineRow& row : engines.rows) names.push_back(row.info.name);
    throw UsageError(fmt::format("no engine '{}'; there are {}", selector, joined(names)));
  }
  std::erase_if(engines.rows, [&](const EngineRow& row) {
    return std::none_of(selectors.begin(), selectors.end(),
                        [&](const std::string& s) { return selects_engine(s, row.info.name); });
  });
}

}  // namespace plumbline
