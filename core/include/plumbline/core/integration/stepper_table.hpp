// All integrators, one row each: what tests, benchmarks and labs run through.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

struct StepperKind {
  std::string_view name;  // "explicit Euler": that of the stepper itself
  int order;              // the power of dt over a fixed time
  std::unique_ptr<Stepper> (*make)();
};

// From the simplest to the most accurate: explicit Euler, semi-implicit Euler, position Verlet, velocity Verlet,
// Runge-Kutta 4, Dormand-Prince 8(5,3).
std::span<const StepperKind> stepper_kinds();

// Throws std::invalid_argument for a name that is not in the table, and lists those that are.
std::unique_ptr<Stepper> make_stepper(std::string_view name);

}  // namespace plumbline
