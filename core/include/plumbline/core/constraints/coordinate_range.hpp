// A coordinate that must stay within a range (course slide 34, example 1): low <= e . p <= high.
#pragma once

#include "plumbline/core/constraints/constraint.hpp"

namespace plumbline {

// q = e . p [m] for a unit direction e in W. With high infinite it is a half-space to stay in.
class CoordinateRange : public Constraint {
 public:
  // Throws std::invalid_argument unless the direction is not zero and low <= high. The direction is made a unit vector.
  CoordinateRange(std::size_t particle, const Vec3& direction_W, double low, double high);

  double quantity(std::span<const Vec3> p_W) const override;
  PerParticle gradient(std::span<const Vec3> p_W) const override;
  // The slide's clamp, x <- low or high, along e.
  MinimalMotion minimal_motion(std::span<const Vec3> p_W, std::span<const double> inverse_masses) const override;

 private:
  Vec3 direction_W_;
};

}  // namespace plumbline
