#include "gate_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "expression.hpp"
#include "plumbline/core/metric.hpp"
#include "scene.hpp"
#include "spelling.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

struct CompiledLimit {
  std::array<double, kGateSymbols.size()> slots{};
  std::vector<Expression> limit;  // one; a vector because it is made after the slots

  double evaluate(const GateContext& context) {
    slots = {context.dt, context.steps, context.unit_roundoff};
    return limit.front()();
  }
};

Parameters with_gate_constants(Parameters constants, const Scenario& scenario) {
  const Scales& s = scenario.scales;
  const std::array<double, kGateConstants.size()> values = {scenario.duration, s.length,   s.time,      s.mass,
                                                            s.velocity(),      s.energy(), s.momentum()};
  for (std::size_t i = 0; i < values.size(); ++i) constants.emplace_back(kGateConstants[i], values[i]);
  return constants;
}

const Metric& read_metric(const Node& node, const Scenario& scenario) {
  const Metric* metric = find_metric(as_text(node));
  if (metric == nullptr) {
    std::vector<std::string> names;
    for (const Metric& m : metrics()) names.emplace_back(m.name);
    fail(node, fmt::format("unknown metric '{}'; {}known: {}", node.text, did_you_mean(node.text, names),
                           fmt::join(names, ", ")));
  }
  if (!metric->applies(scenario)) {
    const std::string_view quantity = std::string_view(node.text).substr(0, node.text.find('.'));
    const char* why = quantity == "threshold"         ? "there is no question; add a [threshold]"
                      : scenario.threshold            ? "a threshold is measured by threshold.error"
                      : quantity.starts_with("event") ? "there is no event within the duration; add an [[event]]"
                      : quantity == "joint_gap"       ? "there is no joint; add a [[joint]]"
                                                      : "the reference does not know it; gate what it knows";
    fail(node, fmt::format("{} means nothing here: {}", node.text, why));
  }
  return *metric;
}

// A limit that turns out to be zero, negative or NaN would only show as a failed run, blamed on the engine.
void check_limit(const Node& node, const Gate& gate, const Scenario& scenario) {
  for (double dt : scenario.steps) {
    for (double unit_roundoff : {0x1p-24, 0x1p-53}) {
      const double limit = gate.limit({dt, static_cast<double>(scenario.step_count(dt)), unit_roundoff});
      if (std::isfinite(limit) && limit > 0) continue;
      fail(node, fmt::format("must be finite and > 0, is {} at dt = {}; a rounding term such as "
                             "steps*unit_roundoff*length_scale keeps it above zero",
                             shortest(limit), shortest(dt)));
    }
  }
}

Gate read_gate(const Node& table, const Parameters& constants, const Scenario& scenario) {
  allow_only(table, {"metric", "limit", "reason"});
  Gate gate;
  gate.metric = read_metric(need(table, "metric", "metric = \"position.max\""), scenario).name;
  gate.reason = as_text(need(table, "reason", "reason = \"why this limit and no other\""));
  const Node& limit = need(table, "limit", "limit = \"...\"  # in the unit of the metric");
  auto compiled = std::make_shared<CompiledLimit>();
  compiled->limit.emplace_back(limit, constants, Variables{kGateSymbols, compiled->slots.data()});
  gate.limit = [compiled](const GateContext& context) { return compiled->evaluate(context); };
  gate.limit_text = limit.kind == NodeKind::kText ? limit.text : shortest(limit.number);
  gate.place = limit.place;
  check_limit(limit, gate, scenario);
  return gate;
}

Event read_event(const Node& table, const Parameters& constants, const Scenario& scenario) {
  allow_only(table, {"name", "between", "time"});
  const Node& name = need(table, "name", "name = \"impact\"");
  const Node& between = need(table, "between", "between = [\"a\", \"b\"]");
  const auto& pair = as_array(between, 2);
  Event event;
  event.name = as_text(name);
  event.body_a = body_named(pair[0], scenario.bodies);
  event.body_b = body_named(pair[1], scenario.bodies);
  if (event.body_a == event.body_b) fail(between, "a body cannot meet itself; name two bodies");
  if (!scenario.contact) fail(between, "without [contact] nothing collides; add [contact] or remove the event");
  const Node& time = need(table, "time", "time = \"sqrt(2*h/g)\"  # s");
  event.time = number(time, constants);
  if (!(event.time >= 0)) fail(time, fmt::format("must be >= 0, is {}", shortest(event.time)));
  return event;
}

}  // namespace

std::vector<Event> read_events(const Node& root, const Parameters& constants, const Scenario& scenario) {
  std::vector<Event> events;
  std::vector<std::string> names;
  for (const Node& table : tables(root, "event")) {
    Event event = read_event(table, constants, scenario);
    if (std::find(names.begin(), names.end(), event.name) != names.end()) {
      fail(need(table, "name", ""), fmt::format("the name '{}' is used twice; give each event its own", event.name));
    }
    names.push_back(event.name);
    if (event.time <= scenario.duration) events.push_back(std::move(event));
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.time < b.time; });
  return events;
}

std::vector<Gate> read_gates(const Node& root, const Parameters& constants, const Scenario& scenario) {
  const Parameters all = with_gate_constants(constants, scenario);
  std::vector<Gate> gates;
  for (const Node& table : tables(root, "gate")) gates.push_back(read_gate(table, all, scenario));
  return gates;
}

}  // namespace plumbline
