// A homogeneous sphere that slides on a plane under Coulomb friction until it rolls (a billiard ball).
//
// The point of contact moves with u = v - r w x n (n the upward normal). Friction -mu m g u/|u| slows the centre and
// spins the ball, and both push u the same way: du/dt = -(7/2) mu g u/|u| for I = 2/5 m r^2. So the direction of u
// stays, u ends at
//
//   t* = 2 |u0|/(7 mu g)
//
// on the way v = v0 - mu g t u0/|u0|, a parabola when v0 and u0 differ in direction, and w changes by
// 5/2 mu g t (n x u0)/(r |u0|). Then it rolls on straight with v = (5/7) v0 + (2/7) r w0 x n. The spin about n stays:
// a contact in one point has no drilling friction. Source: Coriolis, Theorie mathematique des effets du jeu de billard
// (1835); Landau and Lifshitz, section 38, problem 2. From pure sliding, w0 = 0: v = 5/7 v0, after 12 v0^2/(49 mu g).
//
// The plane is z = const of W, gravity along -z. Range: t >= 0. Exact to rounding.
#pragma once

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct SphereMotion {
  Vec3 p_WB = Vec3::Zero();  // centre [m]
  Vec3 v_WB = Vec3::Zero();  // [m/s], parallel to the plane
  Vec3 w_WB = Vec3::Zero();  // [rad/s]
};

class SlidingSphere {
 public:
  // radius > 0 [m], friction > 0, gravity > 0 [m/s^2], and the motion at t = 0 with v_z = 0; otherwise throws
  // std::invalid_argument.
  SlidingSphere(double radius, double friction, double gravity, const SphereMotion& initial);

  SphereMotion at(double t) const;                       // t >= 0 [s], else std::invalid_argument
  double rolling_time() const { return rolling_time_; }  // t* [s], 0 when it rolls from the start
  Vec3 slip_velocity() const { return slip_; }           // u0 [m/s]

 private:
  SphereMotion slide(double t) const;

  double radius_, deceleration_;  // mu g [m/s^2]
  SphereMotion initial_;
  Vec3 slip_, direction_ = Vec3::Zero();
  double rolling_time_ = 0;
};

}  // namespace plumbline
