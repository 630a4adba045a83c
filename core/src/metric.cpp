#include "plumbline/core/metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plumbline/core/event_time.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {
namespace {

Vec3 polar(const Vec3& v, bool in_plane) { return in_plane ? Vec3(v.x(), 0, v.z()) : v; }

// Distances between two states of one body.
using Distance = double (*)(const BodyState& actual, const BodyState& expected, bool in_plane);

double position(const BodyState& a, const BodyState& e, bool in_plane) {
  return polar(a.p_WB - e.p_WB, in_plane).norm();
}
double velocity(const BodyState& a, const BodyState& e, bool in_plane) {
  return polar(a.v_WB - e.v_WB, in_plane).norm();
}
double attitude(const BodyState& a, const BodyState& e, bool) { return geodesic_angle(a.q_WB, e.q_WB); }
double angular_velocity(const BodyState& a, const BodyState& e, bool in_plane) {
  return in_plane ? std::abs(a.w_WB.y() - e.w_WB.y()) : (a.w_WB - e.w_WB).norm();
}

std::size_t common_samples(const Comparison& c) { return std::min(c.actual.samples(), c.expected.samples()); }

// Whether states may be compared one by one at that sample: before chaos has taken over, and where the truth is known.
bool comparable(const Comparison& c, std::size_t sample) {
  const double t = c.actual.time(sample), slack = 1e-6 * c.actual.dt();
  if (t > c.scenario.t_valid + slack) return false;
  const auto& known = c.scenario.known_at;
  return known.empty() || std::any_of(known.begin(), known.end(), [&](double k) { return std::abs(t - k) <= slack; });
}

template <Distance distance>
double largest_at(const Comparison& c, std::size_t k) {
  double largest = 0;
  for (std::size_t b = 0; b < c.scenario.bodies.size(); ++b) {
    if (!c.scenario.bodies[b].fixed) {
      largest = max_or_nan(largest, distance(c.actual.at(k, b), c.expected.at(k, b), c.in_plane));
    }
  }
  return largest;
}

template <Distance distance>
double maximum(const Comparison& c) {
  double largest = 0;
  for (std::size_t k = 0; k < common_samples(c); ++k) {
    if (comparable(c, k)) largest = max_or_nan(largest, largest_at<distance>(c, k));
  }
  return largest;
}

template <Distance distance>
double root_mean_square(const Comparison& c) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < common_samples(c); ++k) {
    if (!comparable(c, k)) continue;
    for (std::size_t b = 0; b < c.scenario.bodies.size(); ++b) {
      if (c.scenario.bodies[b].fixed) continue;
      const double d = distance(c.actual.at(k, b), c.expected.at(k, b), c.in_plane);
      sum += d * d;
      ++count;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

template <Distance distance>
double final_value(const Comparison& c) {
  std::size_t last = common_samples(c);
  while (last > 0 && !comparable(c, last - 1)) --last;
  return last == 0 ? std::numeric_limits<double>::quiet_NaN() : largest_at<distance>(c, last - 1);
}

std::span<const BodyState> sample_of(const Trajectory& t, std::size_t k) {
  return t.states().subspan(k * t.bodies(), t.bodies());
}

// Deviations of an invariant from the reference's value at one sample, in the scenario's own units.
using InvariantError = double (*)(const Comparison&, std::size_t sample);

double energy_error(const Comparison& c, std::size_t k) {
  return (energy(c.scenario, sample_of(c.actual, k), c.in_plane) -
          energy(c.scenario, sample_of(c.expected, k), c.in_plane)) /
         c.scenario.scales.energy();
}
double momentum_error(const Comparison& c, std::size_t k) {
  return (momentum(c.scenario, sample_of(c.actual, k), c.in_plane) -
          momentum(c.scenario, sample_of(c.expected, k), c.in_plane))
             .norm() /
         c.scenario.scales.momentum();
}
double angular_momentum_error(const Comparison& c, std::size_t k) {
  return (angular_momentum(c.scenario, sample_of(c.actual, k), c.in_plane) -
          angular_momentum(c.scenario, sample_of(c.expected, k), c.in_plane))
             .norm() /
         (c.scenario.scales.momentum() * c.scenario.scales.length);
}

// The value of largest magnitude, with its sign.
template <InvariantError error>
double signed_maximum(const Comparison& c) {
  double largest = 0;
  for (std::size_t k = 0; k < common_samples(c); ++k) {
    const double value = error(c, k);
    if (std::isnan(value)) return value;
    if (std::abs(value) > std::abs(largest)) largest = value;
  }
  return largest;
}

template <InvariantError error>
double signed_final(const Comparison& c) {
  return error(c, common_samples(c) - 1);
}

// An event that never happens is infinitely late: no limit can pass it.
double event_time_error(const Comparison& c) {
  const auto found = event_times(c);
  double largest = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k]) return std::numeric_limits<double>::infinity();
    largest = max_or_nan(largest, std::abs(*found[k] - c.scenario.events[k].time));
  }
  return largest;
}

double events_missed(const Comparison& c) {
  const auto found = event_times(c);
  return static_cast<double>(std::count(found.begin(), found.end(), std::nullopt));
}

