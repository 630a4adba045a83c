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

std::vector<Contact> Simulator::touching() const {
  std::vector<Contact> contacts, all;
  for (const Pair pair : pairs_) {
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

bool Simulator::rests(const Contact& c) const { return std::abs(approach_speed(c, states_)) <= rounding_speed(c); }

}  // namespace plumbline
