// plumbline doctor: what was found, what is missing, and the command that installs it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "environment.hpp"
#include "inventory.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

void print_engines(const EngineInventory& engines) {
  fmt::print("\nEngines\n");
  for (const EngineRow& row : engines.rows) {
    fmt::print("  ok       {:<16} {} {}, {} precision, {}D, {} known deviations\n", row.info.name, row.info.library,
               row.info.version, row.info.precision == Precision::kSingle ? "single" : "double", row.info.dimension,
               row.deviations.size());
  }
  for (const MissingEngine& m : engines.missing) fmt::print("  MISSING  {:<16} {}\n", m.name, m.reason);
}

int doctor() {
  const Installation installation = find_installation();
  fmt::print("plumbline {}\n\nEnvironment\n", PLUMBLINE_VERSION);
  for (const auto& [name, value] : describe_environment()) fmt::print("  {:<10} {}\n", name, value);

  const EngineInventory engines = load_engines(installation);
  print_engines(engines);

  fmt::print("\nScenarios\n");
  bool scenarios_ok = true;
  try {
    const ScenarioInventory scenarios = load_scenarios(installation, {}, {}, [](const Scenario&) { return true; });
    fmt::print("  ok       {} files, {} cases in {}\n", scenarios.summaries.size(), scenarios.cases.size(),
               installation.scenarios.string());
    scenarios_ok = !scenarios.cases.empty();
  } catch (const UsageError& e) {
    fmt::print("  BROKEN   {}\n", e.what());
    scenarios_ok = false;
  }

  if (!installation.left_out.empty()) {
    std::vector<std::string> packages;
    for (const LeftOutEngine& e : installation.left_out) packages.push_back(e.package);
    fmt::print("\nTo get what is missing: apt-get install {}\n", fmt::join(packages, " "));
  }
  if (engines.rows.empty()) fmt::print("\nNo engine works: nothing can be run. Build again with ./plumbline.\n");
  return engines.rows.empty() || !scenarios_ok ? kExitEngineError : kExitPass;
}

}  // namespace

void add_doctor_verb(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("doctor", "Tell what was found, in which version, and what is missing");
  verb->callback([&action] { action = doctor; });
}

}  // namespace plumbline
