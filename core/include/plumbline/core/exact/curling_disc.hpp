// A thin disc that slides and spins on a table: both stop at the same moment, at a fixed ratio.
//
// The weight presses uniformly. A point of the disc at (x, y) moves with (v - w y, w x), and friction acts against that
// with mu p. With e = v/(R w) the sums over the disc are, in units of mu m g and mu m g R (K and E of the parameter
// e^2 or 1/e^2),
//
//   e <= 1   force  4 [(1 + e^2) E - (1 - e^2) K]/(3 pi e)          moment  4 [(4 - 2 e^2) E - (1 - e^2) K]/(9 pi)
//   e >= 1   force  4 [(1 + e^2) E - (e^2 - 1) K]/(3 pi)
//            moment 4 e [(4 - 2 e^2) E + (2 e^2 - 5 + 3/e^2) K]/(9 pi)
//
// so that m v' = -mu m g force, I w' = -mu m g R moment. The ratio e runs to the root of force = e (m R^2/I) moment,
// 0.653 for I = m R^2/2, from any start with v and w > 0. Source: Farkas, Bartels, Unger, Wolf, Frictional coupling
// between sliding and spinning motion, Physical Review Letters 90 (2003) 248302; the integrals are checked against
// quadrature in the tests.
//
// Near the end everything happens ever faster. In the time s with dt = (R w/mu g) ds all is smooth: ln(R w), e, the way
// and the angle are integrated over it by dormand_prince.hpp, to 1e-15 a step.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace plumbline {

// In units of mu m g and of mu m g R; e >= 0, infinite for a disc that does not spin.
double disc_friction_force(double e);
double disc_friction_moment(double e);

struct DiscState {
  double way = 0, speed = 0;  // [m], [m/s]
  double turn = 0, spin = 0;  // [rad], [rad/s]
};

class CurlingDisc {
 public:
  // radius R > 0 [m], inertia I/(m R^2) > 0, deceleration mu g > 0 [m/s^2], and at t = 0 speed > 0 [m/s] and spin > 0
  // [rad/s]; otherwise throws std::invalid_argument.
  CurlingDisc(double radius, double inertia, double deceleration, double speed, double spin);

  DiscState at(double t) const;  // t >= 0 [s]
  double stop_time() const { return stop_time_; }
  double final_ratio() const;  // of speed over R spin, just before the end

 private:
  // ln(R w), e, t, way, angle, and a zero that makes the number of components even.
  using State = Eigen::Matrix<double, 6, 1>;
  State rates(const State& y) const;
  State advance(const State& y, double by) const;

  double radius_, inertia_, deceleration_;
  double stop_time_;
  std::vector<State> nodes_;  // every kInterval of s
};

}  // namespace plumbline
