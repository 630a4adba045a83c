// A slender block that rocks on a rough floor from one of its edges to the other, exact between the impacts and at
// them.
//
// While it stands on one edge it is a pendulum upside down. With the tilt s from upright, 0 < s < alpha, where alpha =
// atan(half-width/half-height) is the tilt at which it would fall over, and R the distance from edge to centre,
//
//   s'' = -p^2 sin(alpha - s),   p^2 = m g R/(I + m R^2)   (3 g/(4 R) for a homogeneous block)
//
// that is PlanarPendulum at the angle pi - alpha + s. When s comes back to 0 the other edge strikes: plastic, without
// slip. Angular momentum about that edge makes of the rate w the rate ratio * w, (1 - 3/2 sin^2 alpha) w for a
// homogeneous block, and the block goes on tilting the same way round. From the energy integral the tilts at the
// turning points follow:
//
//   cos(alpha - s') - cos(alpha) = ratio^2 (cos(alpha - s) - cos(alpha))
//
//   Housner, Bull. Seism. Soc. Am. 53, 403 (1963), who goes on with sin(x) = x; that is not done here.
#pragma once

#include <cstddef>
#include <vector>

#include "plumbline/core/exact/planar_pendulum.hpp"

namespace plumbline {

struct RockingState {
  double tilt = 0;          // from upright, with the sign of the side to which it leans [rad]
  double rate = 0;          // [rad/s]
  std::size_t impacts = 0;  // so far
};

class RockingBlock {
 public:
  // Starts at rest with a tilt, 0 < |tilt| < alpha < pi/2; p > 0 [1/s], 0 < ratio <= 1. Known until `duration` [s].
  // Throws std::invalid_argument for other values, and when there are more than a thousand impacts until then (for
  // ratio < 1 they accumulate: the block comes to rest in a finite time).
  RockingBlock(double p, double alpha, double ratio, double tilt, double duration);

  // 0 <= t <= duration; at an impact the state after it. The error is that of PlanarPendulum, for every impact once
  // more.
  RockingState at(double t) const;

  const std::vector<double>& impacts() const { return impacts_; }  // their times [s]

 private:
  // From one impact to the next, around the turning point.
  struct Swing {
    double turn;  // time of the turning point [s]
    PlanarPendulum motion;
  };
  double alpha_, side_;
  std::vector<Swing> swings_;
  std::vector<double> impacts_;
};

}  // namespace plumbline
