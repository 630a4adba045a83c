// plumbline import FILE: a world of MuJoCo, Gazebo or ROS as a scenario file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "child_program.hpp"
#include "installation.hpp"
#include "plumbline/exchange/world_file.hpp"
#include "plumbline/scenarios/scenario_file.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{60};

struct ImportOptions {
  std::string file, output, keyframe;
  double duration = 0;
  bool partial = false;
};

struct Importer {
  const char *program, *package;
};

WorldFormat format_of(const std::string& file) {
  try {
    return format_of_world_file(file);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

Importer importer_of(WorldFormat format) {
  if (format == WorldFormat::kMjcf) return {"plumbline-import-mjcf", "libmujoco-dev"};
  return {"plumbline-import-sdf", "libsdformat-dev"};
}

nlohmann::json ask_importer(const ImportOptions& options) {
  const Importer importer = importer_of(format_of(options.file));
  const fs::path program = find_installation().programs / importer.program;
  if (!fs::exists(program)) {
    throw std::runtime_error(
        fmt::format("{} is not there: its library was not found when Plumbline was built; apt-get "
                    "install {}, then build again",
                    program.string(), importer.package));
  }
  std::vector<std::string> arguments;
  if (!options.keyframe.empty()) arguments = {"--keyframe", options.keyframe};
  if (options.duration > 0) arguments.insert(arguments.end(), {"--duration", shortest(options.duration)});
  arguments.push_back(fs::absolute(options.file).string());
  const ChildOutcome outcome = run_child(program, arguments, kPatience);
  const auto answer = nlohmann::json::parse(outcome.output, nullptr, false);
  if (outcome.exit_code == kExitUsage && answer.is_object() && answer.contains("error")) {
    throw UsageError(answer["error"].get<std::string>());
  }
  if (outcome.exit_code != 0 || !answer.is_object()) {
    const std::string how =
        outcome.trouble.empty() ? fmt::format("ended with exit code {}", outcome.exit_code) : outcome.trouble;
    throw std::runtime_error(
        fmt::format("{}: the reader {} {}\n{}", options.file, importer.program, how, outcome.messages));
  }
  return answer;
}

// The scenario as the reader of scenarios sees it: what that refuses has not been imported.
void require_readable(const std::string& text, const std::string& file) {
  try {
    read_scenario(text, file);
  } catch (const ScenarioError& e) {
    throw UsageError(fmt::format("what the world says makes no sound scenario: {}", e.what()));
  }
}

int import_world(const ImportOptions& options) {
  const nlohmann::json answer = ask_importer(options);
  const auto losses = answer["losses"].get<std::vector<std::string>>();
  const auto notes = answer["notes"].get<std::vector<std::string>>();
  for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  for (const std::string& loss : losses) fmt::print(stderr, "{}: {}\n", options.partial ? "lost" : "error", loss);
  if (!losses.empty() && !options.partial) {
    throw UsageError(
        fmt::format("{}: {} thing(s) have no place in a scenario; change the file, or import the rest with "
                    "--partial",
                    options.file, losses.size()));
  }
  const auto text = answer["scenario"].get<std::string>();
  require_readable(text, options.output.empty() ? "scenario.toml" : options.output);
  if (options.output.empty()) {
    fmt::print("{}", text);
    return kExitPass;
  }
  std::ofstream out(options.output, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw UsageError(fmt::format("{}: cannot be written", options.output));
  return kExitPass;
}

}  // namespace

void add_import_verb(CLI::App& program, Action& action) {
  const auto o = std::make_shared<ImportOptions>();
  CLI::App* verb = program.add_subcommand("import", "Turn a world file (MJCF, SDF, URDF) into a scenario file");
  verb->add_option("file", o->file, "The world; its outermost element tells the format")->required();
  verb->add_option("-o,--output", o->output, "The scenario file to write; standard output without it");
  verb->add_flag("--partial", o->partial, "Import what can be, and list what is lost, instead of refusing");
  verb->add_option("--duration", o->duration, "Of the scenario [s]; else what the file says, else 1")
      ->check(CLI::PositiveNumber);
  verb->add_option("--keyframe", o->keyframe,
                   "MJCF: start from this keyframe, or from none; else from the one called start, where there is one");
  verb->callback([o, &action] { action = [o] { return import_world(*o); }; });
}

}  // namespace plumbline
