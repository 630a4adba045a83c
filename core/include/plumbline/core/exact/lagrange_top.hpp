// The heavy symmetric top on a fixed point (Lagrange's top), exact at every time, attitude included.
//
//   I dw/dt + w x (I w) = r x m g    about the pivot    (course slide 4: a centre of rotation that is not the centre
//                                                        of mass; slide 6 with its gyroscopic term)
//
// Derivation (Goldstein, Classical Mechanics, section 5.7; Klein and Sommerfeld, Theory of the Top, vol. 2). With theta
// the angle between symmetry axis and vertical, u = cos(theta), the momenta about both axes and the energy stay:
//
//   a = I3 w3/I1    b = L_z/I1    du/dt^2 = (alpha - beta u)(1 - u^2) - (b - a u)^2 = f(u)    beta = 2 m g l/I1
//
// f has roots -1 <= u1 <= u2 <= 1 <= u3, and the top nutates between the first two:
//
//   u = u1 + (u2 - u1) sn^2(v|m)    v = v0 + lambda t    lambda = sqrt(beta (u3 - u1))/2    m = (u2 - u1)/(u3 - u1)
//
// The angles of precession phi and spin psi (z-x-z) enter the quaternion only as sum and difference (Klein's
// parameters), each with one integral of the third kind, and each beside the half angle that vanishes where it jumps:
//
//   d(phi + psi)/dt =   w3 - a + (b + a)/(1 + u)       with cos(theta/2)
//   d(phi - psi)/dt = -(w3 - a) + (b - a)/(1 - u)      with sin(theta/2)
//
// So no attitude is singular: upright, hanging, through the vertical, a plane pendulum (w3 = 0) are all covered.
#pragma once

#include <complex>

#include "plumbline/core/exact/elliptic_integral.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

// A symmetric body on a pivot, in gravity along -z of W.
struct TopBody {
  double mass = 1;                // [kg]
  Vec3 arm_B = Vec3::UnitZ();     // from the pivot to the centre of mass, in body axes: the symmetry axis [m]
  double inertia_axial = 1;       // I3, about the symmetry axis [kg m^2]
  double inertia_transverse = 1;  // across it, about the centre of mass (not the pivot) [kg m^2]
  double gravity = 9.81;          // g > 0 [m/s^2]
};

// About the pivot: I1 = inertia_transverse + m l^2 [kg m^2].
double transverse_inertia_at_pivot(const TopBody& top);

class LagrangeTop {
 public:
  // Attitude and angular velocity at t = 0 come from `initial`, and the place of the pivot from its p_WB; its v_WB is
  // not read, since the fixed pivot leaves only w x r. Throws std::invalid_argument for parameters that are not
  // positive and for a state that is not finite or not unit.
  LagrangeTop(const TopBody& top, const BodyState& initial);

  // The state at time t [s], t < 0 included. The error is a few 1e-16 times the angle turned so far, times 1/(1 - m)
  // near m = 1, where the motion itself magnifies the rounding of the initial state by that factor.
  BodyState at(double t) const;

  // Time from one lowest attitude to the next [s]: 2 K/lambda. Infinite where the top only approaches the vertical,
  // and where it stands or hangs still.
  double nutation_period() const;
  double lowest_cosine() const { return lowest_cosine_; }    // u1
  double highest_cosine() const { return highest_cosine_; }  // u2
  double spin() const { return w3_; }                        // w3, a constant of the motion [rad/s]
  double parameter() const { return modulus_.m; }            // m, near 1 where rounding grows
  const Vec3& pivot_W() const { return pivot_W_; }

 private:
  using Complex = std::complex<double>;
  // One of Klein's parameters, r exp(i angle): r = cos(theta/2) with angle (phi + psi)/2, or r = sin(theta/2) with
  // (phi - psi)/2. r^2 = (low cn^2 + high sn^2)/2. Where it goes through 0, r changes its sign instead of the angle.
  struct Klein {
    enum class Root { kPositive, kSignOfSn, kSignOfCn };
    Root root = Root::kPositive;
    double low = 0, high = 0;  // 1 +- u1, 1 +- u2
    double drift = 0;          // constant part of the angle's rate [rad/s]
    double pull = 0;           // (b +- a)/2: the rest of the rate is pull/(1 +- u) [rad/s]
    EllipticCharacteristic characteristic;
    Complex phase = 1;  // makes it the given one at t = 0
  };
  struct Motion {
    Complex value, rate;
  };
  void prepare(Klein& part, const Motion& initial) const;
  Motion motion(const Klein& part, const JacobiElliptic& j, double t) const;
  BodyState state(const Quat& q_WP, const Vec3& w_W) const;

  Vec3 pivot_W_ = Vec3::Zero();
  double arm_ = 0;                // l [m]
  Quat q_BP_ = Quat::Identity();  // frame P of the body with z along the arm
  Quat q_WP0_ = Quat::Identity();
  double w3_ = 0;
  double lowest_cosine_ = 0, highest_cosine_ = 0;
  double lambda_ = 0;  // [rad/s], 0 when the axis is vertical and stays so
  double v0_ = 0;
  EllipticModulus modulus_;
  Klein cos_half_, sin_half_;
};

}  // namespace plumbline
