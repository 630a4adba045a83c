#include "plumbline/core/integration/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

[[noreturn]] void give_up(double t, double h, const char* why) {
  std::ostringstream text;
  text.precision(17);
  text << "Dormand-Prince: the step is down to " << h << " s at t = " << t << " s: " << why;
  throw std::runtime_error(text.str());
}

}  // namespace

void require_tolerance(const Tolerance& tolerance) {
  if (!(tolerance.relative >= 1e-17 && tolerance.relative <= 0.1)) {
    throw std::invalid_argument(
        "Dormand-Prince: the relative tolerance must lie in [1e-17, 0.1]; below, f itself rounds more");
  }
  if (!(tolerance.absolute > 0 && std::isfinite(tolerance.absolute))) {
    throw std::invalid_argument(
        "Dormand-Prince: the absolute tolerance must be positive; it rules where a component is zero");
  }
}

void require_finite_start(double t, bool state_is_finite) {
  if (!std::isfinite(t)) throw std::invalid_argument("Dormand-Prince: the time is not finite");
  if (!state_is_finite) throw std::invalid_argument("Dormand-Prince: the initial state is not finite");
}

double dormand_prince_error(double err5_squared, double err3_squared, double components) {
  const double both = err5_squared + 0.01 * err3_squared;
  if (both == 0) return 0;
  return err5_squared / std::sqrt(components * both);
}

double step_factor(double err, bool after_rejection) {
  if (!std::isfinite(err)) return 0.1;
  const double root = std::sqrt(std::sqrt(std::sqrt(err)));  // err^(1/8)
  const double factor = err > 0 ? 0.9 / root : 6;
  return std::clamp(factor, 1.0 / 3, after_rejection ? 1.0 : 6.0);
}

double step_towards(double left, double wanted) {
  if (std::abs(wanted) >= std::abs(left)) return left;
  return std::abs(left) < 2 * std::abs(wanted) ? 0.5 * left : wanted;
}

void require_progress(double t, double h, double t_end, double err) {
  if (std::abs(h) > 16 * kEps * std::max(std::abs(t), std::abs(t_end))) return;
  if (!std::isfinite(err)) give_up(t, h, "the right-hand side is not finite here");
  give_up(
      t, h,
      "the problem is singular or too stiff for an explicit method, or the tolerance lies below the rounding of the "
      "right-hand side; loosen it, or end before this time");
}

double trial_step(double size, double speed, double span) {
  const double h = size < 1e-5 || speed < 1e-5 ? 1e-6 : 0.01 * size / speed;
  return std::copysign(std::min(h, std::abs(span)), span);
}

double first_step_size(double t, double trial, double speed, double bend, double span) {
  if (!std::isfinite(speed) || !std::isfinite(bend)) give_up(t, trial, "the right-hand side is not finite here");
  const double most = std::max(speed, bend);
  const double h = most <= 1e-15 ? std::max(1e-6, 1e-3 * std::abs(trial)) : std::pow(0.01 / most, 0.125);
  return std::min({100 * std::abs(trial), h, std::abs(span)});
}

}  // namespace plumbline
