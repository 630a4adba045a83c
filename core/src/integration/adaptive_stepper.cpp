#include "plumbline/core/integration/adaptive_stepper.hpp"

#include "plumbline/core/integration/body_equations.hpp"

namespace plumbline {

void AdaptiveStepper::step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) {
  require_step(t, dt);
  if (states.empty()) return;
  const BodyEquations equations(field, states.size());
  solver_.start(t, BodyEquations::pack(states));
  solver_.advance_to(equations, t + dt);
  BodyEquations::unpack(solver_.state(), states);
}

}  // namespace plumbline
