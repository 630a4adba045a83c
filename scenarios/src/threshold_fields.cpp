#include "threshold_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "expression.hpp"
#include "scene.hpp"
#include "spelling.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

// The question, an expression of one body's state at the end of the run.
struct CompiledQuestion {
  std::array<double, kForceSymbols.size()> slots{};
  std::vector<Expression> question;  // one; a vector because it is made after the slots

  bool answer(double t, const BodyState& state) {
    const auto components = components_of(state);
    slots[0] = t;
    std::copy(components.begin(), components.end(), slots.begin() + 1);
    return question.front()() != 0;
  }
};

void check_parameter(const Node& node, const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& [name, value] : scenario.parameters) names.push_back(name);
  if (std::find(names.begin(), names.end(), as_text(node)) != names.end()) {
    const bool swept = std::any_of(scenario.swept.begin(), scenario.swept.end(),
                                   [&](const auto& parameter) { return parameter.first == node.text; });
    if (swept) fail(node, "is swept already; the search varies it, so give it one value under [parameters]");
    return;
  }
  fail(node, fmt::format("there is no parameter '{}'; {}the parameters are: {}", node.text,
                         did_you_mean(node.text, names), fmt::join(names, ", ")));
}

}  // namespace

std::optional<Threshold> read_threshold(const Node& root, const Parameters& constants, const Scenario& scenario,
                                        const ScenarioWith& scenario_with) {
  const Node* table = find(root, "threshold");
  if (table == nullptr) return std::nullopt;
  allow_only(*table, {"parameter", "between", "exact", "resolution", "body", "question", "yes"});
  Threshold threshold;
  const Node& parameter = need(*table, "parameter", "parameter = \"slope\"  # what is varied");
  check_parameter(parameter, scenario);
  threshold.parameter = parameter.text;

  // The range and the exact value must not depend on what is varied.
  Parameters others = constants;
  std::erase_if(others, [&](const auto& constant) { return constant.first == threshold.parameter; });
  const Node& between = need(*table, "between", "between = [10, 40]  # where the answer changes");
  const auto& ends = as_array(between, 2);
  threshold.low = number(ends[0], others);
  threshold.high = number(ends[1], others);
  if (!(threshold.low < threshold.high)) fail(between, "must rise: [low, high]");
  const Node& exact = need(*table, "exact", "exact = \"atan(mu)*180/pi\"");
  threshold.exact = number(exact, others);
  if (!(threshold.low < threshold.exact && threshold.exact < threshold.high)) {
    fail(exact, fmt::format("is {}, outside the range {} to {} in which it is sought", shortest(threshold.exact),
                            shortest(threshold.low), shortest(threshold.high)));
  }
  const Node& resolution = need(*table, "resolution", "resolution = 0.01  # the search ends there");
  threshold.resolution = positive_number(resolution, others);
  if (!(threshold.resolution <= 0.1 * (threshold.high - threshold.low))) {
    fail(resolution, "is more than a tenth of the range; nothing would be found");
  }

  const std::size_t body = body_named(need(*table, "body", "body = \"box\"  # whose state answers"), scenario.bodies);
  const Node& question = need(*table, "question", "question = \"x > 0.01\"  # of its state at the end");
  const auto compiled = std::make_shared<CompiledQuestion>();
  compiled->question.emplace_back(question, others, Variables{kForceSymbols, compiled->slots.data()});
  threshold.question = as_text(question);
  threshold.answer = [compiled, body](const Trajectory& trajectory) {
    const std::size_t last = trajectory.samples() - 1;
    return compiled->answer(trajectory.time(last), trajectory.at(last, body));
  };
  if (const Node* yes = find(*table, "yes")) {
    if (as_text(*yes) != "above" && yes->text != "below") {
      fail(*yes, "must be \"above\" or \"below\": where the answer is yes for the truth");
    }
    threshold.exact_above = yes->text == "above";
  }
  threshold.with = [name = threshold.parameter, scenario_with](double value) { return scenario_with(name, value); };
  return threshold;
}

}  // namespace plumbline
