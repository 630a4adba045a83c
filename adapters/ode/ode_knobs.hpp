// The knobs of ODE, each written once.
#pragma once

#include "plumbline/adapters/knob_table.hpp"

namespace plumbline {

enum class OdeSolver { kStep, kQuickStep };
enum class OdeFriction { kForceLimit, kPyramid, kAlignedPyramid };

struct OdeKnobs {
  double erp, cfm, stop_erp, max_correcting_velocity;
  bool correct_within_gravity_step;
  double surface_layer, bounce_threshold;
  OdeFriction friction;
  bool auto_disable;
  double linear_damping, angular_damping;
  bool gyroscopic;
  // Of QuickStep only.
  int iterations = 0;
  double over_relaxation = 0;
};

// The knobs that a row with that solver has.
KnobTable<OdeKnobs> ode_knob_table(OdeSolver solver);

}  // namespace plumbline
