// Reference trajectories by integration: for motions without a closed form, with a statement of how good they are.
//
// Dormand-Prince 8(5,3) with compensated summation (dormand_prince.hpp) on the equations of body_equations.hpp. What it
// reaches over 10 s, against Taylor series in extended precision (reference_integration_test.cpp): a box that flips
// over its unstable axis 2e-11 rad, a heavy top that turns through 1500 rad 2e-12 rad, a nutating one 8e-13 rad. The
// box needs steps that are right to 1e-16: near its separatrix each flip magnifies errors by some thousand.
//
// Range: smooth fields (no impacts, no friction that switches; cut the run there), not stiff, and not chaotic: the
// uncertainty says when a problem has multiplied the rounding of its own initial state beyond use.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/integration/step_control.hpp"
#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

struct ReferenceRun {
  std::vector<BodyState> states;  // ordered by time, then by body
  // Largest difference to a second run at 10 times the tolerance. Errors are proportional to the tolerance, so this is
  // about 9 times the error as long as steps rule it, and its order of magnitude where roundings do.
  double position_uncertainty = 0;  // [m]
  double attitude_uncertainty = 0;  // [rad]
  Effort effort;                    // of the first run
};

// States at those times [s], from `initial` at t0 [s]. Each step may add an error of tolerance (1 + |y|) to a number y
// in SI units: choose units, or the tolerance, so that this is small beside your lengths. Throws std::invalid_argument
// when times are not finite, fall, or start before t0, when initial holds no bodies or a number that is not finite, and
// for a tolerance outside [1e-17, 1e-3]; std::runtime_error when the step underflows.
ReferenceRun integrate_reference(const AccelerationField& field, double t0, std::span<const BodyState> initial,
                                 std::span<const double> times, double tolerance = 1e-16);

}  // namespace plumbline
