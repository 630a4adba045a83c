// The Zeno ball: infinitely many bounces in a finite time, summed.
//
// A ball leaves a wall with the normal speed u, is pulled back with the constant acceleration -a and rebounds with
// e < 1 of its speed. Hop j takes 2 u e^j / a, so all together
//   T = (2u/a) (1 + e + e^2 + ...) = 2u / (a (1 - e)),
// and with R the time that remains until T, hop j is on its way while T e^j >= R > T e^(j+1): the state at any time
// is known without following the hops. Valid while the pull is constant and nobody else touches the ball.
//   Falcon, Laroche, Fauve and Coste, Eur. Phys. J. B 3, 45 (1998), where one listens to it.
#pragma once

namespace plumbline {

struct BounceTrain {
  double start = 0;        // time of the impact that begins it [s]
  double speed = 0;        // u > 0, the normal speed after that impact [m/s]
  double pull = 0;         // a > 0, towards the wall [m/s^2]
  double restitution = 0;  // e in [0, 1)

  double duration() const { return 2 * speed / (pull * (1 - restitution)); }  // T [s]
  double end() const { return start + duration(); }                           // [s]
  double height() const { return speed * speed / (2 * pull); }                // of the highest hop [m]
  // All impulses of the wall for each kilogram, from just after the first impact to rest [m/s]: the momentum u that
  // goes and the weight a T that is held, -u + 2u/(1 - e) = u (1 + e)/(1 - e).
  double impulse() const { return speed * (1 + restitution) / (1 - restitution); }

  struct Hop {
    double height = 0;  // above the wall [m]
    double speed = 0;   // away from it [m/s]
  };
  // State at a time in [start, end] [s]; 0, 0 from the end on.
  Hop at(double time) const;
};

}  // namespace plumbline