// What the joints lack, over the run: how far anchors are apart, or axes from parallel.
double joint_gap(const Comparison& c) {
  const ArticulatedBody body = articulated_body(c.scenario);
  double largest = 0;
  for (std::size_t k = 0; k < common_samples(c); ++k) {
    largest = max_or_nan(largest, joint_error(body, sample_of(c.actual, k)));
  }
  return largest;
}

double critical_value(const Comparison& c) {
  return c.critical ? c.critical->middle() : std::numeric_limits<double>::quiet_NaN();
}

// Half the bracket is what the search itself may miss.
double critical_error(const Comparison& c) { return (critical_value(c) - c.scenario.threshold->exact); }

bool is_motion(const Scenario& s) { return !s.threshold; }
bool is_known(const Scenario& s) { return is_motion(s) && s.pointwise; }
bool is_known_throughout(const Scenario& s) { return is_motion(s) && s.known_at.empty(); }
bool has_events(const Scenario& s) { return is_motion(s) && !s.events.empty(); }
bool has_joints(const Scenario& s) { return is_motion(s) && !s.joints.empty(); }
bool has_threshold(const Scenario& s) { return s.threshold.has_value(); }

constexpr Metric kTable[] = {
    {"position.max", "m", "largest distance of a centre of mass from the reference", maximum<position>, is_known},
    {"position.rms", "m", "root mean square of that distance over samples and bodies", root_mean_square<position>,
     is_known},
    {"position.final", "m", "that distance at the last sample, largest over bodies", final_value<position>, is_known},
    {"velocity.max", "m/s", "largest difference of a velocity from the reference", maximum<velocity>, is_known},
    {"velocity.rms", "m/s", "root mean square of that difference", root_mean_square<velocity>, is_known},
    {"velocity.final", "m/s", "that difference at the last sample", final_value<velocity>, is_known},
    {"attitude.max", "rad", "largest geodesic angle between attitude and reference", maximum<attitude>, is_known},
    {"attitude.rms", "rad", "root mean square of that angle", root_mean_square<attitude>, is_known},
    {"attitude.final", "rad", "that angle at the last sample", final_value<attitude>, is_known},
    {"angular_velocity.max", "rad/s", "largest difference of an angular velocity from the reference",
     maximum<angular_velocity>, is_known},
    {"angular_velocity.rms", "rad/s", "root mean square of that difference", root_mean_square<angular_velocity>,
     is_known},
    {"angular_velocity.final", "rad/s", "that difference at the last sample", final_value<angular_velocity>, is_known},
    {"energy.max", "1",
     "signed energy error of largest magnitude, over the scenario's energy scale; a gain is positive",
     signed_maximum<energy_error>, is_known_throughout},
    {"energy.final", "1", "signed energy error at the last sample, over the scenario's energy scale",
     signed_final<energy_error>, is_known_throughout},
    {"momentum.max", "1", "largest error of linear momentum, over the scenario's momentum scale",
     signed_maximum<momentum_error>, is_known_throughout},
    {"momentum.final", "1", "error of linear momentum at the last sample", signed_final<momentum_error>,
     is_known_throughout},
    {"angular_momentum.max", "1",
     "largest error of angular momentum about the origin, over momentum scale times length scale",
     signed_maximum<angular_momentum_error>, is_known_throughout},
    {"angular_momentum.final", "1", "error of angular momentum at the last sample",
     signed_final<angular_momentum_error>, is_known_throughout},
    {"event_time.max", "s", "largest error of the time of an event; infinite when one never happens", event_time_error,
     has_events},
    {"events.missed", "1", "number of events of the reference that the trajectory does not show", events_missed,
     has_events},
    {"joint_gap.max", "m", "how far a joint comes apart at most; for its axes the sine of the angle [rad]", joint_gap,
     has_joints},
    {"threshold.value", "", "the parameter's value at which the engine's answer changes, as bisection finds it",
     critical_value, has_threshold},
    {"threshold.error", "", "that value less the exact one, in the unit of the parameter", critical_error,
     has_threshold},
};

}  // namespace

std::span<const Metric> metrics() { return kTable; }

const Metric* find_metric(std::string_view name) {
  for (const Metric& metric : kTable) {
    if (metric.name == name) return &metric;
  }
  return nullptr;
}

double max_or_nan(double a, double b) { return std::isnan(a) || a > b ? a : b; }

double position_distance_at(const Trajectory& a, const Trajectory& b, std::size_t sample, bool in_plane) {
  double largest = 0;
  for (std::size_t body = 0; body < a.bodies(); ++body) {
    largest = max_or_nan(largest, position(a.at(sample, body), b.at(sample, body), in_plane));
  }
  return largest;
}

double position_distance(const Trajectory& a, const Trajectory& b, bool in_plane) {
  double largest = 0;
  for (std::size_t k = 0; k < std::min(a.samples(), b.samples()); ++k) {
    largest = max_or_nan(largest, position_distance_at(a, b, k, in_plane));
  }
  return largest;
}

}  // namespace plumbline
