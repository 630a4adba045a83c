#include "plumbline/adapters/knob_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline {

double knob_number(const Settings& settings, const std::string& name) {
  const double value = setting_number(settings, name);
  if (std::isnan(value)) throw std::invalid_argument("setting '" + name + "' must be a number, is NaN");
  return value;
}

int knob_count(const Settings& settings, const std::string& name) {
  const double value = setting_number(settings, name);
  if (!(value >= 0 && value <= 1e9 && value == std::floor(value))) {
    throw std::invalid_argument("setting '" + name + "' must be a whole number from 0 to 1000000000, is " +
                                shortest(value));
  }
  return static_cast<int>(value);
}

std::size_t knob_choice(const Settings& settings, const std::string& name, const std::vector<std::string>& words) {
  const std::string& word = setting_text(settings, name);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string known;
  for (const std::string& w : words) known += (known.empty() ? "" : ", ") + w;
  throw std::invalid_argument("setting '" + name + "' must be one of " + known + ", is '" + word + "'");
}

void require_knob_at_least(const Settings& settings, const std::string& name, double low) {
  const double value = setting_number(settings, name);
  if (value >= low && std::isfinite(value)) return;
  throw std::invalid_argument("setting '" + name + "' must be a finite number, at least " + shortest(low) + ", is " +
                              shortest(value));
}

}  // namespace plumbline
