#include "plumbline/scenarios/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "certificate_fields.hpp"
#include "document.hpp"
#include "expression.hpp"
#include "gate_fields.hpp"
#include "joint_fields.hpp"
#include "reference_table.hpp"
#include "scene.hpp"
#include "spelling.hpp"
#include "spring_fields.hpp"
#include "sweep.hpp"
#include "threshold_fields.hpp"

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

// Unless the file says otherwise, its first case is what a quick run shows of it.
Tier read_tier(const Node& root, bool is_first) {
  Tier least = Tier::kSmoke;
  if (const Node* node = find(root, "tier")) {
    static const std::vector<std::string> kTiers = {"smoke", "standard", "full"};
    const auto found = std::find(kTiers.begin(), kTiers.end(), as_text(*node));
    if (found == kTiers.end()) {
      fail(*node, fmt::format("unknown tier '{}'; {}known: {}", node->text, did_you_mean(node->text, kTiers),
                              fmt::join(kTiers, ", ")));
    }
    least = static_cast<Tier>(found - kTiers.begin());
  }
  return std::max(least, is_first ? Tier::kSmoke : Tier::kStandard);
}

double read_t_valid(const Node& root, const Parameters& constants, double duration) {
  const Node* node = find(root, "t_valid");
  if (node == nullptr) return duration;  // a closed form holds for as long as it is stated
  const double t = positive_number(*node, constants);
  if (t > duration) fail(*node, fmt::format("is beyond the duration, {} s; remove this line", shortest(duration)));
  return t;
}

Scenario read_scene(const std::shared_ptr<const Node>& file, const ParameterSet& set);

// The questions of a threshold are asked of the same file with one parameter changed.
ScenarioWith scenario_with(const std::shared_ptr<const Node>& file, const ParameterSet& set) {
  return [file, set](const std::string& parameter, double value) {
    ParameterSet changed = set;
    for (auto& [name, current] : changed.values) {
      if (name == parameter) current = value;
    }
    auto scenario = std::make_shared<Scenario>(read_scene(file, changed));
    scenario->threshold.reset();
    return scenario;
  };
}

// What happens, without what is known of it.
Scenario read_scene(const std::shared_ptr<const Node>& file, const ParameterSet& set) {
  const Node& root = *file;
  const Parameters constants = with_derived(root, set.values);
  Scenario s;
  s.id = read_id(root);
  s.about = as_text(need(root, "about", "about = \"one line on what happens\""));
  s.source = as_text(need(root, "source", "source = \"slide, paper or page\""));
  s.parameters = set.values;
  s.swept = set.swept;
  s.duration = positive_number(need(root, "duration", "duration = 1.0  # s"), constants);
  s.t_valid = read_t_valid(root, constants, s.duration);
  s.steps = read_steps(root, constants, s.duration);
  if (const Node* gravity = find(root, "gravity")) s.gravity = vector3(*gravity, constants);
  s.scales = read_scales(root, constants);
  s.bodies = read_bodies(root, constants);
  s.joints = read_joints(root, constants, s);
  s.contact = read_contact(root, constants);
  s.forces = read_forces(root, constants, s.bodies);
  s.springs = read_springs(root, constants, s);
  s.joint_springs = read_joint_springs(root, constants, s);
  s.drives = read_drives(root, constants, s);
  s.threshold = read_threshold(root, constants, s, scenario_with(file, set));
  return s;
}

Case read_case(const std::shared_ptr<const Node>& file, const ParameterSet& set, bool is_first) {
  const Node& root = *file;
  const Parameters constants = with_derived(root, set.values);
  Case result{read_scene(file, set), nullptr};
  Scenario& s = result.scenario;
  s.tier = read_tier(root, is_first);
  s.events = read_events(root, constants, s);
  result.reference = read_reference(root, constants, s);
  s.gates = read_gates(root, constants, s);
  s.certificates = read_certificates(root, constants, s);
  return result;
}

void allow_known_tables(const Node& root) {
  allow_only(root, {"id",      "about",      "source",    "duration",  "t_valid", "tier", "steps",
                    "gravity", "parameters", "derived",   "scales",    "contact", "body", "joint",
                    "spring",  "force",      "threshold", "reference", "event",   "gate", "certificate"});
}

std::vector<Case> read_document(Node root, const Overrides& overrides) {
  allow_known_tables(root);
  const auto file = std::make_shared<const Node>(std::move(root));
  std::vector<Case> cases;
  for (const ParameterSet& set : expand_sweeps(*file, overrides)) cases.push_back(read_case(file, set, cases.empty()));
  return cases;
}

}  // namespace

std::vector<Case> read_scenario(std::string_view text, const std::string& file, const Overrides& overrides) {
  return read_document(parse_document(text, file), overrides);
}

Scenario read_problem(std::string_view text, const std::string& file, const Parameters& parameters) {
  Node root = parse_document(text, file);
  allow_known_tables(root);
  Overrides overrides;
  for (const auto& [name, value] : parameters) overrides[name] = {value};
  const auto sets = expand_sweeps(root, overrides);
  if (sets.size() != 1) throw std::invalid_argument(file + ": the parameters do not single out one case");
  return read_scene(std::make_shared<const Node>(std::move(root)), sets.front());
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
