// What a row says of itself and of its settings.
#include <set>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

void describes_itself(Interview& row) {
  const EngineInfo& info = row.info();
  row.expect(!info.name.empty(), "the row has no name");
  row.expect(!info.library.empty(), "the row does not name its library");
  row.expect(!info.version.empty(), "the row does not tell its version");
  row.expect(!info.scheme.empty(), "the row does not tell its scheme");
  row.within("dimension", info.dimension, row.planar() ? 2 : 3, 0);
  std::set<std::string> names;
  for (const Setting& s : info.settings) {
    row.expect(!s.name.empty() && names.insert(s.name).second, "the setting '" + s.name + "' is listed twice");
    row.expect(!s.meaning.empty(), "the setting '" + s.name + "' has no meaning");
    row.expect(s.default_value.index() == s.matched_value.index(), "the setting '" + s.name + "' changes its type");
  }
}

Scenario lone_ball() {
  Scenario scenario;
  scenario.bodies = {ball("ball", 0.1, 1, Vec3(0, 0, 1))};
  return scenario;
}

void refuses_impossible_settings(Interview& row) {
  const Settings settings = settings_of(row.info(), row.profile());
  if (settings.empty()) throw NotAsked("the engine has no settings");
  for (const Setting& s : row.info().settings) {
    Settings changed = settings;
    if (std::holds_alternative<bool>(s.default_value)) continue;
    if (std::holds_alternative<std::string>(s.default_value)) {
      changed[s.name] = std::string("no such value");
    } else {
      changed[s.name] = std::nan("");
    }
    row.refused(s.name + " that is no value of it", [&] { row.build(lone_ball(), changed); });
  }
}

// Scenes in which the usual knobs show: sleeping and damping in a slow ball, gyroscopic terms in an uneven spinning
// box, everything about contacts in the busy ones.
std::vector<Scenario> telling_scenes(const Interview& row) {
  std::vector<Scenario> scenes = busy_scenes(row);
  Scenario slow = lone_ball();
  slow.bodies[0].initial.v_WB = Vec3(1e-3, 0, 0);
  scenes.push_back(slow);
  Scenario spinning;
  spinning.bodies = {uneven_box()};
  spinning.bodies[0].initial.w_WB = row.planar() ? Vec3(0, 3, 0) : Vec3(1, 3, 2);
  scenes.push_back(spinning);
  return scenes;
}

// How a run ends: in states, or with what the engine said when it gave up, which some do in a scene of many contacts.
struct End {
  std::vector<BodyState> states;
  std::string said;
};
End end_of(Interview& row, const Scenario& scenario, const Settings& settings, int steps) {
  try {
    return {run(*row.build(scenario, settings), scenario, kStep, steps), ""};
  } catch (const std::runtime_error& error) {
    return {{}, error.what()};
  }
}
bool same_end(const End& a, const End& b) { return same_bits(a.states, b.states) && a.said == b.said; }

void settings_act(Interview& row) {
  const Settings usual = settings_of(row.info(), Profile::kDefault),
                 matched = settings_of(row.info(), Profile::kMatched);
  if (usual == matched) throw NotAsked("the engine has no setting whose default and matched values differ");
  // The last scenes are watched for longer than the most patient engine waits before a body sleeps.
  constexpr int kSteps = 256;
  bool acts = false;
  for (const Scenario& scenario : telling_scenes(row)) {
    for (const auto& [name, value] : usual) {
      if (matched.at(name) == value) continue;
      Settings one_changed = matched;
      one_changed[name] = value;
      try {
        row.build(scenario, one_changed);
      } catch (const std::exception& error) {
        row.expect(false, "the default of " + name + " is refused beside the matched values: " + error.what());
      }
    }
    if (acts) continue;
    acts = !same_end(end_of(row, scenario, usual, kSteps), end_of(row, scenario, matched, kSteps));
  }
  row.expect(acts, "both profiles give the same bits in every scene: their settings are printed but not used");
}

const Question kQuestions[] = {
    {{"row_describes_itself", "description",
      "Does the row tell its name, library, version, scheme and dimension, and each setting's meaning?", "", false},
     describes_itself},
    {{"impossible_settings_are_refused", "description",
      "Is a word that a setting does not know refused, and a number that is NaN?", "", false},
     refuses_impossible_settings},
    {{"settings_act", "description",
      "Can each setting be changed by itself, and do the two profiles move any scene differently?",
      "one bit in one of the scenes is enough", true},
     settings_act},
};

}  // namespace

std::span<const Question> description_questions() { return kQuestions; }

std::vector<Scenario> busy_scenes(const Interview& row, double shift) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{row.has(Feature::kRestitution) ? 0.3 : 0, row.has(Feature::kFriction) ? 0.4 : 0};
  const std::vector<Body> ground = {half_space(Vec3::UnitZ())};
  const std::vector<Body> balls = {ball("ball", 0.2, 1, Vec3(shift, 0, 0.5), Vec3(1, 0, 0)),
                                   ball("other", 0.3, 3, Vec3(shift + 0.6, 0, 0.5), Vec3(-1, 0, 0))};
  const std::vector<Body> boxes = {box("low", Vec3(1, 1, 1), 10, Vec3(3 + shift, 0, 0.6)),
                                   box("high", Vec3(0.8, 0.8, 0.8), 5, Vec3(3.1 + shift, 0, 1.7))};
  std::vector<Scenario> scenes;
  const auto add = [&](std::initializer_list<std::vector<Body>> groups) {
    Scenario s = scenario;
    for (const auto& group : groups) s.bodies.insert(s.bodies.end(), group.begin(), group.end());
    if (row.can_run(s)) scenes.push_back(std::move(s));
  };
  add({ground, balls, boxes});
  add({ground, balls});
  add({ground, {boxes[0]}});
  if (scenes.empty()) {
    scenario.contact.reset();
    add({balls});
  }
  return scenes;
}

}  // namespace plumbline::conformance
