// Balls that rest on walls, and trains of ever smaller bounces that end in rest.
#include <algorithm>
#include <cmath>

#include "plumbline/core/events/event_driven_simulator.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRoundings = 8;
// A train hops at most this high, relative to the largest radius, so that no ball leaves the sight of its neighbours:
// cells are a hundredth wider than a diameter.
constexpr double kHighestHop = 1e-3;

// A hop that is lower than this [m] cannot be told from rest.
double resolution(const Vec3& p, double radius) { return 4 * kEps * (p.cwiseAbs().maxCoeff() + radius); }

bool holds(const std::vector<int>& walls, int wall) {
  return std::find(walls.begin(), walls.end(), wall) != walls.end();
}

}  // namespace

// The acceleration of a ball that rests on walls without friction: g + sum of lambda_k n_k with lambda_k >= 0, and none
// into a wall. Walls that would have to pull are let go. The velocity, too, loses what it has into or off the walls.
void EventDrivenSimulator::support(Body& body) const {
  const Vec3& g = scene_.gravity_W;
  std::vector<int>& walls = body.supports;
  for (;;) {
    const auto n = static_cast<Eigen::Index>(walls.size());
    Eigen::Matrix3Xd normals(3, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      normals.col(k) = scene_.walls[static_cast<std::size_t>(walls[static_cast<std::size_t>(k)])].plane.normal_W;
    }
    if (n > 0) {
      const Eigen::MatrixXd gram = normals.transpose() * normals;
      const Eigen::VectorXd push = gram.completeOrthogonalDecomposition().solve(-(normals.transpose() * g));
      Eigen::Index weakest = 0;
      if (push.minCoeff(&weakest) < -kRoundings * kEps * g.norm()) {
        walls.erase(walls.begin() + weakest);
        continue;
      }
    }
    // The part of g across all the normals, by making them orthogonal one after the other: exactly 0 in the directions
    // of walls that are parallel to the axes.
    body.a = g;
    for (Eigen::Index k = 0; k < n; ++k) {
      Vec3 direction = normals.col(k);
      for (Eigen::Index j = 0; j < k; ++j) direction -= normals.col(j) * normals.col(j).dot(direction);
      const double length = direction.norm();
      normals.col(k) = length > 1e-8 ? Vec3(direction / length) : Vec3::Zero();
      body.a -= normals.col(k) * normals.col(k).dot(body.a);
      body.v -= normals.col(k) * normals.col(k).dot(body.v);
    }
    return;
  }
}

// After an impact: does the ball stay on the walls on which it has rested?
void EventDrivenSimulator::lift_or_keep(Body& body) const {
  if (body.supports.empty()) return;
  const double speed = body.v.norm();
  std::erase_if(body.supports, [&](int wall) {
    const Vec3& n = scene_.walls[static_cast<std::size_t>(wall)].plane.normal_W;
    const double lift = n.dot(body.v), pull = std::max(0.0, -n.dot(scene_.gravity_W));
    const double least = std::sqrt(2 * pull * resolution(body.p, body.radius));
    // Off the wall it flies; into the wall it has an impact, at once. In between it stays.
    if (std::abs(lift) > std::max(kRoundings * kEps * speed, least)) return true;
    body.v -= lift * n;
    return false;
  });
  support(body);
}

void EventDrivenSimulator::rest_on(Body& body, int wall) const {
  const Plane& plane = scene_.walls[static_cast<std::size_t>(wall)].plane;
  body.p += (plane.offset + body.radius - plane.normal_W.dot(body.p)) * plane.normal_W;
  if (!holds(body.supports, wall)) body.supports.push_back(wall);
  support(body);
}

