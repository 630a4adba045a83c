// plumbline export: a scenario as a world of other programs; its exact motion, or a recorded one, as a file of numbers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>

#include "inventory.hpp"
#include "plumbline/exchange/motion_export.hpp"
#include "plumbline/exchange/world_export.hpp"
#include "selection.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string world, reference, run;  // one of the three
  std::string format, output, dt;
  std::vector<std::string> parameters;
};

// The one case that is meant by a file, by the name of a case or by that of a scenario.
CaseInput case_named(const std::string& name, const std::vector<std::string>& parameters) {
  const auto meant = [&](const Scenario& s) { return s.id == name || s.case_name() == name; };
  const bool is_file = fs::exists(name);
  const std::vector<std::string> paths = is_file ? std::vector<std::string>{name} : std::vector<std::string>{};
  ScenarioInventory inventory = load_scenarios(find_installation(), paths, parse_parameters(parameters),
                                               [&](const Scenario& s) { return is_file || meant(s); });
  if (!is_file) std::erase_if(inventory.cases, [&](const CaseInput& c) { return !meant(c.scenario); });
  if (inventory.cases.empty()) {
    throw UsageError(fmt::format("{}: neither a file nor a scenario; `plumbline list` shows those there are", name));
  }
  if (inventory.cases.size() == 1) return inventory.cases.front();
  std::vector<std::string> names;
  for (const CaseInput& c : inventory.cases) names.push_back(c.scenario.case_name());
  throw UsageError(fmt::format("{} has {} cases, and one can be exported at a time: choose by -P {}=...\n  {}", name,
                               names.size(), inventory.cases.front().scenario.swept.front().first,
                               fmt::join(names, "\n  ")));
}

int export_world(const ExportOptions& options) {
  static const std::map<std::string, WorldFormat> kFormats = {
      {"mjcf", WorldFormat::kMjcf}, {"sdf", WorldFormat::kSdf}, {"urdf", WorldFormat::kUrdf}};
  const auto format = kFormats.find(options.format);
  if (format == kFormats.end()) {
    throw UsageError(
        fmt::format("--as {} is for motions, and needs --reference SCENARIO or --run FILE.csv; a world goes "
                    "out as mjcf, sdf or urdf",
                    options.format));
  }
  if (!options.dt.empty()) throw UsageError("--dt is for --reference: a world has no samples");
  const CaseInput input = case_named(options.world, options.parameters);
  const ExportedWorld exported = export_world(input.scenario, format->second);
  for (const std::string& loss : exported.losses) fmt::print(stderr, "not in the file: {}\n", loss);
  if (options.output.empty()) {
    fmt::print("{}", exported.text);
    return kExitPass;
  }
  std::ofstream out(options.output, std::ios::binary);
  out << exported.text;
  out.close();
  if (!out) throw UsageError(fmt::format("{}: cannot be written", options.output));
  return kExitPass;
}

Motion motion_of(const ExportOptions& options) {
  try {
    if (!options.run.empty()) {
      if (!options.dt.empty()) throw UsageError("--dt is for --reference: a recorded run has its own samples");
      return read_motion_csv(options.run);
    }
    if (options.dt.empty()) throw UsageError("--reference needs --dt SECONDS, the distance of the samples");
    const double dt = parse_step(options.dt);
    const CaseInput input = case_named(options.reference, options.parameters);
    if (dt > input.scenario.duration) {
      throw UsageError(
          fmt::format("--dt {} is longer than the duration, {} s", options.dt, shortest(input.scenario.duration)));
    }
    return exact_motion(input.scenario, *input.reference, dt);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

int export_motion(const ExportOptions& options) {
  if (options.output.empty()) throw UsageError("a motion needs a file to go to: add -o FILE");
  using Write = void (*)(const Motion&, const fs::path&);
  static const std::map<std::string, Write> kWriters = {{"csv", write_csv},
                                                        {"npz", write_npz},
                                                        {"header", write_cpp_header},
                                                        {"tum", [](const Motion& motion, const fs::path& file) {
                                                           for (const fs::path& written : write_tum(motion, file))
                                                             fmt::print(stderr, "{}\n", written.string());
                                                         }}};
  const auto writer = kWriters.find(options.format);
  if (writer == kWriters.end()) {
    throw UsageError(
        fmt::format("--as {} is for worlds; a motion goes out as csv, npz, tum or header", options.format));
  }
  const Motion motion = motion_of(options);
  try {
    writer->second(motion, options.output);
  } catch (const std::runtime_error& e) {
    throw UsageError(e.what());
  }
  return kExitPass;
}

int export_as_asked(const ExportOptions& options) {
  const auto given = [](const std::string& text) { return text.empty() ? 0 : 1; };
  if (given(options.world) + given(options.reference) + given(options.run) != 1) {
    throw UsageError(
        "name one thing to export: a SCENARIO for its world, --reference SCENARIO for its exact motion, or "
        "--run FILE.csv for a recorded one");
  }
  return options.world.empty() ? export_motion(options) : export_world(options);
}

}  // namespace

void add_export_verb(CLI::App& program, Action& action) {
  const auto o = std::make_shared<ExportOptions>();
  CLI::App* verb = program.add_subcommand("export", "Write a scenario's world, its exact motion or a run's for others");
  verb->add_option("scenario", o->world,
                   "World to write: a scenario file, or the name of a case (friction/incline/mu=0.2)");
  verb->add_option("--reference", o->reference, "Write the exact motion of this scenario instead");
  verb->add_option("--run", o->run, "Write this recorded motion instead: RESULTS/trajectories/.../ENGINE....csv");
  verb->add_option("--as", o->format, "Worlds: mjcf, sdf, urdf. Motions: csv, npz, tum, header (C++)")
      ->required()
      ->check(CLI::IsMember({"mjcf", "sdf", "urdf", "csv", "npz", "tum", "header"}));
  verb->add_option("-o,--output", o->output, "File to write; a world goes to standard output without it");
  verb->add_option("--dt", o->dt, "Distance of the samples of --reference [s]: 0.01 or 1/240");
  verb->add_option("-P,--parameter", o->parameters, "Values of the scenario's parameters: -P mu=0.2")
      ->allow_extra_args(false);
  verb->callback([o, &action] { action = [o] { return export_as_asked(*o); }; });
}

}  // namespace plumbline
