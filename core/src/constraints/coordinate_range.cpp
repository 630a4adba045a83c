#include "plumbline/core/constraints/coordinate_range.hpp"

#include <stdexcept>

namespace plumbline {

CoordinateRange::CoordinateRange(std::size_t particle, const Vec3& direction_W, double low, double high)
    : Constraint({particle}), direction_W_(direction_W.normalized()), low_(low), high_(high) {
  if (!(direction_W.norm() > 0)) throw std::invalid_argument("a coordinate range needs a direction that is not zero");
  if (!(low <= high)) throw std::invalid_argument("a coordinate range needs low <= high: exchange the two");
}

double CoordinateRange::violation(std::span<const Vec3> p_W) const {
  return outside(direction_W_.dot(p_W[0]), low_, high_);
}

PerParticle CoordinateRange::gradient(std::span<const Vec3>) const {
  return {direction_W_, Vec3::Zero(), Vec3::Zero()};
}

MinimalMotion CoordinateRange::minimal_motion(std::span<const Vec3> p_W, std::span<const double> inverse_masses) const {
  MinimalMotion motion;
  if (inverse_masses[0] == 0) return motion;
  const double excess = violation(p_W);
  motion.d_W[0] = -excess * direction_W_;
  motion.multiplier = excess / inverse_masses[0];
  return motion;
}

}  // namespace plumbline
