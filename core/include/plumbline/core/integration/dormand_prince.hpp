// An adaptive solver of order 8 for y' = f(t, y): the method of Dormand and Prince with the error estimate of DOP853.
//
// For references: smooth right-hand sides, tolerances from 1e-4 down to 1e-16. Not for stiff problems (the step is
// bounded by stability, about |lambda| h < 6) and not across jumps of f: advance to the jump, start() again behind it.
//
//   DormandPrince<Eigen::Vector2d> solver({.relative = 1e-13, .absolute = 1e-13});
//   solver.start(0, {1, 0});
//   solver.advance_to([](double t, const auto& y, auto& dy) { dy << y[1], -y[0]; }, 10);    // f writes dy
//   solver.state();                                                                         // (cos 10, -sin 10)
//
// The step. Twelve evaluations give y of order 8 and the errors err5 and err3 of two formulas of lower order. With
// the root mean square over the components of error/(absolute + relative |y|),
//
//   err = err5^2/sqrt(err5^2 + err3^2/100),   next h = 0.9 h err^(-1/8), between a third and six times h
//
// and a step with err > 1 is taken again. err falls like h^8; the error that remains, of order h^9, is usually far
// below. The tolerance bounds each step, so the error at the end is the tolerance times the number of steps times the
// growth that the problem itself gives to disturbances: compare two tolerances to know it (reference_integration.hpp
// does).
//
// Output times are met exactly: the last step before one is shortened (and the last two halved, so that none is tiny).
// An interpolant would be cheaper between steps but has order 7.
//
// Rounding. What y loses when an increment is added to it is carried to the next step (Kahan's compensated summation,
// in Knuth's form that needs no ordering by size), for t likewise. Left are the roundings inside a step, about |h f|
// 2^-53: small steps no longer add up an error of |y| 2^-53 each, and a tolerance of 1e-16 a step means something.
//
// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, sections II.4, II.5, II.10;
// Kahan, Comm. ACM 8 (1965) 40. Nothing here allocates after start(), for fixed-size and dynamic vectors;
// fixed-size ones with an even number of components are the fastest (pad with a zero), since Eigen then uses SSE2.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "plumbline/core/integration/dormand_prince_tableau.hpp"
#include "plumbline/core/integration/step_control.hpp"

namespace plumbline {

// State: a column vector of Eigen with scalar double. Right-hand sides are called as f(t, y, dy), with const State& y
// and State& dy, and write every component of dy.
template <class State>
class DormandPrince {
 public:
  // Throws std::invalid_argument unless both tolerances are positive and the relative one lies in [1e-17, 0.1].
  explicit DormandPrince(const Tolerance& tolerance) : tolerance_(tolerance) { require_tolerance(tolerance); }

  // Throws std::invalid_argument unless all numbers are finite.
  void start(double t, const State& y);

  // Integrates up to t_end, which may lie before time(). Throws std::runtime_error with the time reached when the step
  // underflows: f is singular, stiff beyond reason or not finite there, or the tolerance is below what f's own rounding
  // allows. The state is then the last one that was accepted.
  template <class Rhs>
  void advance_to(const Rhs& f, double t_end);

  // One step of that size, whatever its error: for experiments with the order.
  template <class Rhs>
  void step(const Rhs& f, double h);

  double time() const { return t_; }
  const State& state() const { return y_; }
  const Effort& effort() const { return effort_; }

 private:
  template <class Rhs>
  void attempt(const Rhs& f, double h);
  template <std::size_t Stage, class Rhs>
  void evaluate(const Rhs& f, double h);
  template <class Rhs>
  void evaluate_first(const Rhs& f);
  void accept(double h);
  double error(double h);
  template <class Rhs>
  double first_step(const Rhs& f, double span);

  Tolerance tolerance_;
  Effort effort_;
  double t_ = 0, t_carry_ = 0;
  double h_ = 0;  // the size that the error control wants next; 0: not known yet
  bool has_first_ = false;
  State y_, y_carry_;      // the carries: what the sums have lost so far
  State y_new_, y_stage_;  // of the current attempt
  State increment_;
  std::array<State, dormand_prince_tableau::kStages> k_;
};

}  // namespace plumbline

#include "plumbline/core/integration/dormand_prince_impl.hpp"
