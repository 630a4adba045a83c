// The turning points of a heavy symmetric top: roots of its cubic f(u) (lagrange_top.hpp), sought from where it is.
//
// Two of them may be nearly equal (steady precession), and any may lie close to a vertical, u = +-1. As u they would
// lose their digits there, so the cubic is written twice without cancellation: in d = u - u0, from the state,
//
//   f = c0 + c1 d + c2 d^2 + beta d^3          c0 = (du/dt)^2 >= 0    c1 = -beta (1 - u0^2) - 2 u0 w^2 + 2 a h
//   w^2 = |w across the axis|^2                h = b - a u0           c2 = 2 u0 beta - w^2 - a^2
//
// and in y = u - 1, f = -B^2 + 2 (a B - A) y + (2 beta - A - a^2) y^2 + beta y^3, with A = w^2 - beta (1 - u0) and
// B = b - a. Since f(-1) <= 0 <= f(u0) and f(1) <= 0, a root lies on each side of u0 in [-1, 1] and the third above.
#pragma once

namespace plumbline {

struct NutationStart {
  double fall = 0;           // 1 - u0
  double rise = 0;           // 1 + u0
  double across_square = 0;  // w^2 [1/s^2]
  double lift = 0;           // h [1/s]
  double u_rate = 0;         // du/dt [1/s]
  double a = 0;              // I3 w3/I1 [1/s]
  double beta = 0;           // 2 m g l/I1 > 0 [1/s^2]
};

// Distances of the roots u1 <= u2 <= u3 from the start and from both verticals, all >= 0, each to its own digits.
struct NutationRoots {
  double down, up;                // u0 - u1, u2 - u0
  double rise_lowest, rise_high;  // 1 + u1, 1 + u2
  double fall_lowest, fall_high;  // 1 - u1, 1 - u2
  double beyond;                  // u3 - 1
};

// Not for a top that stands or hangs still (w = 0 and u0 = +-1): it has a double root where it is.
NutationRoots nutation_roots(const NutationStart& start);

}  // namespace plumbline
