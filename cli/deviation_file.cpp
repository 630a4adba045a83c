#include "deviation_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "plumbline/core/metric.hpp"
#include "plumbline/harness/conformance.hpp"
#include "selection.hpp"
#include "usage_error.hpp"

namespace plumbline {
namespace {

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  DeviationLists read() {
    toml::table root;
    try {
      root = toml::parse_file(file_);
    } catch (const toml::parse_error& e) {
      throw UsageError(fmt::format("{}:{}:{}: {}", file_, e.source().begin.line, e.source().begin.column,
                                   std::string_view(e.description())));
    }
    for (auto&& [key, node] : root) {
      if (key.str() == "deviation") {
        each(node, [&](const toml::node& entry) { add_deviation(require_table(entry)); });
      } else if (key.str() == "conformance") {
        each(node, [&](const toml::node& entry) { add_known_failure(require_table(entry)); });
      } else {
        fail(node, fmt::format("unknown key '{}'; only [[deviation]] and [[conformance]] stand here", key.str()));
      }
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw UsageError(fmt::format("{}:{}:{}: {}", file_, node.source().begin.line, node.source().begin.column, what));
  }

  const toml::table& require_table(const toml::node& node) const {
    if (!node.is_table()) fail(node, "a table is needed here");
    return *node.as_table();
  }

  std::string text(const toml::node& node) const {
    const auto value = node.value<std::string>();
    if (!value) fail(node, "a text in quotes is needed here");
    return *value;
  }

  double number(const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value) fail(node, "a number is needed here");
    return *value;
  }

  template <typename Take>
  void each(const toml::node& node, const Take& take) const {
    if (!node.is_array()) fail(node, "a list in [ ] is needed here");
    for (const toml::node& item : *node.as_array()) take(item);
  }

  SourcePlace place_of(const toml::table& entry) const {
    return {file_, static_cast<int>(entry.source().begin.line), static_cast<int>(entry.source().begin.column)};
  }

  Profile profile(const toml::node& node) const {
    const std::string name = text(node);
    if (name != "default" && name != "matched") fail(node, "profile is \"default\" or \"matched\"");
    return name == "default" ? Profile::kDefault : Profile::kMatched;
  }

  // The keys that both kinds of entry have: rows, profile, cause and link. False for any other.
  template <typename Entry>
  bool take_common(Entry& entry, std::string_view key, const toml::node& node) const {
    if (key == "engines") {
      each(node, [&](const toml::node& item) { entry.engines.push_back(text(item)); });
    } else if (key == "profile") {
      entry.profile = profile(node);
    } else if (key == "why") {
      entry.why = text(node);
    } else if (key == "link") {
      entry.link = text(node);
    } else {
      return false;
    }
    return true;
  }

  std::string check_name(const toml::node& node) const {
    std::string name = text(node);
    if (find_conformance_check(name) == nullptr) {
      fail(node, fmt::format("there is no check '{}'; `plumbline adapter test --list` shows them", name));
    }
    return name;
  }

  void add_known_failure(const toml::table& entry) {
    KnownFailure known;
    std::vector<std::string> checks;  // that one cause breaks
    known.place = place_of(entry);
    for (auto&& [key, node] : entry) {
      if (key.str() == "check") {
        checks.push_back(check_name(node));
      } else if (key.str() == "checks") {
        each(node, [&](const toml::node& item) { checks.push_back(check_name(item)); });
      } else if (!take_common(known, key.str(), node)) {
        fail(node, fmt::format("unknown key '{}'; a known failure has check or checks, engines, profile, why, link",
                               key.str()));
      }
    }
    if (checks.empty()) fail(entry, "a known failure must name its check");
    if (known.why.empty()) fail(entry, "a known failure must say why: the cause is the point of the list");
    for (const std::string& check : checks) {
      known.check = check;
      result_.known_failures.push_back(known);
    }
  }

  Verdict ending(const toml::node& node) const {
    const auto verdict = verdict_named(text(node));
    for (const Verdict known : {Verdict::kError, Verdict::kCrashed, Verdict::kTimedOut, Verdict::kDiverged}) {
      if (verdict == known) return known;
    }
    fail(node, "ends is \"error\", \"crashed\", \"timed_out\" or \"diverged\"");
  }

  void add_deviation(const toml::table& entry) {
    Deviation base;
    base.place = place_of(entry);
    const toml::table* limits = nullptr;
    const toml::node* ends = nullptr;
    for (auto&& [key, node] : entry) {
      const std::string_view name = key.str();
      if (take_common(base, name, node)) continue;
      if (name == "scenario") {
        base.scenario = text(node);
      } else if (name == "parameters") {
        for (auto&& [parameter, value] : require_table(node)) {
          base.parameters.emplace_back(std::string(parameter.str()), number(value));
        }
      } else if (name == "dt") {
        each(node, [&](const toml::node& item) {
          base.dt.push_back(item.is_string() ? parse_step(text(item)) : number(item));
        });
      } else if (name == "limits") {
        limits = &require_table(node);
      } else if (name == "ends") {
        ends = &node;
      } else {
        fail(node, fmt::format("unknown key '{}'; a deviation has engines, scenario, parameters, profile, dt, limits "
                               "or ends, why, link",
                               name));
      }
    }
    if (base.scenario.empty()) fail(entry, "a deviation must name its scenario");
    if (base.why.empty()) fail(entry, "a deviation must say why: the cause is the point of the list");
    if (ends != nullptr) {
      if (limits != nullptr) fail(*ends, "a run that ends so has no gates; write limits in an entry of its own");
      base.ends = ending(*ends);
      result_.deviations.push_back(base);
      return;
    }
    if (limits == nullptr || limits->empty()) fail(entry, "a deviation must give limits = { \"metric\" = number }");
    for (auto&& [metric, value] : *limits) {
      if (find_metric(metric.str()) == nullptr) fail(value, fmt::format("there is no metric '{}'", metric.str()));
      Deviation deviation = base;
      deviation.metric = metric.str();
      deviation.limit = number(value);
      if (!(deviation.limit >= 0)) fail(value, "a limit must be >= 0; write inf for 'however large'");
      result_.deviations.push_back(std::move(deviation));
    }
  }

  std::string file_;
  DeviationLists result_;
};

}  // namespace

DeviationLists read_deviations(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  return Reader(file.string()).read();
}

}  // namespace plumbline
