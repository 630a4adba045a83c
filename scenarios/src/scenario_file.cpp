#include "plumbline/scenarios/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "document.hpp"
#include "expression.hpp"
#include "gate_fields.hpp"
#include "joint_fields.hpp"
#include "reference_table.hpp"
#include "scene.hpp"
#include "sweep.hpp"

namespace plumbline {
namespace {

// The dt that every scenario runs with unless its file says otherwise: two usual frame rates, the course's own
// step and a fine one [s].
const std::vector<double>& default_steps() {
  static const std::vector<double> kSteps = {1.0 / 60, 0.02, 1.0 / 240, 1.0 / 1000};
  return kSteps;
}

std::vector<double> read_steps(const Node& root, const Parameters& constants, double duration) {
  const Node* node = find(root, "steps");
  if (node == nullptr) return default_steps();
  std::vector<double> steps;
  if (as_array(*node).empty()) fail(*node, "is empty; give at least one dt, or remove the line for the default");
  for (const Node& item : node->items) {
    const double dt = positive_number(item, constants);
    if (dt > duration) fail(item, fmt::format("is longer than the duration, {} s", shortest(duration)));
    if (std::find(steps.begin(), steps.end(), dt) != steps.end()) {
      fail(item, fmt::format("the value {} is there twice; name each dt once", shortest(dt)));
    }
    steps.push_back(dt);
  }
  return steps;
}

Scales read_scales(const Node& root, const Parameters& constants) {
  const Node& table = need(root, "scales", "[scales] with length, time and mass: they make tolerances dimensionless");
  allow_only(table, {"length", "time", "mass"});
  return {positive_number(need(table, "length", "length = 1.0  # m"), constants),
          positive_number(need(table, "time", "time = 1.0  # s"), constants),
          positive_number(need(table, "mass", "mass = 1.0  # kg"), constants)};
}

// Names of cases become names of folders: an id that climbs out of them must not pass.
std::string read_id(const Node& root) {
  const Node& node = need(root, "id", "id = \"family/case\"");
  const std::string& id = as_text(node);
  const auto is_word = [](std::string_view word) {
    return !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == word.npos;
  };
  const std::size_t slash = id.find('/');
  if (slash == id.npos || !is_word(std::string_view(id).substr(0, slash)) ||
      !is_word(std::string_view(id).substr(slash + 1))) {
    fail(node, "must be \"family/case\", each of small letters, digits and _");
  }
  return id;
}

Case read_case(const Node& root, const ParameterSet& set) {
  const Parameters constants = with_derived(root, set.values);
  Case result;
  Scenario& s = result.scenario;
  s.id = read_id(root);
  s.about = as_text(need(root, "about", "about = \"one line on what happens\""));
  s.source = as_text(need(root, "source", "source = \"slide, paper or page\""));
  s.parameters = set.values;
  s.swept = set.swept;
  s.duration = positive_number(need(root, "duration", "duration = 1.0  # s"), constants);
  s.t_valid = s.duration;  // a closed form holds for as long as it is stated
  s.steps = read_steps(root, constants, s.duration);
  if (const Node* gravity = find(root, "gravity")) s.gravity = vector3(*gravity, constants);
  s.scales = read_scales(root, constants);
  s.bodies = read_bodies(root, constants);
  s.joints = read_joints(root, constants, s);
  s.contact = read_contact(root, constants);
  s.forces = read_forces(root, constants, s.bodies);
  s.events = read_events(root, constants, s);
  result.reference = read_reference(root, constants, s);
  s.gates = read_gates(root, constants, s);
  return result;
}

std::vector<Case> read_document(const Node& root, const Overrides& overrides) {
  allow_only(root, {"id", "about", "source", "duration", "steps", "gravity", "parameters", "derived", "scales",
                    "contact", "body", "joint", "force", "reference", "event", "gate"});
  std::vector<Case> cases;
  for (const ParameterSet& set : expand_sweeps(root, overrides)) cases.push_back(read_case(root, set));
  return cases;
}

}  // namespace

std::vector<Case> read_scenario(std::string_view text, const std::string& file, const Overrides& overrides) {
  return read_document(parse_document(text, file), overrides);
}

std::vector<Case> read_scenario_file(const std::filesystem::path& file, const Overrides& overrides) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) {
    throw ScenarioError(fmt::format("{}: cannot be read ({}); check the path", file.string(), std::strerror(errno)));
  }
  return read_scenario(text, file.string(), overrides);
}

std::vector<std::filesystem::path> find_scenario_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) {
    throw ScenarioError(fmt::format("{}: is not a folder; scenarios lie in FOLDER/family/case.toml", folder.string()));
  }
  const auto take = [&](const std::filesystem::directory_entry& entry) {
    if (entry.is_regular_file() && entry.path().extension() == ".toml") files.push_back(entry.path());
  };
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    take(entry);
    if (!entry.is_directory()) continue;
    for (const auto& inner : std::filesystem::directory_iterator(entry)) take(inner);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace plumbline
