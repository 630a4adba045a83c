// Second sources of a reference, read from a scenario file.
#pragma once

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// [[certificate]]: a quantity of the reference that a published value or a second derivation states.
std::vector<Certificate> read_certificates(const Node& root, const Parameters& constants, const Scenario& scenario);

}  // namespace plumbline
