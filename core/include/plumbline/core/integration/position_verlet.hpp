// Position Verlet, course slides 39-41: the next position from the two before it, without a velocity.
//
//   s(t+dt) = 2 s(t) - s(t-dt) + a(t) dt^2          (slide 39)
//   v(t)    = (s(t+dt) - s(t-dt))/(2 dt)            (slide 39)
//
// Order 2, one evaluation of the forces a step. Slide 40's O(dt^4) is the error of one step; the 1/dt steps of a fixed
// time add it up twice, once into the differences s(t+dt) - s(t) and once more into s: two powers less.
//
// The slide leaves two things open.
//
// Start-up. Slide 41 asks for positions at two times, a body has a position and a velocity. The missing one is
// s(-dt) = s(0) - v(0) dt + a(0) dt^2/2, right to dt^3. Without the last term (a step of Euler) its error a dt^2/2 acts
// like a wrong v(0), off by a dt/2, and the whole motion is of order 1 only.
//
// Time of the velocity. v(t) needs the position after t. So a step ends with the force at its end, s(t+dt) is computed
// one step ahead, and `states` then hold position and velocity of the same instant, both of order 2. A force that
// depends on the velocity is given v(t) ~ (s(t) - s(t-dt))/dt + a(t-dt) dt/2, right to dt^2, which keeps the order.
//
// Rotation has the same form. Let phi(t) be the turn that leads from q(t-dt) to q(t). By the series of the exponential
// the turns to the next and from the previous attitude differ by alpha dt^2 + O(dt^4), and their mean is w dt +
// O(dt^3):
//
//   phi(t+dt) = phi(t) + alpha(t) dt^2,   q(t+dt) = exp(phi(t+dt)) q(t),   w(t) = (phi(t+dt) + phi(t))/(2 dt)
//
// Range: stable up to w dt = 2, time-reversible and area-preserving for forces that depend on positions. The
// subtraction 2 s(t) - s(t-dt) rounds at the size of s: for steps so small that a dt^2 nears 1e-16 s use velocity
// Verlet, which gives the same positions. Source: Verlet, Phys. Rev. 159 (1967) 98; Hairer, Lubich, Wanner, Acta
// Numerica 12 (2003) 399.
#pragma once

#include <vector>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

// Starts anew by itself from position and velocity whenever dt or the states differ from what the last step left, so
// that an impact, which changes velocities only, is not lost.
class PositionVerlet final : public Stepper {
 public:
  std::string_view name() const override { return "position Verlet"; }
  int order() const override { return 2; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override;
  void restart() override { memory_.clear(); }

 private:
  struct Memory {
    Vec3 p_previous;    // s(t-dt) [m]
    Vec3 turn_W;        // phi(t), from the previous attitude to this one [rad]
    BodyState current;  // as the last step left it
  };
  bool continues(double dt, std::span<const BodyState> states) const;
  void start(const AccelerationField& field, double t, double dt, std::span<const BodyState> states);

  std::vector<Memory> memory_;
  std::vector<Acceleration> a_;  // at the current states
  double dt_ = 0;
};

}  // namespace plumbline
