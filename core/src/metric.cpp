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
  for (std::size_t k = 0; k < common_samples(c); ++k) largest = max_or_nan(largest, largest_at<distance>(c, k));
  return largest;
}

template <Distance distance>
double root_mean_square(const Comparison& c) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < common_samples(c); ++k) {
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
  return largest_at<distance>(c, common_samples(c) - 1);
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

bool always(const Scenario&) { return true; }
bool has_events(const Scenario& s) { return !s.events.empty(); }
bool has_joints(const Scenario& s) { return !s.joints.empty(); }

constexpr Metric kTable[] = {
    {"position.max", "m", "largest distance of a centre of mass from the reference", maximum<position>, always},
    {"position.rms", "m", "root mean square of that distance over samples and bodies", root_mean_square<position>,
     always},
    {"position.final", "m", "that distance at the last sample, largest over bodies", final_value<position>, always},
    {"velocity.max", "m/s", "largest difference of a velocity from the reference", maximum<velocity>, always},
    {"velocity.rms", "m/s", "root mean square of that difference", root_mean_square<velocity>, always},
    {"velocity.final", "m/s", "that difference at the last sample", final_value<velocity>, always},
    {"attitude.max", "rad", "largest geodesic angle between attitude and reference", maximum<attitude>, always},
    {"attitude.rms", "rad", "root mean square of that angle", root_mean_square<attitude>, always},
    {"attitude.final", "rad", "that angle at the last sample", final_value<attitude>, always},
    {"angular_velocity.max", "rad/s", "largest difference of an angular velocity from the reference",
     maximum<angular_velocity>, always},
    {"angular_velocity.rms", "rad/s", "root mean square of that difference", root_mean_square<angular_velocity>,
     always},
    {"angular_velocity.final", "rad/s", "that difference at the last sample", final_value<angular_velocity>, always},
    {"energy.max", "1",
     "signed energy error of largest magnitude, over the scenario's energy scale; a gain is positive",
     signed_maximum<energy_error>, always},
    {"energy.final", "1", "signed energy error at the last sample, over the scenario's energy scale",
     signed_final<energy_error>, always},
    {"momentum.max", "1", "largest error of linear momentum, over the scenario's momentum scale",
     signed_maximum<momentum_error>, always},
    {"momentum.final", "1", "error of linear momentum at the last sample", signed_final<momentum_error>, always},
    {"angular_momentum.max", "1",
     "largest error of angular momentum about the origin, over momentum scale times length scale",
     signed_maximum<angular_momentum_error>, always},
    {"angular_momentum.final", "1", "error of angular momentum at the last sample",
     signed_final<angular_momentum_error>, always},
    {"event_time.max", "s", "largest error of the time of an event; infinite when one never happens", event_time_error,
     has_events},
    {"events.missed", "1", "number of events of the reference that the trajectory does not show", events_missed,
     has_events},
    {"joint_gap.max", "m", "how far a joint comes apart at most; for its axes the sine of the angle [rad]", joint_gap,
     has_joints},
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
