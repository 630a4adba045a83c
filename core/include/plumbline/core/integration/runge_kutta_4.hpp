// The classical Runge-Kutta method of order 4, for attitudes in the form of Munthe-Kaas.
//
// With y = (x, v, phi, w), where the attitude is q = exp(phi) q(t) and phi = 0 at the start of the step,
//
//   y' = f(t, y) = (v, a, dexp_phi^-1(w), alpha)
//   k1 = f(t, y)   k2 = f(t + dt/2, y + dt/2 k1)   k3 = f(t + dt/2, y + dt/2 k2)   k4 = f(t + dt, y + dt k3)
//   y(t+dt) = y + dt/6 (k1 + 2 k2 + 2 k3 + k4)
//
// Order 4, four evaluations a step. The attitude never leaves the group: each stage turns q(t) by its own phi. Using w
// in place of dexp^-1(w) would cost one order already at the second (see attitude.hpp).
//
// Range: an undamped oscillation is stable up to w dt = 2 sqrt(2) = 2.828 (and loses a part (w dt)^6/144 of its
// amplitude a step), damping up to dt = 2.785 m/c. Neither reversible nor area-preserving: the energy drifts, slowly.
// A step must turn a body by less than a whole turn.
// Source: Kutta, Z. Math. Phys. 46 (1901) 435; Munthe-Kaas, BIT 38 (1998) 92; limits from R(z) = 1 + z + z^2/2 + z^3/6
// + z^4/24, Hairer, Wanner, Solving ODEs II, section IV.2.
#pragma once

#include <vector>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

class RungeKutta4 final : public Stepper {
 public:
  std::string_view name() const override { return "Runge-Kutta 4"; }
  int order() const override { return 4; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override;

 private:
  // The rate of change of one body in the coordinates of this step.
  struct Rate {
    Vec3 p = Vec3::Zero();    // [m/s]
    Vec3 phi = Vec3::Zero();  // [rad/s]
    Vec3 v = Vec3::Zero();    // [m/s^2]
    Vec3 w = Vec3::Zero();    // [rad/s^2]
  };

  std::vector<BodyState> stage_;
  std::vector<Acceleration> a_;
  std::vector<Rate> k_;    // of the latest stage
  std::vector<Rate> sum_;  // k1 + 2 k2 + 2 k3 + k4
};

}  // namespace plumbline
