#include "plumbline/core/scenario.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace plumbline {

std::string shortest(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

std::string Scenario::case_name() const {
  std::string name = id;
  char separator = '/';
  for (const auto& [key, value] : swept) {
    name += separator + key + '=' + shortest(value);
    separator = ',';
  }
  return name;
}

std::size_t Scenario::step_count(double dt) const {
  const double ratio = duration / dt;
  const double nearest = std::round(ratio);
  const bool whole_but_for_rounding = std::abs(ratio - nearest) <= 1e-9 * nearest;
  return static_cast<std::size_t>(whole_but_for_rounding ? nearest : std::floor(ratio));
}

std::size_t Scenario::body_index(const std::string& name) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) return i;
  }
  throw std::out_of_range("scenario " + id + " has no body '" + name + "'");
}

void evaluate_forces(const Scenario& scenario, double t, std::span<const BodyState> states,
                     std::span<Wrench> wrenches) {
  std::fill(wrenches.begin(), wrenches.end(), Wrench{});
  for (const ForceLaw& law : scenario.forces) {
    const Wrench wrench = law.evaluate(t, states[law.body]);
    wrenches[law.body].f_W += wrench.f_W;
    wrenches[law.body].tau_W += wrench.tau_W;
  }
}

}  // namespace plumbline
