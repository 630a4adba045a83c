// A body that starts near the top of a fixed ball, runs down its round side and takes off.
//
// Its centre runs on a circle of radius R (both radii together), theta from the top. A ball that rolls turns by
// R theta/r and carries k = I/(m r^2) of inertia with it; one that slides without friction does not, k = 0. So
//
//   theta'' = w0^2 sin theta,   w0^2 = g/((1 + k) R):   a pendulum upside down (planar_pendulum.hpp)
//
// and the pressure m g cos theta - m R theta'^2 vanishes, by the energy R (1 + k) theta'^2 = 2 g (c - cos theta), at
//
//   cos theta = 2 c/(3 + k),   c = cos theta0 + (1 + k) R theta0'^2/(2 g)
//
// From rest at the top: 2/3 without friction, 10/17 for a solid ball that rolls. Then it flies on a parabola and keeps
// its spin. Source: Landau and Lifshitz, Mechanics, section 11, for the motion; the take-off is a problem of many
// textbooks. Rolling asks for friction k g sin theta/((1 + k) (g cos theta - R theta'^2)), more than any mu just before
// the end: with a finite mu it slips there for an instant, which `slip_bound` bounds.
#pragma once

#include "plumbline/core/exact/planar_pendulum.hpp"

namespace plumbline {

struct LeavingState {
  double across = 0, up = 0;      // centre, from that of the fixed ball [m]
  double v_across = 0, v_up = 0;  // [m/s]
  double turn = 0, spin = 0;      // of the body, forwards [rad], [rad/s]; 0 unless it rolls
};

class LeavingSphere {
 public:
  // path radius R > 0 [m], body radius r > 0 [m], inertia k >= 0 (0: slides), gravity > 0 [m/s^2], and at t = 0 the
  // angle 0 < theta0 < pi/2 and the rate >= 0. Throws std::invalid_argument otherwise, and when it takes off at once.
  LeavingSphere(double path_radius, double body_radius, double inertia, double gravity, double angle, double rate);

  LeavingState at(double t) const;  // t >= 0 [s]
  double leaving_time() const { return leaving_time_; }
  double leaving_angle() const { return leaving_angle_; }
  // How far off the velocity after take-off may be because friction mu cannot keep it rolling to the very end [m/s].
  double slip_bound(double friction) const;

 private:
  LeavingState on_sphere(double t) const;

  double path_radius_, body_radius_, inertia_, gravity_, start_;
  double leaving_time_ = 0, leaving_angle_ = 0;
  PlanarPendulum pendulum_;
};

}  // namespace plumbline
