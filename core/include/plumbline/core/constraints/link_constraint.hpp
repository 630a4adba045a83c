// Two particles at a fixed distance, or at one within a range: the bone of an articulated body (course slides 32, 34).
//
// With v = p2 - p1 and d' = |v|, slide 34 corrects both ends by gamma v, gamma = (d' - d)/(2 d'). Its signs, p1 - gamma
// v and p2 + gamma v, push ends apart that are already too far from each other: the new distance is d' + 2 gamma d' =
// 2 d' - d, and the violation doubles. The ends must come together when d' > d:
//
//   p1 <- p1 + gamma v,    p2 <- p2 - gamma v.
//
// For unequal masses the halves become the shares w1/(w1 + w2) and w2/(w1 + w2) of the inverse masses.
#pragma once

#include "plumbline/core/constraints/constraint.hpp"

namespace plumbline {

// q = |p2 - p1| [m]; gradient -v/d' at the first, v/d' at the second particle. When both are in the same place there is
// no direction: the x axis is taken.
class LinkConstraint : public Constraint {
 public:
  // A rod: the distance is `length` > 0 [m].
  LinkConstraint(std::size_t first, std::size_t second, double length);
  // A string is (0, length); a minimum distance (length, infinity).
  // Throws std::invalid_argument unless 0 <= shortest <= longest and longest > 0.
  LinkConstraint(std::size_t first, std::size_t second, double shortest, double longest);

  double shortest() const { return low(); }
  double longest() const { return high(); }

  double quantity(std::span<const Vec3> p_W) const override;
  PerParticle gradient(std::span<const Vec3> p_W) const override;
  // Slide 34 with its signs put right. The multiplier is C/(w1 + w2).
  MinimalMotion minimal_motion(std::span<const Vec3> p_W, std::span<const double> inverse_masses) const override;
};

}  // namespace plumbline
