// The law of rotation, and what it becomes about a fixed axis or point (course slides 4, 6, 14).
//
//   M = dL/dt = I alpha + w x (I w)       L = I w       about the centre of mass, or about a point that is fixed in W
//
// Slide 6 writes M = I alpha and calls I "angular momentum". I is the moment of inertia, a tensor that turns with the
// body, and its turning adds w x (I w); without it the angular momentum of a free box that tumbles would turn in space.
// The slide's form holds where w x (I w) = 0: spheres, spin about a principal axis, and bodies on a fixed axis, for the
// part along it. Source: Goldstein, sections 5.5-5.6. All quantities in one frame: W for a torque in W, or body axes.
#pragma once

#include "plumbline/core/mass/mass_properties.hpp"

namespace plumbline {

// alpha = I^-1 (M - w x (I w)) [rad/s^2]. `inverse_inertia` comes from the caller, who has it: 0 for an axis about
// which the body does not turn.
Vec3 angular_acceleration(const Mat3& inertia, const Mat3& inverse_inertia, const Vec3& w, const Vec3& torque);

// The same with the inverse taken here. Throws std::invalid_argument when the tensor has none.
Vec3 angular_acceleration(const Mat3& inertia, const Vec3& w, const Vec3& torque);

// The reverse: the torque [N m] that makes a body with w [rad/s] accelerate by alpha [rad/s^2].
Vec3 torque_for(const Mat3& inertia, const Vec3& w, const Vec3& alpha);

// A body that can only turn about the line through `point` along the unit vector `axis`, with torque about that line:
// alpha = M/I, I = axis . I_point axis. Throws std::invalid_argument unless the axis is unit and I > 0.
double moment_about_axis(const MassProperties& body, const Vec3& point, const Vec3& axis);
double acceleration_about_axis(const MassProperties& body, const Vec3& point, const Vec3& axis, double torque);

// A body that turns freely about the fixed `pivot`, with gravity g [m/s^2] on its centre of mass: the law above about
// the pivot, with M = (com - pivot) x m g. All in one frame. Throws std::invalid_argument for a pivot about which an
// inertia is 0 (a thin rod turns about itself without any).
Vec3 pivot_acceleration(const MassProperties& body, const Vec3& pivot, const Vec3& w, const Vec3& g);

// Physical pendulum: rate of small swings [rad/s] about a horizontal axis, w0^2 = m g d/I, d the distance of the centre
// of mass from the axis; theta'' = -w0^2 sin(theta) for large ones (exact/planar_pendulum.hpp). g > 0 [m/s^2].
double pendulum_rate(const MassProperties& body, const Vec3& point, const Vec3& axis, double g);

}  // namespace plumbline
