#include "plumbline/core/engine.hpp"

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
