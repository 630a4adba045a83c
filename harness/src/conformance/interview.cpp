#include "interview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace plumbline {
namespace conformance {
namespace {

std::string text_of(const Vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x(), v.y(), v.z()); }

std::vector<Question> all_questions() {
  std::vector<Question> all;
  for (const auto theme :
       {description_questions, mass_questions, frame_questions, force_questions, contact_questions, joint_questions,
        spring_questions, stop_questions, cylinder_questions, world_questions, hostile_questions}) {
    std::ranges::copy(theme(), std::back_inserter(all));
  }
  return all;
}

const std::vector<Question>& questions() {
  static const std::vector<Question> all = all_questions();
  return all;
}

}  // namespace

Interview::Interview(const Engine& engine, Profile profile, WorldBuilder build)
    : engine_(engine), profile_(profile), build_(std::move(build)) {
  if (!build_) build_ = [](const Engine& e, const Scenario& s, const Settings& k) { return e.build(s, k); };
}

void Interview::require(Feature feature) const {
  if (!has(feature)) throw NotAsked("the engine has no " + std::string(feature_name(feature)));
}

bool Interview::can_run(const Scenario& scenario) const { return needs(scenario).without(info().features).empty(); }

std::unique_ptr<World> Interview::build(const Scenario& scenario) const {
  return build(scenario, settings_of(info(), profile_));
}

std::unique_ptr<World> Interview::build(const Scenario& scenario, const Settings& settings) const {
  if (!can_run(scenario)) {
    throw NotAsked("the engine has no " + needs(scenario).without(info().features).describe());
  }
  return build_(engine_, scenario, settings);
}

void Interview::expect(bool holds, const std::string& complaint) {
  if (!holds) complaints_.push_back(complaint);
}

void Interview::within(const std::string& what, double seen, double wanted, double tolerance) {
  expect(plumbline::within(seen - wanted, tolerance),
         fmt::format("{} is {:.9g}, wanted {:.9g} within {:.2g}", what, seen, wanted, tolerance));
}

void Interview::within(const std::string& what, const Vec3& seen, const Vec3& wanted, double tolerance) {
  expect(plumbline::within((seen - wanted).norm(), tolerance),
         fmt::format("{} is {}, wanted {} within {:.2g}", what, text_of(seen), text_of(wanted), tolerance));
}

void Interview::refused(const std::string& what, const std::function<void()>& act, const std::string& word) {
  try {
    act();
  } catch (const NotAsked&) {
    throw;
  } catch (const std::exception& error) {
    const std::string said = error.what();
    expect(said.find(word) != std::string::npos,
           fmt::format("{} is refused without naming '{}': {}", what, word, said));
    return;
  }
  complaints_.push_back(what + " is accepted");
}

ConformanceAnswer Interview::answer() const {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, complaints_.size()); ++i) text += (i == 0 ? "" : "; ") + complaints_[i];
  if (complaints_.size() > kShown) text += fmt::format("; and {} more", complaints_.size() - kShown);
  return {complaints_.empty() ? ConformanceAnswer::Kind::kHolds : ConformanceAnswer::Kind::kBroken, text};
}

}  // namespace conformance

const std::vector<ConformanceCheck>& conformance_checks() {
  static const std::vector<ConformanceCheck> checks = [] {
    std::vector<ConformanceCheck> all;
    for (const auto& question : conformance::questions()) all.push_back(question.about);
    return all;
  }();
  return checks;
}

const ConformanceCheck* find_conformance_check(std::string_view name) {
  for (const ConformanceCheck& check : conformance_checks()) {
    if (check.name == name) return &check;
  }
  return nullptr;
}

ConformanceAnswer ask(std::string_view check, const Engine& engine, Profile profile, const WorldBuilder& build) {
  for (const conformance::Question& question : conformance::questions()) {
    if (question.about.name != check) continue;
    conformance::Interview interview(engine, profile, build);
    try {
      question.ask(interview);
    } catch (const conformance::NotAsked& lack) {
      // What was found wrong before still counts.
      if (ConformanceAnswer answer = interview.answer(); !answer.text.empty()) return answer;
      return {ConformanceAnswer::Kind::kNotAsked, lack.what()};
    }
    return interview.answer();
  }
  throw std::invalid_argument("there is no conformance check '" + std::string(check) + "'");
}

}  // namespace plumbline
