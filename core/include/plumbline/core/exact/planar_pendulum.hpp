// The plane pendulum, exact at every time and for every energy: swings, rotations, and the motion between them.
//
//   theta'' = -w0^2 sin(theta),    w0^2 = g/l for a point mass, m g d/I about the pivot for a body
//
// Derivation (Landau and Lifshitz, Mechanics, section 11; DLMF 22.19.i). The energy integral theta'^2 = 4 w0^2 (k^2 -
// sin^2(theta/2)), k^2 = sin^2(theta0/2) + (theta0'/(2 w0))^2, is the equation of Jacobi's functions:
//
//   k < 1   swings     sin(theta/2) = k sn(u|k^2)    theta' = 2 k w0 cn            period 4 K(k^2)/w0
//   k > 1   rotates    theta = 2 am(k u|1/k^2)       theta' = 2 k w0 dn            period 2 K(1/k^2)/(k w0)
//   k = 1   sin(theta/2) = tanh(u): up to the vertical in infinite time            infinite period
//
// with u = w0 t + u0. Theta is measured from the hanging position and grows without jumps [rad].
#pragma once

#include "plumbline/core/exact/jacobi_elliptic.hpp"

namespace plumbline {

struct PendulumState {
  double angle = 0;  // from hanging [rad]
  double rate = 0;   // [rad/s]
};

class PlanarPendulum {
 public:
  // w0 > 0 [rad/s] and the state at t = 0, finite; otherwise throws std::invalid_argument.
  PlanarPendulum(double w0, const PendulumState& initial);

  // At time t [s]. The error is a few 1e-16 (1 + w0 |t|), times 1/|1 - k^2| near k = 1, where the motion itself
  // magnifies the rounding of the initial state by that factor.
  PendulumState at(double t) const;

  double period() const;  // [s], of a swing there and back, or of one whole turn
  bool rotates() const { return rotates_; }

 private:
  double w0_;
  double turns0_ = 0;  // whole turns in the angle at t = 0
  bool rotates_ = false;
  double k_ = 0;
  EllipticModulus modulus_;  // of k^2, or of 1/k^2 when it rotates
  double u0_ = 0;
  double sense_ = 1;  // of the rotation
};

}  // namespace plumbline
