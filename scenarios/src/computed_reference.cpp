#include "computed_reference.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "expression.hpp"
#include "plumbline/core/events/event_reference.hpp"
#include "plumbline/core/integration/integrated_reference.hpp"

namespace plumbline {

std::shared_ptr<const Reference> read_computed(const Node& table, const Parameters& constants,
                                               const Scenario& scenario) {
  allow_only(table, {"kind", "citation", "uncertainty"});
  const Node* citation = find(table, "citation");
  const std::string source = citation != nullptr ? as_text(*citation) : scenario.source;
  const Node* stated = find(table, "uncertainty");
  const Node& kind = need(table, "kind", "");
  try {
    if (kind.text == "events") return std::make_shared<EventReference>(scenario, source);
    const Node& uncertainty =
        stated != nullptr ? *stated : need(table, "uncertainty", "uncertainty = 1e-12  # plumbline certify checks it");
    return std::make_shared<IntegratedReference>(scenario, source, positive_number(uncertainty, constants));
  } catch (const std::invalid_argument& e) {
    fail(kind, fmt::format("{} does not solve this scenario: {}", kind.text, e.what()));
  }
}

}  // namespace plumbline
