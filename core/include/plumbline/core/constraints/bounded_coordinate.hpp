// A coordinate between two limits under constant acceleration, each impact at its exact time (course slide 33,
// zero-tolerance policy; slide 34, example 1: an x in [0, 100]).
//
// Between impacts x(t) = x + v t + a t^2/2. At a limit the speed is turned round and multiplied by the restitution e.
//
// Resting rule. When a pushes into the limit, a rebound at the speed u is followed by flights of 2u/a, 2 e u/a, ...:
// infinitely many that end after the sum of the geometric series, 2u/(a (1 - e)). Once that sum is below 1e-9 s the
// coordinate rests at the limit from its end on: the time is exact, and the height left out is below a (1e-9 s)^2/8.
#pragma once

#include <vector>

namespace plumbline {

struct LimitImpact {
  double time;      // [s]
  bool at_high;     // which limit
  double approach;  // speed before the impact [m/s]
};

class BoundedCoordinate {
 public:
  // Throws std::invalid_argument unless low < high, low <= x <= high, all is finite and 0 <= e <= 1. Limits may be
  // infinite.
  BoundedCoordinate(double low, double high, double restitution, double x, double v, double a);

  // Throws std::invalid_argument when that time [s] lies in the past, and std::runtime_error after 100000 impacts.
  void advance_to(double time);

  double time() const { return time_; }   // [s]
  double position() const { return x_; }  // [m]
  double velocity() const { return v_; }  // [m/s]
  bool rests() const { return rests_; }
  double rest_time() const { return rest_time_; }  // [s]; when it came to rest, only if rests()
  const std::vector<LimitImpact>& impacts() const { return impacts_; }

 private:
  void hit(bool at_high);

  double low_, high_, restitution_, x_, v_, a_;
  double time_ = 0, rest_time_ = 0;
  bool rests_ = false;
  std::vector<LimitImpact> impacts_;
};

}  // namespace plumbline
