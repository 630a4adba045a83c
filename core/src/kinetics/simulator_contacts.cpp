// What the simulator takes for touching, and for resting: the two judgements behind every contact.
#include <algorithm>
#include <cmath>
#include <limits>

#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Diameter of the smallest sphere around it [m]; a half-space has no size.
double size_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return 2 * sphere->radius;
  if (const auto* box = std::get_if<Box>(&shape)) return box->size.norm();
  return 0;
}

BodyState moved(const Motion& m, double t) {
  BodyState s = m.start;
  s.p_WB += t * s.v_WB + 0.5 * t * t * m.a_W;
  s.q_WB = rotation_by(t * s.w_WB) * s.q_WB;
  return s;
}

}  // namespace

// Positions themselves are only known to rounding, which far from the origin is more than a part of the size.
double Simulator::tolerance(Pair pair) const {
  const double reach = states_[pair.a].p_WB.norm() + states_[pair.b].p_WB.norm();
  const double size = size_of(bodies_[pair.a].shape) + size_of(bodies_[pair.b].shape);
  return options_.contact_tolerance * size + 8 * kEpsilon * reach;
}

// Between the smallest spheres around the two bodies [m]; a half-space is everywhere near.
double Simulator::clearance(Pair pair) const {
  const Shape &a = bodies_[pair.a].shape, &b = bodies_[pair.b].shape;
  if (std::holds_alternative<HalfSpace>(b)) return 0;
  return (states_[pair.a].p_WB - states_[pair.b].p_WB).norm() - 0.5 * (size_of(a) + size_of(b));
}

bool Simulator::within_reach(Pair pair, const Accelerations& held, double horizon) const {
  const double speed = (states_[pair.a].v_WB - states_[pair.b].v_WB).norm();
  const double gain = (held[pair.a].linear - held[pair.b].linear).norm() * horizon;
  return !(clearance(pair) > (speed + 0.5 * gain) * horizon + tolerance(pair));
}

std::vector<Contact> Simulator::touching() const {
  std::vector<Contact> contacts, all;
  for (const Pair pair : pairs_) {
    if (clearance(pair) > tolerance(pair)) continue;
    all.clear();
    append_contacts(bodies_, states_, pair, all);
    for (const Contact& c : all) {
      if (c.gap <= tolerance(pair)) contacts.push_back(c);
    }
  }
  return contacts;
}

// Approach speeds below this are what rounding, and the residual of apply_impulses, leave of zero. Four digits are
// kept above kEpsilon for the several hundred operations that lead to a velocity.
double Simulator::rounding_speed(const Contact& c) const {
  const auto of = [&](std::size_t i) {
    const BodyState& s = states_[i];
    const double arm = (c.point_W - s.p_WB).norm();
    return s.v_WB.norm() + (free_[i].linear * dt_).norm() + arm * (s.w_WB.norm() + (free_[i].angular * dt_).norm());
  };
  // A fixed half-space may have its origin far from the contact, but it has no velocity either.
  return 1e4 * kEpsilon * (of(c.body_a) + of(c.body_b));
}

// Bodies that touch a fixed one, or one that is held up.
std::vector<bool> Simulator::held_up(std::span<const Contact> contacts) const {
  std::vector<bool> held(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) held[i] = bodies_[i].fixed;
  for (bool more = true; more;) {
    more = false;
    for (const Contact& c : contacts) {
      if (held[c.body_a] == held[c.body_b]) continue;
      held[c.body_a] = held[c.body_b] = more = true;
    }
  }
  return held;
}

double Simulator::resting_speed(const Contact& c, const std::vector<bool>& held_up) const {
  const auto of = [&](std::size_t i) -> Vec3 {
    return free_[i].linear + free_[i].angular.cross(c.point_W - states_[i].p_WB);
  };
  const double a = c.normal_W.dot(of(c.body_a)), b = c.normal_W.dot(of(c.body_b));
  // In a pile the free accelerations of two neighbours are alike, and tell nothing of what presses them together.
  const double pressing = held_up[c.body_a] ? std::max(std::abs(a), std::abs(b)) : 0;
  return std::max(
      {2 * std::abs(c.normal_W.dot(of(c.body_a) - of(c.body_b))) * dt_, 2 * pressing * dt_, rounding_speed(c)});
}

// Some point carries and none is pressed.
bool Simulator::rests_on(Pair pair, std::span<const Contact> contacts) const {
  bool carries = false;
  for (const Contact& c : contacts) {
    if (!(c.gap <= tolerance(pair))) continue;
    if (!(approach_speed(c, states_) <= rounding_speed(c))) return false;
    carries = carries || rests(c);
  }
  return carries;
}

// Two boxes that rest on each other in some points meet in further ones: a box rocks upon a box. They part nowhere that
// matters, so that the first moment at which a new point overlaps by the tolerance is found by bisection.
std::optional<double> Simulator::next_point_meets(Pair pair, std::span<const Contact> contacts, const Motion& a,
                                                  const Motion& b, double horizon) const {
  const double limit = tolerance(pair);
  const auto in_b = [](const Vec3& x_W, const BodyState& s) -> Vec3 { return s.q_WB.conjugate() * (x_W - s.p_WB); };
  std::vector<Vec3> known;  // points that touch already
  for (const Contact& c : contacts) {
    if (c.gap <= limit) known.push_back(in_b(c.point_W, states_[pair.b]));
  }
  const double same = 0.05 * (size_of(bodies_[pair.a].shape) + size_of(bodies_[pair.b].shape));
  std::vector<BodyState> at = states_;
  std::vector<Contact> then;
  const auto overlaps_anew = [&](double t) {
    at[pair.a] = moved(a, t);
    at[pair.b] = moved(b, t);
    then.clear();
    append_contacts(bodies_, at, pair, then);
    return std::any_of(then.begin(), then.end(), [&](const Contact& c) {
      const Vec3 x = in_b(c.point_W, at[pair.b]);
      return c.gap < -limit &&
             std::none_of(known.begin(), known.end(), [&](const Vec3& k) { return (k - x).norm() < same; });
    });
  };
  if (!overlaps_anew(horizon)) return std::nullopt;
  double before = 0, after = horizon;
  for (int k = 0; k < 60 && after - before > 1e-15 * horizon; ++k) {
    const double middle = 0.5 * (before + after);
    (overlaps_anew(middle) ? after : before) = middle;
  }
  return after;
}

bool Simulator::rests(const Contact& c) const { return std::abs(approach_speed(c, states_)) <= rounding_speed(c); }

}  // namespace plumbline
