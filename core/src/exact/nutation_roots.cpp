#include "plumbline/core/exact/nutation_roots.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline {
namespace {

// The root y >= 0 of y^3 + c2 y^2 + c1 y + c0, c0 <= 0, of which the other two are real and <= 0: Newton's method from
// Laguerre's bound above, kept in a bracket, since rounding at y = 1 may carry it past a root at 1e-20.
double root_beyond(double c2, double c1, double c0) {
  double low = 0, high = -c2 / 3 + 2.0 / 3.0 * std::sqrt(std::max(0.0, c2 * c2 - 3 * c1));
  double y = high;
  constexpr int kMost = 400;  // halving alone gets from 1 to 1e-100
  for (int k = 0; k < kMost; ++k) {
    const double value = c0 + y * (c1 + y * (c2 + y)), slope = c1 + y * (2 * c2 + 3 * y);
    (value > 0 ? high : low) = y;
    double next = y - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == y || value == 0) break;
    y = next;
  }
  return y;
}

// A turning point near the vertical has 1 -+ u = edge - d with few digits left. There the product of the roots,
// f(+-1) = -(b -+ a)^2, gives the distance instead, and the distance gives d.
void refine(double edge, double product, double others, double& d, double& distance) {
  constexpr double kDigitLost = 0.1;
  distance = edge - d;
  if (distance > kDigitLost * edge || !(others > 0)) return;
  distance = std::min(edge, product / others);
  d = edge - distance;
}

}  // namespace

NutationRoots nutation_roots(const NutationStart& start) {
  const auto& [fall, rise, w2, h, u_rate, a, beta] = start;
  const double u0 = 0.5 * (rise - fall);
  const double excess = w2 - beta * fall;                          // A
  const double b_minus_a = h - a * fall, b_plus_a = h + a * rise;  // B
  // With b = a, u = 1 is a root: the third, unless there is energy to go through the vertical.
  const bool stays_below = b_minus_a == 0 && excess <= 0;

  NutationRoots roots{};
  roots.beyond = stays_below ? 0
                             : root_beyond((2 * beta - excess - a * a) / beta, 2 * (a * b_minus_a - excess) / beta,
                                           -b_minus_a * b_minus_a / beta);
  const double third = fall + roots.beyond;

  // The other two: d^2 + q1 d + q0, q0 <= 0. Of the two ways to divide, the one with the smaller rounding.
  const double c0 = u_rate * u_rate / beta;
  const double c1 = (-beta * rise * fall - 2 * u0 * w2 + 2 * a * h) / beta;
  const double c2 = (2 * u0 * beta - w2 - a * a) / beta;
  const double q0 = -c0 / third;
  const bool from_below = std::abs(c1) + std::abs(q0) < third * (std::abs(c2) + third);
  const double q1 = from_below ? (q0 - c1) / third : c2 + third;
  const double larger = -0.5 * (q1 + std::copysign(std::sqrt(q1 * q1 - 4 * q0), q1));
  const double smaller = larger == 0 ? 0 : q0 / larger;
  roots.down = std::clamp(-std::min(larger, smaller), 0.0, rise);
  roots.up = std::clamp(std::max(larger, smaller), 0.0, fall);

  roots.fall_lowest = fall + roots.down;
  roots.rise_high = rise + roots.up;
  refine(rise, b_plus_a * b_plus_a, beta * roots.rise_high * (rise + third), roots.down, roots.rise_lowest);
  if (stays_below) {
    roots.fall_high = fall - roots.up;
  } else {
    refine(fall, b_minus_a * b_minus_a, beta * roots.fall_lowest * roots.beyond, roots.up, roots.fall_high);
  }
  return roots;
}

}  // namespace plumbline
