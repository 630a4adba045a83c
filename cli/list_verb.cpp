// plumbline list: the scenarios and engines there are.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "inventory.hpp"
#include "plumbline/core/feature.hpp"
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

// The first tier that runs any case of it.
std::string_view tier_of(const ScenarioSummary& summary, const ScenarioInventory& scenarios) {
  Tier least = Tier::kFull;
  for (const CaseInput& c : scenarios.cases) {
    if (c.scenario.id == summary.id) least = std::min(least, c.scenario.tier);
  }
  return tier_name(least);
}

// What a row can run of the cases, and what keeps it from the others: the missing features with their counts.
struct Reach {
  std::size_t runs = 0;
  std::map<std::string, std::size_t> missing;
};

Reach reach_of(const EngineInfo& engine, const std::vector<CaseInput>& cases) {
  Reach reach;
  for (const CaseInput& c : cases) {
    const std::string lacking = needs(c.scenario).without(engine.features).describe();
    ++(lacking.empty() ? reach.runs : reach.missing[lacking]);
  }
  return reach;
}

nlohmann::json reach_json(const Reach& reach) {
  nlohmann::json unsupported = nlohmann::json::array();
  for (const auto& [lacking, count] : reach.missing) unsupported.push_back({{"missing", lacking}, {"cases", count}});
  return {{"cases", reach.runs}, {"unsupported", unsupported}};
}

nlohmann::json listing(const ScenarioInventory& scenarios, const EngineInventory& engines) {
  nlohmann::json json{{"scenarios", nlohmann::json::array()}, {"engines", nlohmann::json::array()}};
  for (const ScenarioSummary& s : scenarios.summaries) {
    json["scenarios"].push_back({{"id", s.id},
                                 {"about", s.about},
                                 {"source", s.source},
                                 {"cases", s.cases},
                                 {"dt", s.steps},
                                 {"tier", tier_of(s, scenarios)},
                                 {"reference", s.reference_kind}});
  }
  for (const EngineRow& row : engines.rows) {
    json["engines"].push_back({{"name", row.info.name},
                               {"library", row.info.library},
                               {"version", row.info.version},
                               {"precision", row.info.precision == Precision::kSingle ? "single" : "double"},
                               {"dimension", row.info.dimension},
                               {"scheme", row.info.scheme},
                               {"runs", reach_json(reach_of(row.info, scenarios.cases))},
                               {"settings", settings_json(row.info)}});
  }
  return json;
}

// Cases by the values that tell them apart; the id stands above them.
std::string values_of(const std::string& case_name, const std::string& id) {
  return case_name.size() > id.size() ? case_name.substr(id.size() + 1) : "";
}

void print_scenarios(const ScenarioInventory& scenarios) {
  std::size_t cases = 0;
  std::string family;
  for (const ScenarioSummary& s : scenarios.summaries) {
    cases += s.cases.size();
    if (const std::string here = s.id.substr(0, s.id.find('/')); here != family) {
      family = here;
      fmt::print("\n{}\n", family);
    }
    fmt::print("  {:<32} {:<11} {:<8} {}\n", s.id, s.reference_kind, tier_of(s, scenarios), s.about);
    std::string line;
    for (const std::string& name : s.cases) {
      const std::string values = values_of(name, s.id);
      if (values.empty()) continue;
      if (line.size() + values.size() > 84) {
        fmt::print("{:>36}{}\n", "", line);
        line.clear();
      }
      line += (line.empty() ? "" : "  ") + values;
    }
    if (!line.empty()) fmt::print("{:>36}{}\n", "", line);
  }
  fmt::print("\n{} scenarios, {} cases; reference and first tier beside each.\n", scenarios.summaries.size(), cases);
}

void print_engines(const ScenarioInventory& scenarios, const EngineInventory& engines) {
  fmt::print("\nEngines\n");
  for (const EngineRow& row : engines.rows) {
    const EngineInfo& e = row.info;
    fmt::print("  {:<18} {} {}, {}D, {} precision, {}\n", e.name, e.library, e.version, e.dimension,
               e.precision == Precision::kSingle ? "single" : "double", e.scheme);
    const Reach reach = reach_of(e, scenarios.cases);
    fmt::print("  {:<18}   runs {} of {} cases\n", "", reach.runs, scenarios.cases.size());
    for (const auto& [lacking, count] : reach.missing) fmt::print("  {:<18}   {} need {}\n", "", count, lacking);
  }
  for (const MissingEngine& m : engines.missing) fmt::print("  {:<18} left out: {}\n", m.name, m.reason);
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
  std::erase_if(scenarios.cases, [&](const CaseInput& c) { return !selected(c.scenario.case_name()); });
  if (options.json) {
    fmt::print("{}\n", listing(scenarios, engines).dump(2));
  } else if (options.settings) {
    print_settings(engines);
    return kExitPass;
  } else {
    print_scenarios(scenarios);
    print_engines(scenarios, engines);
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
