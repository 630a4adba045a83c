// The bodies of the templates of dormand_prince.hpp; include that one.
#pragma once

#include "plumbline/core/integration/dormand_prince.hpp"

namespace plumbline {
namespace dormand_prince_tableau {

// Rows of the tableau as types, so that zeros cost nothing.
template <std::size_t Stage>
struct StageRow {
  static constexpr Weights kValues = kA[Stage];
};
struct Solution {
  static constexpr Weights kValues = kB;
};
struct Error5 {
  static constexpr Weights kValues = kE5;
};
struct Error3 {
  static constexpr Weights kValues = kE3;
};

// The last i below `end` with w_i != 0; kStages when there is none.
constexpr std::size_t last_nonzero(const Weights& w, std::size_t end) {
  for (std::size_t i = end; i-- > 0;) {
    if (w[i] != 0) return i;
  }
  return kStages;
}

// h sum_i w_i k_i over i < End and the weights that are not zero, as one expression: Eigen runs through the components
// once. The newest slope comes last and h is in the weights, so that a processor is done with the rest while it still
// works on that slope.
template <class Row, std::size_t End = kStages, class Slopes>
auto increment(double h, const Slopes& k) {
  constexpr std::size_t kLast = last_nonzero(Row::kValues, End);
  if constexpr (last_nonzero(Row::kValues, kLast) == kStages) {
    return (h * Row::kValues[kLast]) * k[kLast];
  } else {
    return increment<Row, kLast>(h, k) + (h * Row::kValues[kLast]) * k[kLast];
  }
}

}  // namespace dormand_prince_tableau

template <class State>
void DormandPrince<State>::start(double t, const State& y) {
  require_finite_start(t, y.allFinite());
  effort_ = {};
  t_ = t;
  t_carry_ = h_ = 0;
  has_first_ = false;
  y_ = y_new_ = y_stage_ = increment_ = y;
  y_carry_ = State::Zero(y.size());
  k_.fill(y_carry_);
}

template <class State>
template <class Rhs>
void DormandPrince<State>::evaluate_first(const Rhs& f) {
  if (has_first_) return;
  f(t_, std::as_const(y_), k_[0]);
  ++effort_.evaluations;
  has_first_ = true;
}

template <class State>
template <std::size_t Stage, class Rhs>
void DormandPrince<State>::evaluate(const Rhs& f, double h) {
  using namespace dormand_prince_tableau;
  y_stage_ = y_ + increment<StageRow<Stage>>(h, k_);
  f(t_ + kC[Stage] * h, std::as_const(y_stage_), k_[Stage]);
}

// From (t_, y_) to y_new_. An attempt changes neither.
template <class State>
template <class Rhs>
void DormandPrince<State>::attempt(const Rhs& f, double h) {
  using namespace dormand_prince_tableau;
  evaluate_first(f);
  [&]<std::size_t... I>(std::index_sequence<I...>) { (evaluate<I + 1>(f, h), ...); }
  (std::make_index_sequence<kStages - 1>());
  effort_.evaluations += kStages - 1;
  // Here h stays outside: rounded weights h b_i would not add up to h, and the clock of the solution would be wrong by
  // that.
  increment_ = h * increment<Solution>(1, k_) + y_carry_;
  y_new_ = y_ + increment_;
}

template <class State>
void DormandPrince<State>::accept(double h) {
  // Knuth's two-sum: y_new_ + y_carry_ is y_ + increment_ without any rounding.
  y_stage_ = y_new_ - y_;  // what arrived of the increment
  y_carry_ = (y_ - (y_new_ - y_stage_)) + (increment_ - y_stage_);
  y_.swap(y_new_);
  const double dt = h + t_carry_, t_new = t_ + dt, arrived = t_new - t_;
  t_carry_ = (t_ - (t_new - arrived)) + (dt - arrived);
  t_ = t_new;
  has_first_ = false;
  ++effort_.accepted;
}

template <class State>
double DormandPrince<State>::error(double h) {
  using namespace dormand_prince_tableau;
  // 1/scale of each component, once for both: divisions are dear.
  y_stage_ =
      (tolerance_.absolute + tolerance_.relative * y_.array().abs().max(y_new_.array().abs())).inverse().matrix();
  const double err5 = increment<Error5>(h, k_).cwiseProduct(y_stage_).squaredNorm();
  const double err3 = increment<Error3>(h, k_).cwiseProduct(y_stage_).squaredNorm();
  return dormand_prince_error(err5, err3, static_cast<double>(y_.size()));
}

template <class State>
template <class Rhs>
void DormandPrince<State>::step(const Rhs& f, double h) {
  attempt(f, h);
  accept(h);
}

template <class State>
template <class Rhs>
void DormandPrince<State>::advance_to(const Rhs& f, double t_end) {
  require_finite_start(t_end, true);
  if (t_end == t_) return;
  if (h_ == 0) h_ = first_step(f, t_end - t_);
  h_ = std::copysign(h_, t_end - t_);
  bool again = false;
  while (true) {
    const double left = (t_end - t_) - t_carry_;
    const double h = step_towards(left, h_);
    attempt(f, h);
    const double err = error(h);
    if (err <= 1) {
      accept(h);
      // A step that was cut short by t_end must not make the next ones short.
      const double wanted = h * step_factor(err, again);
      if (h == h_ || std::abs(wanted) > std::abs(h_)) h_ = wanted;
      again = false;
      if (h == left) break;
    } else {
      ++effort_.rejected;
      again = true;
      h_ = h * step_factor(err, again);
      require_progress(t_, h_, t_end, err);
    }
  }
  t_ = t_end;
  t_carry_ = 0;
}

// The size at which the terms of order 0, 1 and 2 of y look like one of order 8 with an error of 1/100: Hairer,
// Norsett, Wanner, section II.4. One more evaluation tells the second derivative.
template <class State>
template <class Rhs>
double DormandPrince<State>::first_step(const Rhs& f, double span) {
  evaluate_first(f);
  const auto scale = tolerance_.absolute + tolerance_.relative * y_.array().abs();
  const double components = static_cast<double>(y_.size());
  const double size = std::sqrt((y_.array() / scale).square().sum() / components);
  const double speed = std::sqrt((k_[0].array() / scale).square().sum() / components);
  const double trial = trial_step(size, speed, span);
  y_stage_ = y_ + trial * k_[0];
  f(t_ + trial, std::as_const(y_stage_), k_[1]);
  ++effort_.evaluations;
  const double bend = std::sqrt(((k_[1] - k_[0]).array() / scale).square().sum() / components) / std::abs(trial);
  return first_step_size(t_, trial, speed, bend, span);
}

}  // namespace plumbline
