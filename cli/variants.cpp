#include "variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "selection.hpp"
#include "usage_error.hpp"

namespace plumbline {
namespace {

SettingValue parse_value(const SettingSweep& sweep, const Setting& setting, const std::string& text) {
  if (std::holds_alternative<std::string>(setting.default_value)) return text;
  if (std::holds_alternative<bool>(setting.default_value)) {
    if (text == "true" || text == "false") return text == "true";
    throw UsageError(fmt::format("--set {}: '{}' is neither true nor false", sweep.argument, text));
  }
  const double value = parse_number(text);
  if (std::isnan(value)) throw UsageError(fmt::format("--set {}: '{}' is no number", sweep.argument, text));
  return value;
}

const Setting* setting_named(const EngineInfo& info, const std::string& name) {
  const auto found = std::find_if(info.settings.begin(), info.settings.end(),
                                  [&](const Setting& setting) { return setting.name == name; });
  return found == info.settings.end() ? nullptr : &*found;
}

EngineRow with_setting(EngineRow row, const SettingSweep& sweep, const std::string& text) {
  const SettingValue value = parse_value(sweep, *setting_named(row.info, sweep.option), text);
  for (Setting& setting : row.info.settings) {
    if (setting.name == sweep.option) setting.default_value = setting.matched_value = value;
  }
  const std::string plain = row.info.name;
  row.info.name += fmt::format("{}{}={}", row.changed.empty() ? '@' : ',', sweep.option, text);
  row.changed[sweep.option] = value;
  // An entry for all rows holds for this one too; one that names rows must name this one.
  for (Deviation& deviation : row.deviations) {
    std::replace(deviation.engines.begin(), deviation.engines.end(), plain, row.info.name);
  }
  return row;
}

[[noreturn]] void refuse(const EngineInventory& engines, const SettingSweep& sweep) {
  std::vector<std::string> rows, options;
  bool named = false;
  for (const EngineRow& row : engines.rows) {
    rows.push_back(row.info.name);
    if (!selects_engine(sweep.engine, row.worker_name)) continue;
    named = true;
    for (const Setting& setting : row.info.settings) {
      if (std::find(options.begin(), options.end(), setting.name) == options.end()) options.push_back(setting.name);
    }
  }
  if (!named) {
    throw UsageError(
        fmt::format("--set {}: no engine '{}' is selected; there are {}", sweep.argument, sweep.engine, joined(rows)));
  }
  throw UsageError(fmt::format("--set {}: {} has no setting '{}'; it has {} (plumbline list --settings)",
                               sweep.argument, sweep.engine, sweep.option, joined(options)));
}

}  // namespace

std::vector<SettingSweep> parse_settings(const std::vector<std::string>& arguments) {
  std::vector<SettingSweep> sweeps;
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('='), dot = argument.find('.');
    const bool complete = equals != std::string::npos && dot < equals && dot > 0 && dot + 1 < equals;
    if (!complete || equals + 1 == argument.size()) {
      throw UsageError(fmt::format("--set {}: write ENGINE.OPTION=VALUE or ENGINE.OPTION=VALUE,VALUE,...", argument));
    }
    SettingSweep sweep{argument, argument.substr(0, dot), argument.substr(dot + 1, equals - dot - 1), {}};
    for (std::size_t start = equals + 1; start <= argument.size();) {
      const std::size_t end = std::min(argument.find(',', start), argument.size());
      sweep.values.push_back(argument.substr(start, end - start));
      start = end + 1;
    }
    if (std::find(sweep.values.begin(), sweep.values.end(), "") != sweep.values.end()) {
      throw UsageError(fmt::format("--set {}: a value is empty; write VALUE,VALUE,...", argument));
    }
    for (std::size_t i = 1; i < sweep.values.size(); ++i) {
      const auto first = sweep.values.begin(), here = first + static_cast<std::ptrdiff_t>(i);
      if (std::find(first, here, *here) != here) {
        throw UsageError(fmt::format("--set {}: the value {} is there twice", argument, *here));
      }
    }
    for (const SettingSweep& other : sweeps) {
      if (other.engine == sweep.engine && other.option == sweep.option) {
        throw UsageError(fmt::format("--set {}: {}.{} is set twice; give all its values at once", argument,
                                     sweep.engine, sweep.option));
      }
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

void vary_settings(EngineInventory& engines, const std::vector<SettingSweep>& sweeps) {
  for (const SettingSweep& sweep : sweeps) {
    std::vector<EngineRow> varied;
    bool applied = false;
    for (EngineRow& row : engines.rows) {
      const bool meant = selects_engine(sweep.engine, row.worker_name) && setting_named(row.info, sweep.option);
      if (!meant) {
        varied.push_back(std::move(row));
        continue;
      }
      applied = true;
      for (const std::string& value : sweep.values) varied.push_back(with_setting(row, sweep, value));
    }
    engines.rows = std::move(varied);
    if (!applied) refuse(engines, sweep);
  }
}

}  // namespace plumbline
