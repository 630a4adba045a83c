#include "plumbline/core/constraints/link_constraint.hpp"

#include <stdexcept>

namespace plumbline {

LinkConstraint::LinkConstraint(std::size_t first, std::size_t second, double length)
    : LinkConstraint(first, second, length, length) {}

LinkConstraint::LinkConstraint(std::size_t first, std::size_t second, double shortest, double longest)
    : Constraint({first, second}, shortest, longest) {
  if (!(shortest >= 0 && shortest <= longest && longest > 0))
    throw std::invalid_argument("a link needs 0 <= shortest <= longest and longest > 0, in metres");
}

double LinkConstraint::quantity(std::span<const Vec3> p_W) const { return (p_W[1] - p_W[0]).norm(); }

PerParticle LinkConstraint::gradient(std::span<const Vec3> p_W) const {
  const Vec3 v = p_W[1] - p_W[0];
  const double d = v.norm();
  const Vec3 along = d == 0 ? Vec3::UnitX() : Vec3(v / d);
  return {-along, along, Vec3::Zero()};
}

MinimalMotion LinkConstraint::minimal_motion(std::span<const Vec3> p_W, std::span<const double> inverse_masses) const {
  MinimalMotion motion;
  const double w1 = inverse_masses[0], w2 = inverse_masses[1];
  if (w1 + w2 == 0) return motion;
  const Vec3 along = gradient(p_W)[1];  // v / d'
  const double excess = violation(p_W);
  motion.multiplier = excess / (w1 + w2);
  motion.d_W[0] = motion.multiplier * w1 * along;
  motion.d_W[1] = -motion.multiplier * w2 * along;
  return motion;
}

}  // namespace plumbline
