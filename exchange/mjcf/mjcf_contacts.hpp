// Which shapes of a model of MuJoCo collide, and with what friction.
#pragma once

#include "compiled_model.hpp"

namespace plumbline {

// Whether the shape takes part in any contact: by its masks, or in a listed pair.
bool may_collide(const mjModel& m, int geom);

// Adds a contact to the draft for every pair of shapes on different links that MuJoCo lets collide.
void add_contacts(const CompiledModel& model, const std::vector<std::size_t>& link_of_body, double restitution,
                  WorldDraft& draft);

}  // namespace plumbline
