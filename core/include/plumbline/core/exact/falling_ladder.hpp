// A smooth ladder that slides down between wall and ground, leaves the wall and falls on.
//
// A plank of length L and thickness d touches the ground with one edge of its lower side and the wall with the other;
// theta is its angle from upright. With D = sqrt(L^2 + d^2)/2 and delta = atan(d/L) its centre is at
//
//   x = D sin(theta + delta),   z = D cos(theta - delta)        from the corner of wall and ground
//
// so there is one freedom: M theta'' + M_theta theta'^2/2 = -m g z_theta, M = m (x_theta^2 + z_theta^2) + I. The wall
// pushes with m x'' and lets go where that vanishes; from then on x' stays and M = m z_theta^2 + I. A thin ladder from
// rest leaves the wall when its upper end has come down to two thirds of its height (Goldstein and others; Kapranidis
// and Koo, College Mathematics Journal 39 (2008) 374). Integrated by dormand_prince.hpp to 1e-15 a step; two tolerances
// and the energy agree to a few 1e-14. Range: until it lies flat.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace plumbline {

struct LadderState {
  double angle = 0, rate = 0;  // from upright, falling [rad], [rad/s]
  double x = 0, z = 0;         // centre [m]
  double vx = 0, vz = 0;       // [m/s]
};

class FallingLadder {
 public:
  // length L > d >= 0 [m], inertia I/m > 0 about the centre [m^2], gravity g > 0, from rest at 0 < angle0 < pi/2 and up
  // to `duration` > 0 [s]. Throws std::invalid_argument for other numbers, and when it lies flat before.
  FallingLadder(double length, double thickness, double inertia_over_mass, double gravity, double angle,
                double duration);

  LadderState at(double t) const;                        // 0 <= t <= duration (and a hair beyond), else throws
  double leaving_time() const { return leaving_time_; }  // infinite when it stays at the wall throughout

 private:
  using State = Eigen::Vector4d;  // theta, theta', x, x'
  State rates(const State& y, bool at_wall) const;
  double push_of_wall(const State& y) const;  // over the mass [m/s^2]
  State advance(double from, const State& y, double to, bool at_wall) const;
  State state_at(double t) const;

  double reach_, delta_, inertia_, gravity_;
  double leaving_time_, interval_;
  State start_, leaving_;
  std::vector<State> before_, after_;  // every interval_ from the start, and from the time of leaving
};

}  // namespace plumbline
