// Velocity Verlet: the positions of course slides 39-41, with the velocity carried along instead of derived.
//
//   x(t+dt) = x(t) + v(t) dt + a(t) dt^2/2          q(t+dt) = exp(w dt + alpha dt^2/2) q(t)
//   v(t+dt) = v(t) + (a(t) + a(t+dt)) dt/2          w(t+dt) = w(t) + (alpha(t) + alpha(t+dt)) dt/2
//
// Order 2. The force is evaluated at the end of the step too. Where it depends on velocities it is given the
// predictor v(t) + a(t) dt, right to dt^2, so that drag and the gyroscopic term keep the order. (An engine that holds
// the force of the start over the whole step, a(t+dt) := a(t), has order 1: see kinetics/scheme.hpp.)
//
// It keeps nothing between steps, and so needs two evaluations a step and no restart. The second one may serve the
// next step where forces do not depend on velocities; position_verlet.hpp shows that form.
//
// Range: stable up to w dt = 2; time-reversible and area-preserving for forces that depend on positions only. The step
// of the attitude misses (w x alpha) dt^3/12 and the change of alpha, both of the order of the method's own error.
// Source: Swope, Andersen, Berens, Wilson, J. Chem. Phys. 76 (1982) 637.
#pragma once

#include <vector>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

class VelocityVerlet final : public Stepper {
 public:
  std::string_view name() const override { return "velocity Verlet"; }
  int order() const override { return 2; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override;

 private:
  std::vector<Acceleration> a_, a_end_;
};

}  // namespace plumbline
