// How large the next step of an adaptive solver is: the part of dormand_prince.hpp that does not depend on the state.
//
// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, sections II.4 and II.10.
#pragma once

#include <cstddef>

namespace plumbline {

// The error that one step may add to a component y: absolute + relative |y|.
struct Tolerance {
  double relative = 1e-13;
  double absolute = 1e-13;  // in the unit of y; it rules where a component passes through zero
};

struct Effort {
  std::size_t evaluations = 0;  // of the right-hand side
  std::size_t accepted = 0;     // steps
  std::size_t rejected = 0;     // attempts whose error was too large
};

// Throws std::invalid_argument unless both are positive and the relative one lies in [1e-17, 0.1].
void require_tolerance(const Tolerance& tolerance);
// Throws std::invalid_argument unless t and the state are finite.
void require_finite_start(double t, bool state_is_finite);

// The estimate of dormand_prince.hpp from the sums of squares of the two errors; NaN in, NaN out.
double dormand_prince_error(double err5_squared, double err3_squared, double components);

// 0.9 err^(-1/8) within [1/3, 6]; at most 1 right after a rejected attempt. 1/10 when err is not a number: a step too
// long may have left the domain of f.
double step_factor(double err, bool after_rejection);

// The step to take when `left` remains up to an output time: the wanted one, or all that is left, or half of it.
double step_towards(double left, double wanted);

// Throws std::runtime_error when h has become too small to move t: see DormandPrince::advance_to.
void require_progress(double t, double h, double t_end, double err);

// A careful step to learn the second derivative from: it changes y by a hundredth of its size. In the direction of
// span.
double trial_step(double size, double speed, double span);
// The first step, positive: the norms of y' and y'' in units of the tolerance become an error of 1/100. Throws
// std::runtime_error when they are not finite.
double first_step_size(double t, double trial, double speed, double bend, double span);

}  // namespace plumbline
