#include "plumbline/core/events/event_driven_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline {

std::optional<Impact> EventDrivenSimulator::next_impact(double until) {
  if (!(until >= now_)) {
    throw std::invalid_argument("events are processed forwards: " + std::to_string(until) + " s lies before " +
                                std::to_string(now_) + " s");
  }
  for (;;) {
    if (!due_.empty()) {
      const Impact impact = due_.back();
      due_.pop_back();
      ++counts_.impacts;
      return impact;
    }
    const int i = queue_.first();
    const Event event = events_[static_cast<std::size_t>(i)];
    if (event.kind == EventKind::kNone || event.time > until) {
      if (std::isfinite(until)) now_ = until;
      return std::nullopt;
    }
    now_ = event.time;
    std::optional<Impact> impact;
    switch (event.kind) {
      case EventKind::kCrossing:
        cross(i, event.partner);
        break;
      case EventKind::kBall:
        if (bodies_[static_cast<std::size_t>(event.partner)].course == event.course) {
          impact = collide(i, event.partner);
        } else {
          ++counts_.stale;
          schedule(i);
        }
        break;
      case EventKind::kWall:
        impact = hit_wall(i, event.partner);
        break;
      case EventKind::kTrainEnd:
        impact = end_train(i);
        break;
      case EventKind::kNone:
        break;  // has returned above
    }
    if (impact) {
      ++counts_.impacts;
      return impact;
    }
  }
}

std::uint64_t EventDrivenSimulator::run_until(double until) {
  std::uint64_t n = 0;
  while (next_impact(until)) ++n;
  return n;
}

std::vector<Impact> EventDrivenSimulator::record_until(double until) {
  std::vector<Impact> impacts;
  while (auto impact = next_impact(until)) impacts.push_back(*impact);
  return impacts;
}

// Course slide 23: the impulse (1 + e) u / (1/m_i + 1/m_j) along the line of centres, u the speed of approach along it.
std::optional<Impact> EventDrivenSimulator::collide(int i, int j) {
  count_at_once();
  // Only a ball hit at the very end of its train is still in it.
  for (const int k : {i, j}) {
    if (bodies_[static_cast<std::size_t>(k)].in_train) leave_train(k);
  }
  Body &a = bodies_[static_cast<std::size_t>(i)], &b = bodies_[static_cast<std::size_t>(j)];
  fly(a);
  fly(b);
  Vec3 d = b.p - a.p;
  if (scene_.period) d -= d.cwiseQuotient(*scene_.period).array().round().matrix().cwiseProduct(*scene_.period);
  // The unit vector of the actual distance, not d / (r_i + r_j): so the impulse keeps energy to rounding even where the
  // distance has a rounding error.
  const Vec3 n = d.normalized();
  const double approach = n.dot(a.v - b.v);
  std::optional<Impact> impact;
  if (approach > 0) {
    // Both counts must go on, so no short circuit here.
    const bool collapse_a = collapses(a, j), collapse_b = collapses(b, i);
    const double e = collapse_a || collapse_b ? 1 : scene_.restitution;
    const double impulse = (1 + e) * approach / (a.inverse_mass + b.inverse_mass);
    a.v -= impulse * a.inverse_mass * n;
    b.v += impulse * b.inverse_mass * n;
    for (Body* body : {&a, &b}) {
      ++body->course;
      lift_or_keep(*body);
    }
    impact = Impact{now_, static_cast<std::size_t>(i), static_cast<std::size_t>(j), false, false, -impulse * n};
    if (j < i) {
      std::swap(impact->ball, impact->partner);
      impact->impulse_W = -impact->impulse_W;
    }
  }
  schedule(i);
  schedule(j);
  return impact;
}

