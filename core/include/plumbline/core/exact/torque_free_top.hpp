// A rigid body that tumbles without torque (Euler's top), exact at every time: the reference for the gyroscopic term.
//
//   I dw/dt + w x (I w) = 0    in body axes    (course slide 6, with the term that M = I alpha leaves out)
//
// Derivation (Landau and Lifshitz, Mechanics, section 37; Whittaker, Analytical Dynamics, section 69). Along principal
// axes, the ellipsoids 2E = I1 w1^2 + I2 w2^2 + I3 w3^2 and L^2 = I1^2 w1^2 + I2^2 w2^2 + I3^2 w3^2 meet in a closed
// curve. Call 2 the axis of the middle moment and 3 the axis that the curve goes round: the one of the largest moment
// when L^2 > 2 E I2, of the smallest when L^2 < 2 E I2. Then
//
//   w1 = a1 cn(u|m)    w2 = +-a2 sn(u|m)    w3 = +-a3 dn(u|m)    u = u0 + lambda t
//   lambda = a3 sqrt((I3 - I1)(I3 - I2)/(I1 I2))         m = k^2 = I1 (I2 - I1) a1^2 / (I3 (I3 - I2) a3^2)
//
// The angular momentum L stands still in W; seen from the body its direction gives two angles of the attitude, and
// the third, the turn psi about L, grows at the rate L (2E - I3 w3^2)/(L^2 - I3^2 w3^2), of which the integral is one
// of the third kind:
//
//   psi = L t/I3 + L (1/I1 - 1/I3) (Pi(n; u) - Pi(n; u0))/lambda       n = I3 (I2 - I1)/(I1 (I2 - I3)) <= 0
//
// Every sum above is arranged to have terms of one sign, so that no digits are lost for small w1, w2 or slow flips.
// Two equal moments give m = n = 0 and circular functions; three give a steady spin; on the separatrix L^2 = 2 E I2
// (m = 1) the functions are hyperbolic and the body flips once, in infinite time. All of these are covered. A spin
// about the middle axis is steady only where the other two components, in body axes, are exactly 0: one rounding away
// from it the body flips, though late.
#pragma once

#include "plumbline/core/exact/elliptic_integral.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

class TorqueFreeTop {
 public:
  // `inertia`: principal moments about the centre of mass along the body axes, any order [kg m^2]. The state at t = 0
  // is `initial`; the centre of mass moves on uniformly. Throws std::invalid_argument for moments that no body has
  // (not positive, or one larger than the sum of the others) and for a state that is not finite or not unit.
  TorqueFreeTop(const Vec3& inertia, const BodyState& initial);

  // The state at time t [s], t < 0 included. The error is a few 1e-16 times the angle turned so far, times 1/(1 - m)
  // close to the separatrix, where the motion itself magnifies the rounding of the initial state by that factor.
  BodyState at(double t) const;

  // The flipping interval [s]: w1 and w2 change their signs after it, and w repeats itself after two. 2 K/lambda;
  // infinite for a steady spin and on the separatrix.
  double half_period() const;
  double rate() const { return lambda_; }          // lambda [rad/s], 0 for a steady spin
  double parameter() const { return modulus_.m; }  // m = k^2

 private:
  Quat attitude_of_momentum(const Vec3& w_P) const;

  BodyState initial_;
  Quat q_BP_ = Quat::Identity();           // principal axes P ordered as above, right-handed
  Vec3 inertia_P_ = Vec3::Ones();          // I1, I2, I3 [kg m^2]
  Vec3 amplitude_ = Vec3::Zero();          // a1, +-a2, +-a3 [rad/s]
  double lambda_ = 0;                      // [rad/s]
  double momentum_ = 0;                    // |L| [kg m^2/s]
  EllipticModulus modulus_;                // m
  EllipticCharacteristic characteristic_;  // n
  double u0_ = 0, pi0_ = 0;                // u and Pi at t = 0
  Quat q_WL_ = Quat::Identity();           // frame of L (its z) in which psi is counted
};

}  // namespace plumbline
