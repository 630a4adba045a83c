#include "plumbline/core/exact/ship_with_drag.hpp"

#include <cmath>
#include <stdexcept>

namespace plumbline {
namespace {

// (1 - e^-x)/x, 1 at x = 0.
double first(double x) { return x == 0 ? 1 : -std::expm1(-x) / x; }

// (e^-x - 1 + x)/x^2, 1/2 at x = 0: by its series where the difference would lose more than a digit.
double second(double x) {
  if (std::abs(x) > 1) return (std::expm1(-x) + x) / (x * x);
  double sum = 0;
  constexpr int kTerms = 20;  // 1/22! < 1e-21
  for (int k = kTerms; k >= 0; --k) sum = (1 - x * sum) / (k + 2);
  return sum;
}

}  // namespace

ShipWithDrag::ShipWithDrag(double mass, double thrust, double drag, double v0)
    : mass_(mass), thrust_(thrust), drag_(drag), v0_(v0) {
  if (!(mass > 0 && drag >= 0 && std::isfinite(mass + thrust + drag + v0))) {
    throw std::invalid_argument("a ship needs a mass > 0, a drag >= 0 and finite thrust and velocity");
  }
}

double ShipWithDrag::velocity(double t) const {
  return v0_ + (thrust_ - drag_ * v0_) / mass_ * t * first(drag_ * t / mass_);
}

double ShipWithDrag::position(double t) const {
  return v0_ * t + (thrust_ - drag_ * v0_) / mass_ * t * t * second(drag_ * t / mass_);
}

double ShipWithDrag::terminal_velocity() const { return thrust_ / drag_; }

}  // namespace plumbline
