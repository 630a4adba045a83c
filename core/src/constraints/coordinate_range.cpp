#include "plumbline/core/constraints/coordinate_range.hpp"

#include <stdexcept>

namespace plumbline {

CoordinateRange::CoordinateRange(std::size_t particle, const Vec3& direction_W, double low, double high)
    : Constraint({particle}, low, high), direction_W_(direction_W.normalized()) {
  if (!(direction_W.norm() > 0)) throw std::invalid_argument("a coordinate range needs a direction that is not zero");
}

double CoordinateRange::quantity(std::span<const Vec3> p_W) const { return direction_W_.dot(p_W[0]); }

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
