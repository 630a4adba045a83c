// A scenario's joint as one of ODE.
#pragma once

#include <ode/ode.h>

#include "plumbline/core/joints/joint.hpp"

namespace plumbline {

// Ties b to a, null for the world, where both stand now. The world owns the joint. A stop corrects the share `stop_erp`
// of what it was passed by in each step.
void add_ode_joint(dWorldID world, const Joint& joint, dBodyID a, dBodyID b, double stop_erp);

}  // namespace plumbline
