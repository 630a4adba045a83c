// Observed order of convergence over the dt's of a case.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/run_result.hpp"

namespace plumbline {

struct ErrorAtStep {
  double dt;     // [s]
  double error;  // in the metric's unit
  double floor;  // what rounding alone can amount to, in the same unit
};

struct Order {
  double order;        // NaN when it means nothing
  std::size_t points;  // dt's used
  std::string note;
};

// Least-squares slope of log(error) against log(dt) over the points whose error is finite and above its floor.
// Three different dt's are needed.
Order observed_order(std::span<const ErrorAtStep> errors);

// What rounding amounts to after n steps of a sum of that magnitude: each step rounds by at most u |x|, with a standard
// deviation of u |x|/sqrt(3) if evenly spread, and independent roundings add like a random walk. 4 u sqrt(n) |x| is
// seven standard deviations of that walk.
double rounding_floor(double unit_roundoff, double steps, double magnitude);

}  // namespace plumbline
