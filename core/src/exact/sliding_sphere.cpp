#include "plumbline/core/exact/sliding_sphere.hpp"

#include <cmath>
#include <stdexcept>

namespace plumbline {

SlidingSphere::SlidingSphere(double radius, double friction, double gravity, const SphereMotion& initial)
    : radius_(radius), deceleration_(friction * gravity), initial_(initial) {
  if (!(radius > 0 && friction > 0 && gravity > 0 && std::isfinite(radius) && std::isfinite(deceleration_))) {
    throw std::invalid_argument("a sliding sphere needs radius, friction and gravity finite and > 0");
  }
  const bool finite = initial.p_WB.allFinite() && initial.v_WB.allFinite() && initial.w_WB.allFinite();
  if (!finite || initial.v_WB.z() != 0) {
    throw std::invalid_argument("a sliding sphere needs a finite motion parallel to the plane: set v_z to 0");
  }
  slip_ = initial.v_WB - radius * initial.w_WB.cross(Vec3::UnitZ());
  const double speed = slip_.norm();
  if (speed == 0) return;
  direction_ = slip_ / speed;
  rolling_time_ = 2 * speed / (7 * deceleration_);
}

SphereMotion SlidingSphere::slide(double t) const {
  const Vec3 push = -deceleration_ * direction_;
  SphereMotion motion = initial_;
  motion.p_WB += t * initial_.v_WB + 0.5 * t * t * push;
  motion.v_WB += t * push;
  motion.w_WB += 2.5 / radius_ * t * push.cross(Vec3::UnitZ());  // I dw/dt = (-r n) x m push
  return motion;
}

SphereMotion SlidingSphere::at(double t) const {
  if (!(t >= 0)) throw std::invalid_argument("friction does not run backwards: t must be >= 0");
  if (t <= rolling_time_) return slide(t);
  SphereMotion motion = slide(rolling_time_);
  motion.p_WB += (t - rolling_time_) * motion.v_WB;
  return motion;
}

}  // namespace plumbline
