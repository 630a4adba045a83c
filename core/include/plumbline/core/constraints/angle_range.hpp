// The angle at a joint of three particles, within a range (course slide 32: "wrist-elbow-shoulder angle from 0 to 180
// degrees"; slide 35, example 4).
//
// With u = p1 - p2 and v = p3 - p2, the second particle being the joint:
//
//   in space   q = atan2(|u x v|, u . v)        in [0, pi]: pi is a stretched limb
//   in a plane q = atan2(n . (u x v), u . v)    in (-pi, pi]: from u to v about the unit axis n, with u and v projected
//                                               onto the plane across n; it knows to which side the limb bends
//
// A step of p1 across u turns u by the step divided by |u|, whence the gradients; that of the joint is minus the sum of
// the other two. The motion that restores the angle moves all three: it keeps their centre of mass and has no net
// rotation (constraint.hpp). It changes the lengths of the bones a little, in second order; the links of the list put
// them right.
//
// That it is the smallest is tested for violations up to 0.5 rad. From more than a right angle off the nearest place
// may be an arm of no length: there is no smallest motion then, and one that restores the angle is made.
#pragma once

#include <optional>

#include "plumbline/core/constraints/constraint.hpp"

namespace plumbline {

class AngleRange : public Constraint {
 public:
  // In space, 0 <= low <= high <= pi [rad]. For a limb that is exactly stretched or folded every direction across it
  // bends it equally: one of them is taken.
  AngleRange(std::size_t first, std::size_t joint, std::size_t third, double low, double high);
  // In the plane across that axis, low <= high <= low + 2 pi [rad]. The violation counts to the nearer end of the
  // range. Throws std::invalid_argument, as above, when that is not so, and for an axis of length 0.
  AngleRange(std::size_t first, std::size_t joint, std::size_t third, double low, double high, const Vec3& axis_W);

  // As defined above [rad].
  double angle(std::span<const Vec3> p_W) const;
  // The angle; in a plane counted from the middle of the range, so that too far one way is not taken for the other.
  double quantity(std::span<const Vec3> p_W) const override;
  PerParticle gradient(std::span<const Vec3> p_W) const override;

 private:
  double middle_ = 0;  // [rad]
  std::optional<Vec3> axis_W_;
};

}  // namespace plumbline