Impact EventDrivenSimulator::hit_wall(int i, int wall) {
  count_at_once();
  Body& body = bodies_[static_cast<std::size_t>(i)];
  fly(body);
  const Vec3& n = scene_.walls[static_cast<std::size_t>(wall)].plane.normal_W;
  const double e = now_ <= body.elastic_until ? 1 : scene_.walls[static_cast<std::size_t>(wall)].restitution;
  const double approach = std::max(0.0, -n.dot(body.v));
  body.v += (1 + e) * approach * n;
  ++body.course;
  lift_or_keep(body);
  Impact impact{now_, static_cast<std::size_t>(i), static_cast<std::size_t>(wall), true, false, Vec3::Zero()};
  impact.impulse_W = (1 + e) * approach / body.inverse_mass * n;
  impact.comes_to_rest = come_to_rest(i, wall, e * approach, e);
  if (!body.in_train) schedule(i);
  return impact;
}

void EventDrivenSimulator::cross(int i, int face) {
  ++counts_.crossings;
  Body& body = bodies_[static_cast<std::size_t>(i)];
  fly(body);
  const int axis = face / 2;
  const bool upwards = face % 2 == 1;
  const double jump = cells_.cross(i, axis, upwards);
  if (jump != 0) {
    body.p[axis] += jump;
    body.images[axis] += upwards ? 1 : -1;
  }
  schedule(i);
}

// Takes note of an impact of the body with a ball; true while such impacts are to lose no energy.
bool EventDrivenSimulator::collapses(Body& body, int partner) const {
  const double pause = now_ - body.last_impact;
  body.streak = pause <= rules_.collapse_time ? body.streak + 1 : 1;
  const bool again = partner == body.last_partner && pause > rules_.cascade_time && pause <= rules_.collapse_time;
  if (again || body.streak > rules_.collapse_impacts) body.elastic_until = now_ + rules_.collapse_time;
  body.last_partner = partner;
  body.last_impact = now_;
  return now_ <= body.elastic_until;
}

void EventDrivenSimulator::count_at_once() {
  events_at_once_ = now_ == last_event_ ? events_at_once_ + 1 : 1;
  last_event_ = now_;
  if (events_at_once_ > rules_.max_impacts_at_once) {
    throw std::runtime_error("more than " + std::to_string(rules_.max_impacts_at_once) + " impacts at the time " +
                             std::to_string(now_) +
                             " s: balls are caught between others; raise collapse_time in the event rules");
  }
}

Ball EventDrivenSimulator::ball(std::size_t index) const {
  Body body = bodies_.at(index);
  place_now(body, index);
  return {body.p, body.v, body.radius, scene_.balls[index].mass};
}

std::vector<Ball> EventDrivenSimulator::balls() const {
  std::vector<Ball> all;
  all.reserve(bodies_.size());
  for (std::size_t k = 0; k < bodies_.size(); ++k) all.push_back(ball(k));
  return all;
}

void EventDrivenSimulator::place_now(Body& body, std::size_t index) const {
  fly(body);
  if (!body.in_train) return;
  const Train& train = trains_.at(static_cast<int>(index));
  const BounceTrain::Hop hop = train.bounces.at(now_);
  const Vec3& n = scene_.walls[static_cast<std::size_t>(train.wall)].plane.normal_W;
  body.p += hop.height * n;
  body.v += hop.speed * n;
}

Vec3 EventDrivenSimulator::unwrapped_position(std::size_t index) const {
  Vec3 p = ball(index).p_WB;
  if (scene_.period) p += bodies_[index].images.cast<double>().cwiseProduct(*scene_.period);
  return p;
}

bool EventDrivenSimulator::rests(std::size_t index) const {
  const Body& body = bodies_.at(index);
  return !body.supports.empty() && !body.in_train;
}

double EventDrivenSimulator::kinetic_energy() const {
  double sum = 0;
  for (const Ball& b : balls()) sum += std::isinf(b.mass) ? 0 : 0.5 * b.mass * b.v_WB.squaredNorm();
  return sum;
}

double EventDrivenSimulator::potential_energy() const {
  double sum = 0;
  for (const Ball& b : balls()) sum -= std::isinf(b.mass) ? 0 : b.mass * scene_.gravity_W.dot(b.p_WB);
  return sum;
}

Vec3 EventDrivenSimulator::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const Ball& b : balls()) sum += std::isinf(b.mass) ? Vec3::Zero().eval() : (b.mass * b.v_WB).eval();
  return sum;
}

}  // namespace plumbline
