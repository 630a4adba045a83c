// Semi-implicit (symplectic) Euler: the velocity first, and the position moves with the new one. What most engines do.
//
//   v(t+dt) = v(t) + a(t) dt         w(t+dt) = w(t) + alpha(t) dt
//   x(t+dt) = x(t) + v(t+dt) dt      q(t+dt) = exp(w(t+dt) dt) q(t)
//
// Only two lines of course slide 30 change places. The order stays 1 and the cost one evaluation of the forces a step,
// but for forces that depend on positions the step now keeps areas in phase space: the energy of an oscillator swings
// by a part w dt/2 of itself instead of growing. Stable up to w dt = 2. About a parabola it falls ahead by g t dt/2,
// where explicit Euler lags behind by as much. Damping is treated explicitly: stable for dt <= 2 m/c. Source: Hairer,
// Lubich, Wanner, Geometric Numerical Integration, 2nd ed. 2006, sections I.1.2 and VI.3.
#pragma once

#include <vector>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

class SemiImplicitEuler final : public Stepper {
 public:
  std::string_view name() const override { return "semi-implicit Euler"; }
  int order() const override { return 1; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override;

 private:
  std::vector<Acceleration> a_;
};

}  // namespace plumbline
