#include "plumbline/core/engine.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline {
namespace {

template <typename T>
const T& typed(const Settings& settings, std::string_view name, const char* type) {
  const auto found = settings.find(name);
  if (found == settings.end()) throw std::invalid_argument("no setting '" + std::string(name) + "'");
  const T* value = std::get_if<T>(&found->second);
  if (value == nullptr) throw std::invalid_argument("setting '" + std::string(name) + "' must be " + type);
  return *value;
}

}  // namespace

std::string_view profile_name(Profile profile) { return profile == Profile::kDefault ? "default" : "matched"; }

Settings settings_of(const EngineInfo& info, Profile profile) {
  Settings settings;
  for (const Setting& s : info.settings) {
    settings[s.name] = profile == Profile::kDefault ? s.default_value : s.matched_value;
  }
  return settings;
}

void require_settings(const EngineInfo& info, const Settings& settings) {
  static constexpr const char* kTypes[] = {"true or false", "a number", "a word"};
  for (const Setting& s : info.settings) {
    const auto found = settings.find(s.name);
    if (found == settings.end()) throw std::invalid_argument("no setting '" + s.name + "'");
    if (found->second.index() != s.default_value.index()) {
      throw std::invalid_argument("setting '" + s.name + "' must be " + kTypes[s.default_value.index()]);
    }
    if (const auto* number = std::get_if<double>(&found->second); number != nullptr && std::isnan(*number)) {
      throw std::invalid_argument("setting '" + s.name + "' must be a number; it is NaN");
    }
  }
  if (settings.size() == info.settings.size()) return;
  std::string known;
  for (const Setting& s : info.settings) known += (known.empty() ? "" : ", ") + s.name;
  for (const auto& [name, value] : settings) {
    const bool listed =
        std::any_of(info.settings.begin(), info.settings.end(), [&](const Setting& s) { return s.name == name; });
    if (!listed) throw std::invalid_argument(info.name + " has no setting '" + name + "'; it has: " + known);
  }
}

std::unique_ptr<World> Engine::build(const Scenario& scenario, const Settings& settings) const {
  require_sound(scenario);
  const std::string missing = needs(scenario).without(info().features).describe();
  if (!missing.empty()) throw std::invalid_argument(info().name + " has no " + missing);
  require_settings(info(), settings);
  return create(scenario, settings);
}

bool setting_bool(const Settings& settings, std::string_view name) {
  return typed<bool>(settings, name, "true or false");
}
double setting_number(const Settings& settings, std::string_view name) {
  return typed<double>(settings, name, "a number");
}
const std::string& setting_text(const Settings& settings, std::string_view name) {
  return typed<std::string>(settings, name, "a word");
}

}  // namespace plumbline
