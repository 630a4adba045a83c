// Explicit Euler, in the order of course slide 30: the position moves with the old velocity, the velocity changes by
// the old force.
//
//   x(t+dt) = x(t) + v(t) dt         q(t+dt) = exp(w(t) dt) q(t)
//   v(t+dt) = v(t) + a(t) dt         w(t+dt) = w(t) + alpha(t) dt
//
// Order 1, one evaluation of the forces a step. Slide 29 says that the error falls quadratically: that is the error of
// one step, dt^2/2 x'', and a fixed time holds 1/dt of them.
//
// Range: a damped motion v' = -(c/m) v is stable for dt <= 2 m/c only (|1 - c dt/m| <= 1), and an undamped oscillation
// never: each step multiplies its amplitude by sqrt(1 + (w dt)^2). Hairer, Wanner, Solving ODEs II, section IV.2.
#pragma once

#include <vector>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

class ExplicitEuler final : public Stepper {
 public:
  std::string_view name() const override { return "explicit Euler"; }
  int order() const override { return 1; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override;

 private:
  std::vector<Acceleration> a_;
};

}  // namespace plumbline
