#include "claim.hpp"

#include <algorithm>
#include <cmath>

#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

constexpr int kSamples = 200;
constexpr double kRoundings = 64 * 0x1p-53;

// Angle between two attitudes [rad].
double angle_between(const Quat& a, const Quat& b) {
  const Quat turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

}  // namespace

double compared_until(const Scenario& scenario) {
  return scenario.t_valid > 0 ? std::min(scenario.duration, scenario.t_valid) : scenario.duration;
}

std::vector<BodyState> states_of(const Scenario& scenario, const Reference& reference, double t) {
  std::vector<BodyState> states;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) states.push_back(reference.at(b, t));
  return states;
}

Extent extent_of(const Scenario& scenario, const Reference& reference, double until) {
  Extent extent{scenario.scales.length, scenario.scales.velocity(), 1 / scenario.scales.time,
                scenario.scales.momentum()};
  for (int k = 0; k <= kSamples; ++k) {
    double momentum = 0;
    for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
      if (scenario.bodies[b].fixed) continue;
      const BodyState s = reference.at(b, until * k / kSamples);
      extent.place = max_or_nan(extent.place, s.p_WB.norm());
      extent.speed = max_or_nan(extent.speed, s.v_WB.norm());
      extent.spin = max_or_nan(extent.spin, s.w_WB.norm());
      momentum += scenario.bodies[b].mass * s.v_WB.norm();
    }
    extent.momentum = max_or_nan(extent.momentum, momentum);
  }
  return extent;
}

Claim claim_of(const Scenario& scenario, const Reference& reference, double until) {
  Claim claim;
  claim.extent = extent_of(scenario, reference, until);
  const double stated = reference.uncertainty();
  const Extent& e = claim.extent;
  const double fall = scenario.gravity.norm() * until;  // two large numbers may cancel to a small speed
  claim.place = stated * scenario.scales.length + kRoundings * (e.place + (e.speed + fall) * until);
  claim.velocity = stated * e.speed + kRoundings * (e.speed + fall);
  claim.attitude = stated + kRoundings * (1 + e.spin * until);
  claim.spin = (stated + kRoundings) * e.spin;
  return claim;
}

Differences differences(const Scenario& scenario, const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  Differences result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (scenario.bodies[i].fixed) continue;
    result.place = max_or_nan(result.place, (a[i].p_WB - b[i].p_WB).norm());
    result.velocity = max_or_nan(result.velocity, (a[i].v_WB - b[i].v_WB).norm());
    result.attitude = max_or_nan(result.attitude, angle_between(a[i].q_WB, b[i].q_WB));
    result.spin = max_or_nan(result.spin, (a[i].w_WB - b[i].w_WB).norm());
  }
  return result;
}

Differences larger(const Differences& a, const Differences& b) {
  return {max_or_nan(a.place, b.place), max_or_nan(a.velocity, b.velocity), max_or_nan(a.attitude, b.attitude),
          max_or_nan(a.spin, b.spin)};
}

void Worst::offer(double difference, double allowed, double scale, const std::string& text) {
  const double now = difference / allowed;
  if (std::isnan(ratio) || now <= ratio) return;  // NaN comes in, and then stays
  ratio = now;
  figure = difference / scale;
  bound = allowed / scale;
  what = text;
}

void Worst::offer(const Differences& found, const Differences& allowed, const Extent& extent, const std::string& text) {
  offer(found.place, allowed.place, extent.place, "place" + text);
  offer(found.velocity, allowed.velocity, extent.speed, "velocity" + text);
  offer(found.attitude, allowed.attitude, 1, "attitude" + text);
  offer(found.spin, allowed.spin, extent.spin, "angular velocity" + text);
}

}  // namespace plumbline
