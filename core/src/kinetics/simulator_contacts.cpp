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

double Simulator::resting_speed(const Contact& c) const {
  const auto of = [&](std::size_t i) -> Vec3 {
    return free_[i].linear + free_[i].angular.cross(c.point_W - states_[i].p_WB);
  };
  return std::max(2 * std::abs(c.normal_W.dot(of(c.body_a) - of(c.body_b))) * dt_, rounding_speed(c));
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

bool Simulator::rests(const Contact& c) const { return std::abs(approach_speed(c, states_)) <= rounding_speed(c); }

}  // namespace plumbline
