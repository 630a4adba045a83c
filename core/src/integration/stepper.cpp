#include "plumbline/core/integration/stepper.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline {

void require_step(double t, double dt) {
  if (!std::isfinite(t)) throw std::invalid_argument("stepper: t = " + std::to_string(t) + " is not a time");
  if (!std::isfinite(dt) || dt == 0) {
    throw std::invalid_argument("stepper: dt = " + std::to_string(dt) +
                                " s cannot be stepped; give a finite number that is not zero (negative: back in time)");
  }
}

}  // namespace plumbline
