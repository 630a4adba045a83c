// What comes next for a ball: the earliest of its crossing into another cell, the walls and the balls around it.
#include <algorithm>
#include <cmath>

#include "plumbline/core/events/event_driven_simulator.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNever = std::numeric_limits<double>::infinity();
// Two that touch and were just made to part may approach by the rounding of their velocities. That is no impact.
constexpr double kRoundings = 8;

// First t >= 0 at which gap + speed t + acceleration t^2/2 comes down to 0; a gap below 0 is rounding and counts as 0.
// The approaching root has the slope -sqrt(speed^2 - 2 acceleration gap); written so that nothing cancels.
double closing_time(double gap, double speed, double acceleration) {
  gap = std::max(gap, 0.0);
  const double radicand = speed * speed - 2 * acceleration * gap;
  if (!(radicand >= 0)) return kNever;
  const double slope = std::sqrt(radicand);
  if (speed < 0) {
    if (slope == 0 && acceleration > 0) return kNever;  // stops exactly at the surface and turns back
    return 2 * gap / (slope - speed);
  }
  return acceleration < 0 ? (speed + slope) / -acceleration : kNever;
}

}  // namespace

void EventDrivenSimulator::fly(Body& body) const {
  const double dt = now_ - body.time;
  body.p += dt * (body.v + 0.5 * dt * body.a);
  body.v += dt * body.a;
  body.time = now_;
}

// `me` has been brought to now_, the other one has not.
EventDrivenSimulator::Sight EventDrivenSimulator::sight(const Body& me, const Body& other, const Vec3& shift) const {
  const double dt = now_ - other.time;
  return {other.p + dt * (other.v + 0.5 * dt * other.a) + shift - me.p, other.v + dt * other.a - me.v, other.a - me.a,
          me.radius + other.radius};
}

// Time from now [s] until the two touch, if that is less than `before`.
double EventDrivenSimulator::meeting_time(const Sight& s, const Body& me, const Body& other, double before) const {
  if (s.a.x() == 0 && s.a.y() == 0 && s.a.z() == 0) {
    // |d + v t| = R: t = (d^2 - R^2) / (-d.v + sqrt(R^2 v^2 - |d x v|^2)), course slide 16. The radicand in this form
    // keeps its digits for grazing spheres.
    const double closing = -s.d.dot(s.v);
    if (!(closing > 0)) return kNever;
    const double clear = s.d.squaredNorm() - s.reach * s.reach;
    if (clear <= 0) {
      return closing > kRoundings * kEps * s.reach * (me.v.norm() + other.v.norm()) ? 0 : kNever;
    }
    if (clear > 2 * closing * before) return kNever;  // the root in the denominator is at most `closing`
    const double radicand = s.reach * s.reach * s.v.squaredNorm() - s.d.cross(s.v).squaredNorm();
    return radicand > 0 ? clear / (closing + std::sqrt(radicand)) : kNever;
  }
  // One falls, the other rests. They are out of reach for good when |a| t^2/2 > |d| + R + |v| t.
  const double d = s.d.norm(), v = s.v.norm(), a = s.a.norm();
  const double horizon = std::min(before, (v + std::sqrt(v * v + 2 * a * (d + s.reach))) / a);
  if (d - v * horizon - 0.5 * a * horizon * horizon > s.reach) return kNever;
  Motion moving;
  moving.start.p_WB = s.d;
  moving.start.v_WB = s.v;
  moving.a_W = s.a;
  const auto found = sphere_meets_sphere(moving, other.radius, Motion{}, me.radius, horizon);
  if (!found) return kNever;
  // The search stops within 1e-13 of the distance; one step of Newton's method takes the rest.
  const double t = *found;
  const Vec3 at = s.d + t * s.v + 0.5 * t * t * s.a;
  const double slope = at.normalized().dot(s.v + t * s.a), gap = at.norm() - s.reach;
  if (t == 0 && -slope <= kRoundings * kEps * (me.v.norm() + other.v.norm()) && at.dot(s.a) >= 0) return kNever;
  const double better = t - gap / slope;
  return std::abs(better - t) <= 1e-6 * horizon && better >= 0 ? better : t;
}

// Time from now until the ball, with its radius grown by the margin, touches the wall.
double EventDrivenSimulator::wall_time(const Body& body, const Wall& wall, double margin) const {
  const Vec3& n = wall.plane.normal_W;
  const double gap = n.dot(body.p) - wall.plane.offset - body.radius - margin;
  const double speed = n.dot(body.v), acceleration = n.dot(body.a);
  if (gap <= 0 && acceleration >= 0 && -speed <= kRoundings * kEps * body.v.norm()) return kNever;
  return closing_time(gap, speed, acceleration);
}

EventDrivenSimulator::Event EventDrivenSimulator::crossing(int i, const Body& body) const {
  Event event;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = body.p[axis], v = body.v[axis], a = body.a[axis];
    const double up = closing_time(cells_.upper_face(i, axis) - p, -v, -a);
    const double down = closing_time(p - cells_.lower_face(i, axis), v, a);
    const double t = now_ + std::min(up, down);
    if (t < event.time) event = {t, 2 * axis + (up < down ? 1 : 0), 0, EventKind::kCrossing};
  }
  return event;
}

EventDrivenSimulator::Event EventDrivenSimulator::predict(int i) {
  ++counts_.predictions;
  Body& me = bodies_[static_cast<std::size_t>(i)];
  fly(me);
  Event first = crossing(i, me);
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    const int wall = static_cast<int>(w);
    if (std::find(me.supports.begin(), me.supports.end(), wall) != me.supports.end()) continue;
    const double t = now_ + wall_time(me, scene_.walls[w], 0);
    if (t < kNever && t <= first.time) first = {t, wall, 0, EventKind::kWall};
  }
  cells_.visit_near(i, [&](int j, const Vec3& shift) {
    const Body& other = bodies_[static_cast<std::size_t>(j)];
    if (other.in_train) {
      const Train& train = trains_.at(j);
      const double left = train.bounces.end() - now_;
      if (may_meet(other, train.wall, train.bounces.height(), me, 0, -shift, left)) leave_train(j);
    }
    const double t = now_ + meeting_time(sight(me, other, shift), me, other, first.time - now_);
    // Of two partners at the same time the one with the smaller index, in whatever order the cells list them.
    const bool tie = t == first.time && first.kind == EventKind::kBall && j < first.partner;
    if (t < first.time || tie) first = {t, j, other.course, EventKind::kBall};
  });
  return first;
}

void EventDrivenSimulator::schedule(int i) {
  const auto k = static_cast<std::size_t>(i);
  Event& event = events_[k];
  event = bodies_[k].fixed() ? Event{} : predict(i);
  queue_.set(i, event.time);
}

}  // namespace plumbline
