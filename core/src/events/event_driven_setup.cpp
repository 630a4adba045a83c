// From a scene to a simulator that knows its first events.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "plumbline/core/events/event_driven_simulator.hpp"

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

}  // namespace plumbline
