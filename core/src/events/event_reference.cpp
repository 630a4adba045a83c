#include "plumbline/core/events/event_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline {
namespace {

constexpr std::size_t kNoBall = std::numeric_limits<std::size_t>::max();

// Each ball is moved by `shift` along (1, -1, 1) or its opposite, in turn.
EventScene scene_of(const Scenario& scenario, double shift) {
  if (!scenario.contact) throw std::invalid_argument("nothing collides in it; take a closed form");
  if (scenario.contact->friction != 0) throw std::invalid_argument("its spheres must be smooth: friction = 0");
  if (!scenario.forces.empty() || !scenario.joints.empty() || !scenario.springs.empty()) {
    throw std::invalid_argument("only gravity may act between impacts");
  }
  EventScene scene;
  scene.gravity_W = scenario.gravity;
  scene.restitution = scenario.contact->restitution;
  double sign = shift;
  for (const Body& body : scenario.bodies) {
    if (const auto* half = std::get_if<HalfSpace>(&body.shape)) {
      scene.walls.push_back({{half->normal, half->normal.dot(body.initial.p_WB)}, scenario.contact->restitution});
    } else if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      const double mass = body.fixed ? std::numeric_limits<double>::infinity() : body.mass;
      scene.balls.push_back({body.initial.p_WB + sign * Vec3(1, -1, 1), body.initial.v_WB, sphere->radius, mass});
      sign = -sign;
    } else {
      throw std::invalid_argument("it is for spheres and half-spaces; '" + body.name + "' is neither");
    }
  }
  return scene;
}

}  // namespace

EventReference::EventReference(const Scenario& scenario, std::string citation) : citation_(std::move(citation)) {
  std::size_t balls = 0;
  for (const Body& body : scenario.bodies) {
    initial_.push_back(body.initial);
    ball_of_.push_back(std::holds_alternative<Sphere>(body.shape) ? balls++ : kNoBall);
  }
  start_ = std::make_unique<const EventDrivenSimulator>(scene_of(scenario, 0));
  const double length = scenario.scales.length;
  EventDrivenSimulator off(scene_of(scenario, 1e-15 * length));
  const double end = std::min(scenario.t_valid, scenario.duration);
  off.run_until(end);
  go_to(end);
  for (std::size_t b = 0; b < balls; ++b) {
    const double distance = (off.ball(b).p_WB - now_->ball(b).p_WB).norm() / length;
    uncertainty_ = std::isnan(distance) ? distance : std::max(uncertainty_, distance);
  }
}

void EventReference::go_to(double t) const {
  if (!now_ || now_->time() > t) now_ = std::make_unique<EventDrivenSimulator>(*start_);
  now_->run_until(t);
}

BodyState EventReference::at(std::size_t body, double t) const {
  BodyState state = initial_[body];
  if (ball_of_[body] == kNoBall) return state;
  go_to(t);
  const Ball ball = now_->ball(ball_of_[body]);
  state.p_WB = ball.p_WB;
  state.v_WB = ball.v_WB;
  state.q_WB = rotation_by(t * state.w_WB) * state.q_WB;  // nothing turns a smooth sphere
  return state;
}

}  // namespace plumbline
