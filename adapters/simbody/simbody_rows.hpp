// The two rows of this adapter.
#pragma once

#include <memory>

#include "plumbline/core/engine.hpp"

namespace plumbline {

// Rigid unilateral contact and a semi-explicit Euler step.
std::unique_ptr<Engine> make_simbody_rigid();
// Elastic contact with Hunt and Crossley's dissipation, integrated to an accuracy within the step.
std::unique_ptr<Engine> make_simbody_compliant();

}  // namespace plumbline
