#include "stated_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "expression.hpp"
#include "scene.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

class StatedReference final : public Reference {
 public:
  struct Row {
    double time;
    std::vector<BodyState> states;
  };
  StatedReference(std::string kind, std::string citation, double uncertainty, std::vector<Row> rows)
      : kind_(std::move(kind)), citation_(std::move(citation)), uncertainty_(uncertainty), rows_(std::move(rows)) {}

  // The row nearest in time; who compares looks at known_at first.
  BodyState at(std::size_t body, double t) const override {
    const auto nearest = std::min_element(rows_.begin(), rows_.end(), [&](const Row& a, const Row& b) {
      return std::abs(a.time - t) < std::abs(b.time - t);
    });
    return nearest->states[body];
  }
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return kind_; }
  std::string_view bound_source() const override {
    return kind_ == "table" ? "stated in the file" : "nothing is stated of the motion";
  }

 private:
  std::string kind_, citation_;
  double uncertainty_;
  std::vector<Row> rows_;
};

std::vector<BodyState> initial_states(const Scenario& scenario) {
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  return states;
}

std::string citation_of(const Node& table, const Scenario& scenario) {
  const Node* citation = find(table, "citation");
  return citation != nullptr ? as_text(*citation) : scenario.source;
}

StatedReference::Row read_row(const Node& row, const Parameters& constants, const Scenario& scenario) {
  const Node& time = need(row, "t", "t = 0.03  # s");
  StatedReference::Row result{number(time, constants), initial_states(scenario)};
  if (!(result.time >= 0 && result.time <= scenario.duration * (1 + 1e-12))) {
    fail(time, fmt::format("is {}, outside the duration of {} s", shortest(result.time), shortest(scenario.duration)));
  }
  for (const Entry& entry : row.entries) {
    if (entry.key == "t") continue;
    Node name;
    name.kind = NodeKind::kText;
    name.text = entry.key;
    name.place = entry.key_place;
    name.path = entry.value.path;
    const std::size_t body = body_named(name, scenario.bodies);
    allow_only(entry.value, {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"});
    auto components = components_of(result.states[body]);
    for (const Entry& component : entry.value.entries) {
      std::size_t index = 0;
      while (component_name(index) != component.key) ++index;
      components[index] = number(component.value, constants);
    }
    result.states[body] = state_of(components);
  }
  return result;
}

}  // namespace

std::shared_ptr<const Reference> read_table(const Node& table, const Parameters& constants, Scenario& scenario) {
  allow_only(table, {"kind", "citation", "uncertainty", "row"});
  const double uncertainty = positive_number(
      need(table, "uncertainty", "uncertainty = 1e-6  # half a unit of the last digit printed"), constants);
  std::vector<StatedReference::Row> rows;
  for (const Node& row : tables(table, "row")) {
    rows.push_back(read_row(row, constants, scenario));
    scenario.known_at.push_back(rows.back().time);
  }
  if (rows.empty()) fail(table, "has no row; add [[reference.row]] with t and what is known then");
  for (const double dt : scenario.steps) {
    for (const StatedReference::Row& row : rows) {
      const double steps = row.time / dt;
      if (std::abs(steps - std::round(steps)) > 1e-6) {
        fail(table,
             fmt::format("t = {} is no whole number of steps of {}; change steps", shortest(row.time), shortest(dt)));
      }
    }
  }
  return std::make_shared<StatedReference>("table", citation_of(table, scenario), uncertainty, std::move(rows));
}

std::shared_ptr<const Reference> read_without_motion(const Node& table, Scenario& scenario) {
  allow_only(table, {"kind", "citation"});
  scenario.pointwise = false;
  return std::make_shared<StatedReference>(find(table, "kind")->text, citation_of(table, scenario), 0.0,
                                           std::vector<StatedReference::Row>{{0.0, initial_states(scenario)}});
}

}  // namespace plumbline
