// Walks along a curve without stepping over its first zero.
#pragma once

#include <cmath>
#include <optional>

namespace plumbline {

struct Height {
  double value;  // [m]
  double slope;  // [m/s]
};

// The first t in [0, horizon] at which the curve is not above `tolerance` and falls. `curve(t)` gives a Height whose
// second derivative is nowhere below -bend: from lower bound to lower bound.
template <typename Curve>
std::optional<double> advance(const Curve& curve, double bend, double tolerance, double horizon) {
  constexpr int kMaxSteps = 10000;  // only a curve that stays just above the tolerance needs more than a few dozen
  double t = 0;
  for (int k = 0; k < kMaxSteps; ++k) {
    const auto [value, slope] = curve(t);
    if (value <= tolerance && slope < 0) return t;
    const double clear = value > 0 ? value : 0;  // inside and on the way out: the bound starts at the surface
    const double root = std::sqrt(slope * slope + 2 * bend * clear);
    double step = 0;
    if (slope < 0) {
      step = 2 * clear / (root - slope);
    } else {
      if (!(bend > 0)) return std::nullopt;
      step = (slope + root) / bend;
    }
    // On the surface with a slope of next to nothing there is no bound to walk along: let the curve bend for a moment.
    if (value <= tolerance && !(step > horizon * 1e-12)) step = horizon * 1e-12;
    t += step;
    if (!(t <= horizon)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace plumbline
