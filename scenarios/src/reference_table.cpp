#include "reference_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "closed_form.hpp"
#include "computed_reference.hpp"
#include "solution.hpp"
#include "spelling.hpp"
#include "stated_reference.hpp"

namespace plumbline {
namespace {

std::shared_ptr<const Reference> read_solution(const Node& table, const Scenario& scenario) {
  allow_only(table, {"kind", "solution", "citation"});
  const Node& name = need(table, "solution", "solution = \"planar_pendulum\"");
  std::vector<std::string> names;
  for (const Solution& solution : solutions()) names.emplace_back(solution.name);
  const auto found = std::find(names.begin(), names.end(), as_text(name));
  if (found == names.end()) {
    fail(name, fmt::format("unknown solution '{}'; {}known: {}", name.text, did_you_mean(name.text, names),
                           fmt::join(names, ", ")));
  }
  const Solution& solution = solutions()[static_cast<std::size_t>(found - names.begin())];
  const Node* citation = find(table, "citation");
  try {
    return solution.solve(scenario, citation != nullptr ? as_text(*citation) : std::string(solution.citation));
  } catch (const std::invalid_argument& e) {
    fail(name, fmt::format("{} does not solve this scenario: {}", solution.name, e.what()));
  }
}

}  // namespace

std::shared_ptr<const Reference> read_reference(const Node& root, const Parameters& constants, Scenario& scenario) {
  static const std::vector<std::string> kKinds = {"closed_form", "solution",   "ode",      "events",
                                                  "table",       "invariants", "threshold"};
  const Node& table = as_table(need(root, "reference", "[reference] with kind = \"closed_form\" and the solution"));
  const Node& kind = need(table, "kind", "kind = \"closed_form\"  # or " + fmt::format("{}", fmt::join(kKinds, ", ")));
  if (const bool asks = as_text(kind) == "threshold"; asks != (find(root, "threshold") != nullptr)) {
    fail(kind, asks ? "there is no [threshold]; add the question and its exact answer"
                    : "a [threshold] asks for a value, not for a motion; write kind = \"threshold\"");
  }
  if (kind.text == "closed_form") return read_closed_form(table, constants, scenario);
  if (kind.text == "solution") return read_solution(table, scenario);
  if (kind.text == "ode" || kind.text == "events") return read_computed(table, constants, scenario);
  if (kind.text == "table") return read_table(table, constants, scenario);
  if (kind.text == "invariants" || kind.text == "threshold") return read_without_motion(table, scenario);
  fail(kind, fmt::format("unknown kind '{}'; {}known: {}", kind.text, did_you_mean(kind.text, kKinds),
                         fmt::join(kKinds, ", ")));
}

}  // namespace plumbline
