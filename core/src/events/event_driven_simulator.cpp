#include "plumbline/core/events/event_driven_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline {
namespace {

// Cells are this much wider than a diameter, so that a ball that hops a little across a face is still seen.
constexpr double kCellMargin = 1.01;
// Overlap, relative to the size, that is taken for rounding of the scene.
constexpr double kOverlap = 1e-10;

std::invalid_argument bad(const std::string& what, std::size_t index, const std::string& why) {
  return std::invalid_argument(what + " " + std::to_string(index) + ": " + why);
}

bool is_restitution(double e) { return e >= 0 && e <= 1; }

}  // namespace

EventDrivenSimulator::EventDrivenSimulator(EventScene scene, const EventRules& rules)
    : scene_(std::move(scene)), rules_(rules) {
  check_scene();
  const std::size_t n = scene_.balls.size();
  bodies_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Ball& ball = scene_.balls[k];
    Body& body = bodies_[k];
    body.p = ball.p_WB;
    if (scene_.period) {
      body.images = ball.p_WB.cwiseQuotient(*scene_.period).array().floor().cast<int>();
      body.p -= body.images.cast<double>().cwiseProduct(*scene_.period);
    }
    body.v = ball.v_WB;
    body.radius = ball.radius;
    body.inverse_mass = 1 / ball.mass;
    body.a = body.fixed() ? Vec3::Zero() : scene_.gravity_W;
    largest_radius_ = std::max(largest_radius_, ball.radius);
  }
  build_cells();
  check_overlaps();
  events_.resize(n);
  queue_ = EventQueue(static_cast<int>(n));
  for (std::size_t k = 0; k < n; ++k) schedule(static_cast<int>(k));
}

void EventDrivenSimulator::check_scene() const {
  if (scene_.balls.empty()) throw std::invalid_argument("an event-driven scene needs at least one ball");
  if (!scene_.gravity_W.allFinite()) throw std::invalid_argument("the gravity must be finite");
  if (!is_restitution(scene_.restitution)) throw std::invalid_argument("the restitution must lie in [0, 1]");
  for (std::size_t k = 0; k < scene_.balls.size(); ++k) {
    const Ball& ball = scene_.balls[k];
    if (!ball.p_WB.allFinite() || !ball.v_WB.allFinite()) throw bad("ball", k, "position and velocity must be finite");
    if (!(ball.radius > 0 && std::isfinite(ball.radius))) throw bad("ball", k, "the radius must be > 0 and finite");
    if (!(ball.mass > 0)) throw bad("ball", k, "the mass must be > 0 (infinite for one that never moves)");
    if (std::isinf(ball.mass) && ball.v_WB != Vec3::Zero()) {
      throw bad("ball", k, "one of infinite mass must not move: give it the velocity 0");
    }
  }
  for (std::size_t k = 0; k < scene_.walls.size(); ++k) {
    const Wall& wall = scene_.walls[k];
    if (!(std::abs(wall.plane.normal_W.norm() - 1) <= 1e-12)) throw bad("wall", k, "the normal must have length 1");
    if (!std::isfinite(wall.plane.offset)) throw bad("wall", k, "the offset must be finite");
    if (!is_restitution(wall.restitution)) throw bad("wall", k, "the restitution must lie in [0, 1]");
  }
  if (scene_.period && !scene_.walls.empty()) {
    throw std::invalid_argument("a periodic box has no walls: leave out one or the other");
  }
  if (scene_.period && !(scene_.period->allFinite() && scene_.period->minCoeff() > 0)) {
    throw std::invalid_argument("the edges of the periodic box must be > 0 and finite");
  }
  const bool rules_make_sense = rules_.train_time >= 0 && rules_.cascade_time >= 0 && rules_.collapse_time >= 0 &&
                                rules_.collapse_impacts >= 0 && rules_.max_impacts_at_once > 0;
  if (!rules_make_sense) throw std::invalid_argument("the times and counts of the event rules must not be negative");
}

// The grid covers the box between walls that are parallel to the axes, and else what the balls take up at the start.
void EventDrivenSimulator::build_cells() {
  Vec3 low = bodies_.front().p, high = low;
  for (const Body& body : bodies_) {
    low = low.cwiseMin(body.p);
    high = high.cwiseMax(body.p);
  }
  for (const Wall& wall : scene_.walls) {
    for (int axis = 0; axis < 3; ++axis) {
      if (wall.plane.normal_W == Vec3::Unit(axis)) low[axis] = std::min(low[axis], wall.plane.offset);
      if (wall.plane.normal_W == -Vec3::Unit(axis)) high[axis] = std::max(high[axis], -wall.plane.offset);
    }
  }
  if (scene_.period) {
    low = Vec3::Zero();
    high = *scene_.period;
  }
  const int n = static_cast<int>(bodies_.size());
  cells_ = EventCells(low, high, 2 * kCellMargin * largest_radius_, n, scene_.period.has_value());
  for (int k = 0; k < n; ++k) cells_.insert(k, bodies_[static_cast<std::size_t>(k)].p);
}

void EventDrivenSimulator::check_overlaps() const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& body = bodies_[k];
    if (!body.fixed()) {
      for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
        const Plane& plane = scene_.walls[w].plane;
        if (plane.normal_W.dot(body.p) - plane.offset < body.radius * (1 - kOverlap)) {
          throw bad("ball", k, "overlaps wall " + std::to_string(w) + " or is behind it");
        }
      }
    }
    cells_.visit_near(static_cast<int>(k), [&](int j, const Vec3& shift) {
      const Sight s = sight(body, bodies_[static_cast<std::size_t>(j)], shift);
      if (s.d.norm() < s.reach * (1 - kOverlap)) throw bad("ball", k, "overlaps ball " + std::to_string(j));
    });
  }
}

std::optional<Impact> EventDrivenSimulator::next_impact(double until) {
  if (!(until >= now_)) {
    throw std::invalid_argument("events are processed forwards: " + std::to_string(until) + " s lies before " +
                                std::to_string(now_) + " s");
  }
  for (;;) {
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
