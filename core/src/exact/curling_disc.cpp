#include "plumbline/core/exact/curling_disc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plumbline/core/exact/elliptic_integral.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"

namespace plumbline {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInterval = 0.5;  // between stored states, in s
constexpr double kRest = 1e-17;    // of the first speed: what is left then moves nothing any more

// The parameter with its complement 1 - m = (1 - a)(1 + a), which keeps its digits near 1.
EllipticModulus modulus_of_root(double a) { return {a * a, (1 - a) * (1 + a)}; }

// (1 - m) K(m), which is 0 for m = 1 where K is infinite.
double damped_k(const EllipticModulus& modulus) {
  return modulus.complement == 0 ? 0 : modulus.complement * complete_elliptic_k(modulus);
}

// Gauss's series 1 + ab/c x + ...: for x below 0.01, where the brackets of E and K cancel.
constexpr double kSmall = 0.01;
double gauss_series(double a, double b, double c, double x) {
  double sum = 1, term = 1;
  for (int n = 0; n < 12; ++n) {
    term *= (a + n) * (b + n) / ((c + n) * (1 + n)) * x;
    sum += term;
  }
  return sum;
}

}  // namespace

double disc_friction_force(double e) {
  const double below = std::min(e, 1 / e), square = below * below;  // force = min(e, 1) F(-1/2, 1/2; 2; square)
  if (square < kSmall) return std::min(e, 1.0) * gauss_series(-0.5, 0.5, 2, square);
  const EllipticModulus m = modulus_of_root(below);
  const double bracket = (1 + square) * complete_elliptic_e(m) - damped_k(m);
  return std::min(e, 1.0) * 4 * bracket / (3 * kPi * square);
}

double disc_friction_moment(double e) {
  if (e > 1) {
    const double square = 1 / (e * e);  // moment = F(1/2, 1/2; 3; square)/(4 e)
    if (square < kSmall) return gauss_series(0.5, 0.5, 3, square) / (4 * e);
    const EllipticModulus m = modulus_of_root(1 / e);
    return 4 * e * ((4 - 2 * e * e) * complete_elliptic_e(m) + (2 * e * e - 3) * damped_k(m)) / (9 * kPi);
  }
  const EllipticModulus m = modulus_of_root(e);
  return 4 * ((4 - 2 * e * e) * complete_elliptic_e(m) - damped_k(m)) / (9 * kPi);
}

CurlingDisc::CurlingDisc(double radius, double inertia, double deceleration, double speed, double spin)
    : radius_(radius), inertia_(inertia), deceleration_(deceleration) {
  if (!(radius > 0 && inertia > 0 && deceleration > 0 && speed > 0 && spin > 0 &&
        std::isfinite(radius * inertia * deceleration * speed * spin))) {
    throw std::invalid_argument("a disc needs radius, inertia, friction, gravity, speed and spin > 0");
  }
  State y;
  y << std::log(radius * spin), speed / (radius * spin), 0, 0, 0, 0;
  const double last = std::log(kRest * std::max(speed, radius * spin));
  for (nodes_.push_back(y); nodes_.back()(0) > last;) nodes_.push_back(advance(nodes_.back(), kInterval));
  stop_time_ = nodes_.back()(2);
}

CurlingDisc::State CurlingDisc::rates(const State& y) const {
  const double rim = std::exp(y(0)), e = y(1), spin_down = disc_friction_moment(e) / inertia_;
  State slope;
  slope << -spin_down, e * spin_down - disc_friction_force(e), rim / deceleration_, e * rim * rim / deceleration_,
      rim * rim / (radius_ * deceleration_), 0;
  return slope;
}

CurlingDisc::State CurlingDisc::advance(const State& y, double by) const {
  if (by == 0) return y;
  DormandPrince<State> solver({.relative = 1e-15, .absolute = 1e-16});
  solver.start(0, y);
  solver.advance_to([this](double, const State& now, State& slope) { slope = rates(now); }, by);
  return solver.state();
}

DiscState CurlingDisc::at(double t) const {
  if (!(t >= 0)) throw std::invalid_argument("the motion starts at t = 0");
  if (t >= stop_time_) return {nodes_.back()(3), 0, nodes_.back()(4), 0};
  const auto next =
      std::upper_bound(nodes_.begin(), nodes_.end(), t, [](double x, const State& y) { return x < y(2); });
  const State& node = *(next - 1);
  // t rises with s, at R w/(mu g): Newton's iteration, kept within the interval.
  double by = 0, low = 0, high = kInterval;
  State y = node;
  for (int k = 0; k < 60; ++k) {
    const double missing = t - y(2);
    (missing > 0 ? low : high) = by;
    const double better = by + missing * deceleration_ / std::exp(y(0));
    const double to = better > low && better < high ? better : 0.5 * (low + high);
    if (to == by || std::abs(missing) <= 1e-16 * t) break;
    by = to;
    y = advance(node, by);
  }
  return {y(3), y(1) * std::exp(y(0)), y(4), std::exp(y(0)) / radius_};
}

double CurlingDisc::final_ratio() const { return nodes_.back()(1); }

}  // namespace plumbline
