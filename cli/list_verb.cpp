// plumbline list: the scenarios and engines there are.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "inventory.hpp"
#include "selection.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

struct ListOptions {
  std::vector<std::string> paths, filter, engines;
  bool json = false, settings = false;
};

std::string shown(const SettingValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return shortest(*number);
  return std::get<bool>(value) ? "true" : "false";
}

// What --set can change, row by row.
void print_settings(const EngineInventory& engines) {
  for (const EngineRow& row : engines.rows) {
    fmt::print("{}  ({} {})\n", row.info.name, row.info.library, row.info.version);
    for (const Setting& s : row.info.settings) {
      const std::string matched = s.matched_value == s.default_value ? "" : ", matched " + shown(s.matched_value);
      fmt::print("  {}.{} = {}{}{}\n      {}\n", row.info.name, s.name, shown(s.default_value), matched,
                 s.unit.empty() ? "" : "  [" + s.unit + "]", s.meaning);
    }
    fmt::print("\n");
  }
}

// As in results.json: a number that is not finite is a word, since JSON has none for it.
nlohmann::json json_of(const SettingValue& value) {
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && !std::isfinite(*number)) return shortest(*number);
  return std::visit([](const auto& v) { return nlohmann::json(v); }, value);
}

nlohmann::json settings_json(const EngineInfo& info) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Setting& s : info.settings) {
    rows.push_back({{"name", s.name},
                    {"default", json_of(s.default_value)},
                    {"matched", json_of(s.matched_value)},
                    {"unit", s.unit},
                    {"meaning", s.meaning}});
  }
  return rows;
}

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
                               {"scheme", row.info.scheme},
                               {"settings", settings_json(row.info)}});
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
  EngineInventory engines = load_engines(installation);
  select_engines(engines, options.engines);
  const auto selected = name_filter(options.filter);
  for (ScenarioSummary& s : scenarios.summaries) {
    std::erase_if(s.cases, [&](const std::string& name) { return !selected(name); });
  }
  std::erase_if(scenarios.summaries, [](const ScenarioSummary& s) { return s.cases.empty(); });
  if (options.json) {
    fmt::print("{}\n", listing(scenarios, engines).dump(2));
  } else if (options.settings) {
    print_settings(engines);
    return kExitPass;
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
  verb->add_option("-e,--engines", options->engines, "Only these engines: bullet-f32, or bullet for all its rows")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_flag("--settings", options->settings, "Show the settings of the engines, which --set changes in a run");
  verb->add_flag("--json", options->json, "Machine-readable: {\"scenarios\": [...], \"engines\": [...]}");
  verb->callback([options, &action] { action = [options] { return list(*options); }; });
}

}  // namespace plumbline
