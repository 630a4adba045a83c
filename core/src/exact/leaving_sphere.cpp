#include "plumbline/core/exact/leaving_sphere.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace plumbline {
namespace {

constexpr double kPi = std::numbers::pi;

double rate_squared(double path_radius, double inertia, double gravity) {
  if (!(path_radius > 0 && inertia >= 0 && gravity > 0 && std::isfinite(path_radius * inertia * gravity))) {
    throw std::invalid_argument("a body on a ball needs radius > 0, inertia >= 0 and gravity > 0");
  }
  return gravity / ((1 + inertia) * path_radius);
}

}  // namespace

LeavingSphere::LeavingSphere(double path_radius, double body_radius, double inertia, double gravity, double angle,
                             double rate)
    : path_radius_(path_radius),
      body_radius_(body_radius),
      inertia_(inertia),
      gravity_(gravity),
      start_(angle),
      pendulum_(std::sqrt(rate_squared(path_radius, inertia, gravity)), {angle - kPi, rate}) {
  if (!(body_radius > 0) || !(angle > 0 && angle < kPi / 2) || !(rate >= 0)) {
    throw std::invalid_argument("a body on a ball starts beside the top, 0 < angle < pi/2, and moves down or rests");
  }
  const double energy = std::cos(angle) + (1 + inertia) * path_radius * rate * rate / (2 * gravity);
  const double cosine = 2 * energy / (3 + inertia);
  if (!(cosine < std::cos(angle))) throw std::invalid_argument("it is so fast that it takes off at once");
  leaving_angle_ = std::acos(cosine);
  // The angle rises with time: doubled until it is beyond, then halved to the last bit.
  double before = 0, after = std::sqrt(path_radius / gravity);
  while (pendulum_.at(after).angle + kPi < leaving_angle_) before = std::exchange(after, 2 * after);
  for (double middle = 0.5 * (before + after); middle > before && middle < after; middle = 0.5 * (before + after)) {
    (pendulum_.at(middle).angle + kPi < leaving_angle_ ? before : after) = middle;
  }
  leaving_time_ = after;
}

LeavingState LeavingSphere::on_sphere(double t) const {
  const PendulumState now = pendulum_.at(t);
  const double angle = now.angle + kPi, s = std::sin(angle), c = std::cos(angle), speed = path_radius_ * now.rate;
  const double rolled = inertia_ > 0 ? path_radius_ / body_radius_ : 0;
  return {path_radius_ * s, path_radius_ * c, speed * c, -speed * s, rolled * (angle - start_), rolled * now.rate};
}

LeavingState LeavingSphere::at(double t) const {
  if (!(t >= 0)) throw std::invalid_argument("the motion starts at t = 0");
  if (t <= leaving_time_) return on_sphere(t);
  LeavingState state = on_sphere(leaving_time_);
  const double flown = t - leaving_time_;
  state.across += state.v_across * flown;
  state.up += (state.v_up - 0.5 * gravity_ * flown) * flown;
  state.v_up -= gravity_ * flown;
  state.turn += state.spin * flown;
  return state;
}

double LeavingSphere::slip_bound(double friction) const {
  if (inertia_ == 0) return 0;
  if (!(friction > 0)) throw std::invalid_argument("nothing rolls without friction");
  // Rolling needs k sin theta/(1 + k) g of friction and has mu times the pressure, which grows back from take-off as
  // (3 + k)/(1 + k) g (cos theta - cos theta_s). What is missing is at most all of it, over the time that this takes.
  const double s = std::sin(leaving_angle_), rate = pendulum_.at(leaving_time_).rate;
  const double short_of = inertia_ * s / ((3 + inertia_) * friction);  // in the cosine of the angle
  return inertia_ / (1 + inertia_) * gravity_ * s * short_of / (s * rate);
}

}  // namespace plumbline
