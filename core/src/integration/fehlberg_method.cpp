#include "fehlberg_method.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline::extended {
namespace {

namespace odeint = boost::numeric::odeint;

// Of a step. Errors add up over thousands of steps, and 1e-14 is asked of their sum.
constexpr Real kTolerance = 3e-18L;

}  // namespace

FehlbergMethod::FehlbergMethod(Motion& motion, Column x, Column u)
    : motion_(motion),
      h_(1e-3L * static_cast<Real>(motion.scenario().scales.time)),
      x_(std::move(x)),
      u_(std::move(u)) {}

void FehlbergMethod::advance_to(Real end) {
  using State = std::vector<Real>;
  const Eigen::Index split = x_.size();
  const auto size = static_cast<Eigen::Index>(x_.size() + u_.size());
  const auto field = [&](const State& y, State& dy, Real t) {
    const Eigen::Map<const Column> state(y.data(), size);
    Eigen::Map<Column> rates(dy.data(), size);
    motion_.rates(state.head(split), state.tail(u_.size()), rates.head(split));
    motion_.accelerations(t, state.head(split), state.tail(u_.size()), rates.tail(u_.size()));
    // Step control drops NaN.
    if (!rates.allFinite()) {
      throw std::runtime_error("the motion is not finite at t = " + std::to_string(static_cast<double>(t)) + " s");
    }
  };
  const Scales& scales = motion_.scenario().scales;
  const double smallest = std::min({1.0, scales.length, scales.velocity(), 1 / scales.time});
  auto solver = odeint::make_controlled(kTolerance * static_cast<Real>(smallest), kTolerance,
                                        odeint::runge_kutta_fehlberg78<State, Real>());
  State y(static_cast<std::size_t>(size));
  Eigen::Map<Column> state(y.data(), size);
  state << x_, u_;
  while (t_ < end) {
    const bool last = h_ >= end - t_;
    Real t = t_, h = last ? end - t_ : h_;
    if (solver.try_step(field, y, t, h) == odeint::success) {
      t_ = last ? end : t;
      h_ = last ? std::max(h_, h) : h;
    } else {
      h_ = h;
    }
    if (!(h_ > 1e-18L * std::max(static_cast<Real>(scales.time), t_))) {
      throw std::runtime_error("the second method's steps underflow at t = " + std::to_string(static_cast<double>(t_)) +
                               " s");
    }
  }
  x_ = state.head(split);
  u_ = state.tail(u_.size());
  motion_.project(x_, u_);
}

}  // namespace plumbline::extended
