// The ship of course slides 9-13: constant thrust against viscous drag.
//
//   m dv/dt = T - c v
//   v(t) = T/c - (T/c - v0) e^(-ct/m)                                   (slide 12)
//   s(t) = (T/c) t + (T/c - v0)(m/c)(e^(-ct/m) - 1)                     (slide 13)
//   terminal velocity T/c, for c > 0
//
// Both slides are right as formulas. As arithmetic they lose digits for small x = ct/m, where slide 13 takes the
// difference of two large numbers, and they have no value at c = 0. The same functions without either fault:
//
//   v = v0 + (a0 t) (1 - e^-x)/x        s = v0 t + (a0 t^2) (e^-x - 1 + x)/x^2        a0 = (T - c v0)/m
//
// Range: m > 0, c >= 0, t of either sign as long as e^(-ct/m) is finite. Relative error a few 1e-16 of the terms.
#pragma once

namespace plumbline {

class ShipWithDrag {
 public:
  // mass [kg], thrust [N], drag [N s/m], velocity v0 at t = 0 [m/s]; starts at s = 0. Throws std::invalid_argument
  // unless mass > 0, drag >= 0 and all are finite.
  ShipWithDrag(double mass, double thrust, double drag, double v0);

  double position(double t) const;   // s [m]
  double velocity(double t) const;   // v [m/s]
  double terminal_velocity() const;  // T/c [m/s], infinite without drag, with the sign of the thrust

 private:
  double mass_, thrust_, drag_, v0_;
};

}  // namespace plumbline
