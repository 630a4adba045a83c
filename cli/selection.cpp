#include "selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>

#include "usage_error.hpp"

namespace plumbline {
double parse_number(std::string_view text) {
  const auto decimal = [](std::string_view t) {
    double value = 0;
    const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), value);
    return error == std::errc() && end == t.data() + t.size() ? value : std::nan("");
  };
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return decimal(text);
  return decimal(text.substr(0, slash)) / decimal(text.substr(slash + 1));
}

double parse_step(std::string_view text) {
  const double value = parse_number(text);
  if (!(value > 0) || !std::isfinite(value)) {
    throw UsageError(fmt::format("'{}' is no time step: write seconds as 0.02 or as a fraction, 1/240", text));
  }
  return value;
}

std::vector<double> parse_steps(const std::vector<std::string>& texts) {
  std::vector<double> steps;
  steps.reserve(texts.size());
  for (const std::string& text : texts) steps.push_back(parse_step(text));
  return steps;
}

Overrides parse_parameters(const std::vector<std::string>& assignments) {
  Overrides overrides;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError(fmt::format("-P {}: write NAME=VALUE or NAME=VALUE,VALUE,...", assignment));
    }
    std::vector<double>& values = overrides[assignment.substr(0, equals)];
    std::string_view rest = std::string_view(assignment).substr(equals + 1);
    while (true) {
      const std::size_t comma = rest.find(',');
      const double value = parse_number(rest.substr(0, comma));
      if (!std::isfinite(value)) {
        throw UsageError(fmt::format("-P {}: '{}' is no number", assignment, rest.substr(0, comma)));
      }
      values.push_back(value);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
  }
  return overrides;
}

std::function<bool(const std::string&)> name_filter(const std::vector<std::string>& patterns) {
  std::vector<std::regex> wanted, unwanted;
  for (const std::string& pattern : patterns) {
    const bool negated = pattern.starts_with('-');
    try {
      (negated ? unwanted : wanted).emplace_back(negated ? pattern.substr(1) : pattern);
    } catch (const std::regex_error& e) {
      throw UsageError(fmt::format("--filter '{}' is no regular expression: {}", pattern, e.what()));
    }
  }
  return [wanted, unwanted](const std::string& name) {
    const auto matches = [&](const std::regex& pattern) { return std::regex_search(name, pattern); };
    return (wanted.empty() || std::any_of(wanted.begin(), wanted.end(), matches)) &&
           std::none_of(unwanted.begin(), unwanted.end(), matches);
  };
}

std::vector<Profile> profiles_named(std::string_view word) {
  if (word == "default") return {Profile::kDefault};
  if (word == "matched") return {Profile::kMatched};
  return {Profile::kDefault, Profile::kMatched};
}

bool selects_engine(std::string_view selector, std::string_view row) {
  return row == selector || (row.starts_with(selector) && row.size() > selector.size() && row[selector.size()] == '-');
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

}  // namespace plumbline
