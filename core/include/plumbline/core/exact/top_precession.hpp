// The two special motions of the heavy symmetric top that need no elliptic functions.
//
// Steady precession at the angle theta: the torque m g l sin(theta) turns the angular momentum as it stands when
//
//   I1 W^2 cos(theta) - I3 w3 W + m g l = 0
//
// which has two rates W for fast spin, slow ~ m g l/(I3 w3) and fast ~ I3 w3/(I1 cos(theta)), and none when
// (I3 w3)^2 < 4 I1 m g l cos(theta). A top that stands upright (sleeps) is stable as long as (I3 w3)^2 > 4 I1 m g l:
// the limit of that condition at theta = 0. Here I1 is about the pivot. Source: Goldstein, section 5.7,
// equations 5.76-5.80.
#pragma once

#include "plumbline/core/exact/lagrange_top.hpp"

namespace plumbline {

struct PrecessionRates {
  double slow, fast;  // W [rad/s]; fast is infinite for a horizontal axis
};

// spin: w3, the part of w along the axis [rad/s], not 0. theta in (0, pi) [rad] from the upright. Throws
// std::invalid_argument outside of that, and when the spin is too slow for any steady precession.
PrecessionRates precession_rates(const TopBody& top, double theta, double spin);

// The state of a top with pivot `pivot_W`, tilted by theta about x, that precesses steadily with W. Its w has the axial
// part `spin` and the rate W about the vertical.
BodyState precessing_state(const TopBody& top, double theta, double spin, double rate, const Vec3& pivot_W);

// Least |w3| at which the upright top is stable [rad/s]: 2 sqrt(I1 m g l)/I3.
double sleeping_spin(const TopBody& top);

}  // namespace plumbline
