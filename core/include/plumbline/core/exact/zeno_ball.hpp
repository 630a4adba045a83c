// A ball that bounces infinitely often in a finite time (course slides 18-22: coefficient of restitution).
//
// Dropped from height h above contact, with restitution e: every bounce multiplies the speed by e, the time aloft by e
// and the height by e^2. With t0 = sqrt(2h/g) geometric series give
//
//   impact n = 0, 1, ...   t_n = t0 (1 + 2 (e + ... + e^n)) = t0 (1 + 2 e (1 - e^n)/(1 - e))
//   apex after impact n    h e^(2n+2),  at t_n + t0 e^(n+1)
//   at rest from           t0 (1 + e)/(1 - e)
//   path travelled         h (1 + e^2)/(1 - e^2)
//   energy lost at impact  the share 1 - e^2
//
// Source: Falcon, Laroche, Fauve, Coste, Behavior of one inelastic ball bouncing repeatedly off the ground, Eur. Phys.
// J. B 3, 45 (1998). Range: 0 <= e <= 1; with e = 1 the ball never rests. For a ball of radius r, h is that of its
// lowest point. Relative error a few 1e-16; close to the end, of the time since the start.
#pragma once

#include <cstdint>

namespace plumbline {

struct ZenoState {
  double height = 0;         // above contact [m]
  double velocity = 0;       // upward [m/s]
  std::int64_t impacts = 0;  // so far; -1 once it rests, after infinitely many
};

class ZenoBall {
 public:
  // height > 0 [m], restitution in [0, 1], gravity > 0 [m/s^2]; otherwise throws std::invalid_argument.
  ZenoBall(double height, double restitution, double gravity);

  // At t >= 0 [s], at an impact with the velocity after it. Throws std::invalid_argument for t < 0.
  ZenoState at(double t) const;
  double impact_time(std::int64_t n) const;  // t_n, n >= 0 [s]
  double apex_height(std::int64_t n) const;  // after impact n [m]
  double stop_time() const;                  // [s], infinite for e = 1
  double path_length() const;                // until it rests [m], infinite for e = 1

 private:
  double height_, e_, gravity_;
  double fall_;  // t0 [s]
};

}  // namespace plumbline
