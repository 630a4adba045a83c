#include "plumbline/core/constraints/bounded_coordinate.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {

namespace {

constexpr std::size_t kMostImpacts = 100000;
constexpr double kRestTime = 1e-9;  // [s]
constexpr double kNever = std::numeric_limits<double>::infinity();

// When a gap of that size that changes at that rate closes: the point and plane of slide 16.
double closing_time(double gap, double rate, double acceleration) {
  if (!std::isfinite(gap)) return kNever;
  Motion point;
  point.start.p_WB.x() = gap;
  point.start.v_WB.x() = rate;
  point.a_W.x() = acceleration;
  return point_meets_plane(point, {Vec3::UnitX(), 0}).value_or(kNever);
}

}  // namespace

BoundedCoordinate::BoundedCoordinate(double low, double high, double restitution, double x, double v, double a)
    : low_(low), high_(high), restitution_(restitution), x_(x), v_(v), a_(a) {
  if (!(low < high && low <= x && x <= high))
    throw std::invalid_argument("a bounded coordinate needs low < high and a start between them");
  if (!(std::isfinite(x) && std::isfinite(v) && std::isfinite(a)))
    throw std::invalid_argument("a bounded coordinate needs a finite start, velocity and acceleration");
  if (!(restitution >= 0 && restitution <= 1)) throw std::invalid_argument("restitution must lie in 0..1");
  if (v == 0 && ((x == low && a < 0) || (x == high && a > 0)))
    rests_ = true;  // pressed against the limit from the start
}

void BoundedCoordinate::hit(bool at_high) {
  const double into = at_high ? a_ : -a_;  // acceleration towards the limit
  impacts_.push_back({time_, at_high, std::abs(v_)});
  x_ = at_high ? high_ : low_;
  v_ *= -restitution_;
  const double u = std::abs(v_);
  if (u == 0) {
    rests_ = into >= 0;
    rest_time_ = time_;
  } else if (into > 0 && 2 * u < kRestTime * into * (1 - restitution_)) {
    rests_ = true;
    rest_time_ = time_ + 2 * u / (into * (1 - restitution_));
    v_ = 0;
  }
}

void BoundedCoordinate::advance_to(double time) {
  if (!(time >= time_)) throw std::invalid_argument("a bounded coordinate only moves forward in time");
  while (time_ < time && !rests_) {
    if (impacts_.size() > kMostImpacts) throw std::runtime_error("a coordinate met its limits more than 100000 times");
    const double to_low = closing_time(x_ - low_, v_, a_), to_high = closing_time(high_ - x_, -v_, -a_);
    const double wait = std::fmin(to_low, to_high);
    const double duration = std::fmin(wait, time - time_);
    x_ += (v_ + 0.5 * a_ * duration) * duration;
    v_ += a_ * duration;
    if (wait > time - time_) {
      time_ = time;
    } else {
      time_ += duration;
      hit(to_high < to_low);
    }
  }
  time_ = time;
}

}  // namespace plumbline
