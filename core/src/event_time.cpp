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

// What the reference does around an event.
struct Expected {
  Vec3 direction = Vec3::Zero();  // unit, of the jump in relative velocity
  double jump = 0;                // its size [m/s]
  double acceleration = 0;        // along the direction, just before [m/s^2]
};

Expected expected_at(const Trajectory& reference, const Event& event) {
  Expected result;
  const double dt = reference.dt();
  const auto before = static_cast<std::size_t>(std::floor(event.time / dt));
  if (before + 1 >= reference.samples()) return result;
  const Vec3 v0 = relative(reference, before, event).v;
  Vec3 drift = Vec3::Zero();  // change of velocity over one step of free flight
  if (before > 0) drift = v0 - relative(reference, before - 1, event).v;
  const Vec3 jump = relative(reference, before + 1, event).v - v0 - drift;
  result.jump = jump.norm();
  if (!(result.jump > 0)) return result;
  result.direction = jump / result.jump;
  result.acceleration = result.direction.dot(drift) / dt;
  return result;
}

class Finder {
 public:
  Finder(const Trajectory& t, const Event& event, const Expected& expected)
      : t_(t), event_(event), expected_(expected) {}

  // First event that begins at sample `from` or later; `from` moves behind it.
  std::optional<double> find(std::size_t& from) const {
    for (std::size_t k = from; k + 1 < t_.samples(); ++k) {
      if (!(excess(k) > kBelongs * expected_.jump)) continue;
      std::size_t end = k + 1;
      double total = excess(k);
      while (end + 1 < t_.samples() && excess(end) > kBelongs * expected_.jump) total += excess(end++);
      if (total >= kCounts * expected_.jump) {
        from = end;
        return meeting_time(k, end);
      }
      k = end - 1;
    }
    return std::nullopt;
  }

 private:
  static constexpr double kCounts = 0.25, kBelongs = 0.02;

  double along(const Vec3& v) const { return expected_.direction.dot(v); }
  double speed(std::size_t k) const { return along(relative(t_, k, event_).v); }
  double place(std::size_t k) const { return along(relative(t_, k, event_).p); }
  double excess(std::size_t k) const { return speed(k + 1) - speed(k) - expected_.acceleration * t_.dt(); }

  // s_i + u_i (t-t_i) + a/2 (t-t_i)^2 = s_j + u_j (t-t_j) + a/2 (t-t_j)^2 is linear in t: the squares cancel.
  double meeting_time(std::size_t i, std::size_t j) const {
    const double a = expected_.acceleration, span = t_.time(j) - t_.time(i);
    const double ui = speed(i), uj = speed(j);
    const double slope = ui - (uj - a * span);
    const double tau = (place(j) - place(i) - uj * span + 0.5 * a * span * span) / slope;  // counted from t_i
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
