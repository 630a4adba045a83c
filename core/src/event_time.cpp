#include "plumbline/core/event_time.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace plumbline {
namespace {

struct Relative {
  Vec3 p, v;
};

Relative relative(const Trajectory& t, std::size_t sample, const Event& e) {
  const BodyState &a = t.at(sample, e.body_a), &b = t.at(sample, e.body_b);
  return {a.p_WB - b.p_WB, a.v_WB - b.v_WB};
}

// Share of the reference's jump that makes a jump count, and that makes a smaller one next to it belong to it.
constexpr double kCounts = 0.25, kBelongs = 0.02;

// What the reference does around an event.
struct Expected {
  Vec3 direction = Vec3::Zero();  // unit, of the jump in relative velocity
  double jump = 0;                // its size [m/s]
  double before = 0, after = 0;   // acceleration along the direction on either side [m/s^2]
};

Expected expected_at(const Trajectory& reference, const Event& event) {
  Expected result;
  // The samples on either side. One that lies on the event, but for rounding, is on neither.
  constexpr double kMargin = 1e-6;
  const double dt = reference.dt(), step = event.time / dt;
  const auto before = static_cast<std::size_t>(std::max(0.0, std::floor(step - kMargin)));
  const auto after = static_cast<std::size_t>(std::max(0.0, std::ceil(step + kMargin)));
  if (after >= reference.samples()) return result;
  const Vec3 v0 = relative(reference, before, event).v, v1 = relative(reference, after, event).v;
  Vec3 drift = Vec3::Zero();  // change of velocity over one step of free flight
  if (before > 0) drift = v0 - relative(reference, before - 1, event).v;
  const Vec3 jump = v1 - v0 - static_cast<double>(after - before) * drift;
  result.jump = jump.norm();
  if (!(result.jump > 0)) return result;
  result.direction = jump / result.jump;
  result.before = result.direction.dot(drift) / dt;
  result.after = result.before;
  if (after + 1 < reference.samples()) {
    const Vec3 next = relative(reference, after + 1, event).v - v1;
    // A second event within the next step would pass for an acceleration.
    if (next.norm() < kBelongs * result.jump + drift.norm()) result.after = result.direction.dot(next) / dt;
  }
  return result;
}

class Finder {
 public:
  Finder(const Trajectory& t, const Event& event, const Expected& expected)
      : t_(t), event_(event), expected_(expected) {}

  // First event that begins at sample `from` or later; `from` moves behind it.
  std::optional<double> find(std::size_t& from) const {
    for (std::size_t k = from; k + 1 < t_.samples(); ++k) {
      if (!(jump(k, expected_.before) > kBelongs * expected_.jump)) continue;
      std::size_t end = k + 1;
      double total = jump(k, expected_.before);
      while (end + 1 < t_.samples() && goes_on(end)) total += jump(end++, expected_.before);
      if (total >= kCounts * expected_.jump) {
        from = end;
        return meeting_time(k, end);
      }
      k = end - 1;
    }
    return std::nullopt;
  }

 private:
  double along(const Vec3& v) const { return expected_.direction.dot(v); }
  double speed(std::size_t k) const { return along(relative(t_, k, event_).v); }
  double place(std::size_t k) const { return along(relative(t_, k, event_).p); }
  // Change of speed over the step from sample k that the acceleration does not explain [m/s].
  double jump(std::size_t k, double acceleration) const { return speed(k + 1) - speed(k) - acceleration * t_.dt(); }

  // The step from sample k is still part of the impact: it is free motion neither as before nor as after it. (A body
  // that lies is free of jumps by the acceleration after, not by that of its fall.)
  bool goes_on(std::size_t k) const {
    const double least = kBelongs * expected_.jump;
    return jump(k, expected_.before) > least && std::abs(jump(k, expected_.after)) > least;
  }

  // Where s_i + u_i tau + a0/2 tau^2, the flight before, meets s_j - u_j (T - tau) + a1/2 (T - tau)^2, the motion
  // after; tau is counted from t_i, T = t_j - t_i. Without accelerations the equation is linear; Newton's method starts
  // from there and converges in a few steps, since a T is small against the jump.
  double meeting_time(std::size_t i, std::size_t j) const {
    const double a0 = expected_.before, a1 = expected_.after, span = t_.time(j) - t_.time(i);
    const double ui = speed(i), uj = speed(j), gap = place(i) - place(j);
    double tau = (uj * span + gap) / (uj - ui);
    for (int k = 0; k < 8; ++k) {
      const double rest = span - tau;
      const double f = gap + ui * tau + 0.5 * a0 * tau * tau + uj * rest - 0.5 * a1 * rest * rest;
      tau -= f / (ui + a0 * tau - uj + a1 * rest);
    }
    const bool sensible = tau >= -2 * t_.dt() && tau <= span + 2 * t_.dt();
    return t_.time(i) + (sensible ? tau : span);
  }

  const Trajectory& t_;
  const Event& event_;
  const Expected& expected_;
};

}  // namespace

std::vector<std::optional<double>> event_times(const Comparison& c) {
  std::vector<std::optional<double>> times;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> next;  // per pair: where the search goes on
  for (const Event& event : c.scenario.events) {
    const Expected expected = expected_at(c.expected, event);
    if (!(expected.jump > 0)) {
      times.emplace_back();
      continue;
    }
    times.push_back(Finder(c.actual, event, expected).find(next[std::minmax(event.body_a, event.body_b)]));
  }
  return times;
}

}  // namespace plumbline
