// plumbline list: the scenarios and engines there are.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "inventory.hpp"
#include "selection.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

struct ListOptions {
  std::vector<std::string> paths, filter;
  bool json = false;
};

nlohmann::json listing(const ScenarioInventory& scenarios, const EngineInventory& engines) {
  nlohmann::json json{{"scenarios", nlohmann::json::array()}, {"engines", nlohmann::json::array()}};
  for (const ScenarioSummary& s : scenarios.summaries) {
    json["scenarios"].push_back({{"id", s.id},
                                 {"about", s.about},
                                 {"source", s.source},
                                 {"cases", s.cases},
                                 {"dt", s.steps},
                                 {"reference", s.reference_kind}});
  }
  for (const EngineRow& row : engines.rows) {
    json["engines"].push_back({{"name", row.info.name},
                               {"library", row.info.library},
                               {"version", row.info.version},
                               {"precision", row.info.precision == Precision::kSingle ? "single" : "double"},
                               {"dimension", row.info.dimension},
                               {"scheme", row.info.scheme}});
  }
  return json;
}

void print(const ScenarioInventory& scenarios, const EngineInventory& engines) {
  fmt::print("Scenarios\n");
  for (const ScenarioSummary& s : scenarios.summaries) {
    fmt::print("  {:<26} {}\n", s.id, s.about);
    if (s.cases.size() > 1) {
      for (const std::string& name : s.cases) fmt::print("  {:<26}   {}\n", "", name);
    }
  }
  fmt::print("\nEngines\n");
  for (const EngineRow& row : engines.rows) {
    const EngineInfo& e = row.info;
    fmt::print("  {:<16} {} {}, {}D, {} precision, {}\n", e.name, e.library, e.version, e.dimension,
               e.precision == Precision::kSingle ? "single" : "double", e.scheme);
  }
  for (const MissingEngine& m : engines.missing) fmt::print("  {:<16} left out: {}\n", m.name, m.reason);
}

int list(const ListOptions& options) {
  const Installation installation = find_installation();
  ScenarioInventory scenarios = load_scenarios(installation, options.paths, {}, [](const Scenario&) { return true; });
  const EngineInventory engines = load_engines(installation);
  const auto selected = name_filter(options.filter);
  for (ScenarioSummary& s : scenarios.summaries) {
    std::erase_if(s.cases, [&](const std::string& name) { return !selected(name); });
  }
  std::erase_if(scenarios.summaries, [](const ScenarioSummary& s) { return s.cases.empty(); });
  if (options.json) {
    fmt::print("{}\n", listing(scenarios, engines).dump(2));
  } else {
    print(scenarios, engines);
  }
  return scenarios.summaries.empty() ? kExitNothingMatched : kExitPass;
}

}  // namespace

void add_list_verb(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* verb = program.add_subcommand("list", "Show the scenarios and the engines");
  verb->add_option("paths", options->paths, "Scenario files or folders instead of the built-in catalogue");
  verb->add_option("-f,--filter", options->filter,
                   "Only cases whose name matches this regular expression; -REGEX leaves out");
  verb->add_flag("--json", options->json, "Machine-readable: {\"scenarios\": [...], \"engines\": [...]}");
  verb->callback([options, &action] { action = [options] { return list(*options); }; });
}

}  // namespace plumbline
