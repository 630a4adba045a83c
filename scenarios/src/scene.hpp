// Bodies and the forces on them, read from a scenario file.
#pragma once

#include <vector>

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// [[body]]: at least one.
std::vector<Body> read_bodies(const Node& root, const Parameters& constants);

// [contact]; nothing when the table is absent.
std::optional<ContactMaterial> read_contact(const Node& root, const Parameters& constants);

// [[force]]. Evaluating a law writes into variables that its copies share: one thread at a time.
std::vector<ForceLaw> read_forces(const Node& root, const Parameters& constants, const std::vector<Body>& bodies);

// Index of the body that the node names; throws when there is none.
std::size_t body_named(const Node& name, const std::vector<Body>& bodies);

}  // namespace plumbline