// After an impact on the wall with that rebound speed: true if the ball rests now. It may also have begun a train.
bool EventDrivenSimulator::come_to_rest(int i, int wall, double rebound, double e) {
  Body& body = bodies_[static_cast<std::size_t>(i)];
  const double pull = -scene_.walls[static_cast<std::size_t>(wall)].plane.normal_W.dot(body.a);
  if (pull < 0) return false;
  if (rebound <= kRoundings * kEps * body.v.norm()) {
    rest_on(body, wall);
    return true;
  }
  if (pull == 0) return false;
  const BounceTrain train{now_, rebound, pull, e};
  const bool too_low = train.height() <= resolution(body.p, body.radius);
  // On two walls at once, hops as low as that would be fed by the rounding of the other wall's position.
  if (too_low && !body.supports.empty()) {
    rest_on(body, wall);
    return true;
  }
  const bool short_enough = train.duration() <= rules_.train_time || (too_low && rules_.train_time > 0);
  if (e < 1 && short_enough && undisturbed(i, wall, train)) {
    rest_on(body, wall);  // from now on its p and v slide along the wall; the hops are added from the series
    body.in_train = true;
    trains_[i] = {train, wall};
    events_[static_cast<std::size_t>(i)] = {train.end(), wall, 0, EventKind::kTrainEnd};
    queue_.set(i, train.end());
    return false;
  }
  if (too_low) rest_on(body, wall);
  return too_low;
}

double EventDrivenSimulator::hop_height(int i) const {
  const auto train = trains_.find(i);
  return train == trains_.end() ? 0 : train->second.bounces.height();
}

// Can a ball that slides on the wall, and hops up to that height, touch the other one within that time? Errs on the
// side of yes.
bool EventDrivenSimulator::may_meet(const Body& sliding, int wall, double height, const Body& other,
                                    double other_height, const Vec3& shift, double within) const {
  Body me = sliding;
  fly(me);
  Sight s = sight(me, other, shift);
  const double exact = s.reach, hops = height + other_height;
  if (holds(other.supports, wall)) {
    // Both on one wall: a hop h turns the distance d into |d - h n|, and |d - h n|^2 >= d^2 - 2 h |d.n|. Balls of the
    // same size, with d.n = 0, only get farther from each other.
    const double step = std::abs(sliding.radius - other.radius);
    s.reach = std::sqrt(exact * exact + 2 * hops * step);
  } else {
    s.reach += hops;
  }
  if (s.reach > exact && s.d.squaredNorm() < s.reach * s.reach) return true;
  return meeting_time(s, me, other, within) <= within;
}

bool EventDrivenSimulator::undisturbed(int i, int wall, const BounceTrain& train) const {
  const double height = train.height(), duration = train.duration();
  if (height > kHighestHop * largest_radius_) return false;
  Body sliding = bodies_[static_cast<std::size_t>(i)];
  rest_on(sliding, wall);
  if (crossing(i, sliding).time <= train.end()) return false;
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (holds(sliding.supports, static_cast<int>(w))) continue;
    if (wall_time(sliding, scene_.walls[w], height) <= duration) return false;
  }
  bool free = true;
  cells_.visit_near(i, [&](int j, const Vec3& shift) {
    const Body& other = bodies_[static_cast<std::size_t>(j)];
    free = free && !may_meet(sliding, wall, height, other, hop_height(j), shift, duration);
  });
  return free;
}

// Back to single bounces, from where the ball is now.
void EventDrivenSimulator::leave_train(int i) {
  Body& body = bodies_[static_cast<std::size_t>(i)];
  const auto [bounces, wall] = trains_.at(i);
  place_now(body, static_cast<std::size_t>(i));
  // What the wall has given so far: the change of the normal speed, and the weight that it held.
  const double given = bounces.at(now_).speed - bounces.speed + bounces.pull * (now_ - bounces.start);
  const Vec3& n = scene_.walls[static_cast<std::size_t>(wall)].plane.normal_W;
  due_.push_back(
      {now_, static_cast<std::size_t>(i), static_cast<std::size_t>(wall), true, false, given / body.inverse_mass * n});
  std::erase(body.supports, wall);
  support(body);
  body.in_train = false;
  trains_.erase(i);
  ++body.course;
  schedule(i);
}

Impact EventDrivenSimulator::end_train(int i) {
  Body& body = bodies_[static_cast<std::size_t>(i)];
  fly(body);
  const Train train = trains_.at(i);
  trains_.erase(i);
  body.in_train = false;
  rest_on(body, train.wall);
  schedule(i);
  const Vec3& n = scene_.walls[static_cast<std::size_t>(train.wall)].plane.normal_W;
  return {now_,
          static_cast<std::size_t>(i),
          static_cast<std::size_t>(train.wall),
          true,
          true,
          train.bounces.impulse() / body.inverse_mass * n};
}

}  // namespace plumbline
