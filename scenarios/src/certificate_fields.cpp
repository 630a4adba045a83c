#include "certificate_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "expression.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

// "upper arm" and x: upper_arm_x.
std::string symbol(const std::string& body, std::string_view component) {
  std::string name = body;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return fmt::format("{}_{}", name, component);
}

// Both sides of the statement and the variables that they read: t and every component of every body's state.
struct CompiledStatement {
  std::vector<std::string> names;
  std::vector<std::string_view> views;
  std::vector<double> slots;
  std::vector<Expression> quantity, equals;  // one each

  explicit CompiledStatement(const Scenario& scenario) {
    names.emplace_back("t");
    for (const Body& body : scenario.bodies) {
      for (std::size_t i = 0; i < kComponentCount; ++i) names.push_back(symbol(body.name, component_name(i)));
    }
    views.assign(names.begin(), names.end());
    slots.assign(names.size(), 0);
  }

  double difference(const Reference& reference, double t) {
    slots[0] = t;
    for (std::size_t body = 0; body * kComponentCount + 1 < slots.size(); ++body) {
      const auto components = components_of(reference.at(body, t));
      std::copy(components.begin(), components.end(),
                slots.begin() + 1 + static_cast<std::ptrdiff_t>(body * kComponentCount));
    }
    return quantity.front()() - equals.front()();
  }
};

std::string written(const Node& node) { return node.kind == NodeKind::kText ? node.text : shortest(node.number); }

Certificate read_certificate(const Node& table, Parameters constants, const Scenario& scenario) {
  allow_only(table, {"quantity", "equals", "time", "within", "source"});
  if (scenario.threshold) constants.emplace_back("exact", scenario.threshold->exact);
  const auto compiled = std::make_shared<CompiledStatement>(scenario);
  const Variables variables{compiled->views, compiled->slots.data()};
  const Node& quantity = need(table, "quantity", "quantity = \"ball_z\"  # BODY_COMPONENT of the reference, and t");
  const Node& equals = need(table, "equals", "equals = 0.5");
  compiled->quantity.emplace_back(quantity, constants, variables);
  compiled->equals.emplace_back(equals, constants, variables);
  Certificate certificate;
  certificate.text = written(quantity) + " = " + written(equals);
  certificate.source = as_text(need(table, "source", "source = \"where it is published, or how it was derived\""));
  certificate.within = positive_number(need(table, "within", "within = 1e-12"), constants);
  if (const Node* time = find(table, "time")) {
    certificate.time = number(*time, constants);
    if (!(*certificate.time >= 0 && *certificate.time <= scenario.duration * (1 + 1e-12))) {
      fail(*time, fmt::format("is {}, outside the duration of {} s", shortest(*certificate.time),
                              shortest(scenario.duration)));
    }
  }
  certificate.difference = [compiled](const Reference& reference, double t) {
    return compiled->difference(reference, t);
  };
  certificate.place = quantity.place;
  return certificate;
}

}  // namespace

std::vector<Certificate> read_certificates(const Node& root, const Parameters& constants, const Scenario& scenario) {
  std::vector<Certificate> certificates;
  for (const Node& table : tables(root, "certificate")) {
    certificates.push_back(read_certificate(table, constants, scenario));
  }
  return certificates;
}

}  // namespace plumbline
