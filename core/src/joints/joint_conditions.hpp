// The three conditions that all joints are made of, each with its row of J and its bias Jdot v.
//
// u fixed to A and s fixed to B turn as u' = w_A x u, s' = w_B x s; an anchor moves with v + w x r and, when its body
// has no acceleration, accelerates by w x (w x r).
#pragma once

#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {

// Acceleration of the gap when neither body accelerates.
inline Vec3 gap_bias(const PlacedJoint& j) { return j.w_B.cross(j.w_B.cross(j.r_B)) - j.w_A.cross(j.w_A.cross(j.r_A)); }

// C = e . gap along a direction e of the world.
inline JointRow no_gap_along(const PlacedJoint& j, const Vec3& e) {
  return {j.a, j.b, e.dot(j.gap), e, -j.r_A.cross(e), j.r_B.cross(e), e.dot(gap_bias(j))};
}

// C = u . gap along a direction u of A. The force acts where B's anchor is: that is the arm r_A + gap on A.
inline JointRow travel_along(const PlacedJoint& j, const Vec3& u) {
  const Vec3 u_rate = j.w_A.cross(u);
  const double bias = u.dot(gap_bias(j)) + 2 * u_rate.dot(j.gap_rate) + j.w_A.cross(u_rate).dot(j.gap);
  return {j.a, j.b, u.dot(j.gap), u, -(j.r_A + j.gap).cross(u), j.r_B.cross(u), bias};
}

// C = u . s: a direction u of A stays at right angles to a direction s of B. dC/dt = (w_B - w_A) . (s x u).
inline JointRow right_angle(const PlacedJoint& j, const Vec3& u, const Vec3& s) {
  const Vec3 axis = s.cross(u);
  const Vec3 axis_rate = j.w_B.cross(s).cross(u) + s.cross(j.w_A.cross(u));
  return {j.a, j.b, u.dot(s), Vec3::Zero(), -axis, axis, (j.w_B - j.w_A).dot(axis_rate)};
}

}  // namespace plumbline
