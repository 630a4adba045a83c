// When do they meet? Times of impact from the equations of motion (course slide 16).
//
// Every function returns the first time t >= 0 [s] at which the gap closes while the two approach each other, or
// nothing. Bodies that already touch or overlap and approach meet at 0; those that touch and part do not, unless the
// motion brings them back. NaN never meets anything.
#pragma once

#include <optional>

#include "plumbline/core/state.hpp"

namespace plumbline {

// A body on its way: p(t) = p + v t + a t^2/2, q(t) = exp(w t) q. With a = 0 it is the linear motion of the slide.
struct Motion {
  BodyState start;
  Vec3 a_W = Vec3::Zero();  // acceleration of the centre of mass [m/s^2]
};

// The points x with normal_W . x = offset; the free side is the one the unit normal points to.
struct Plane {
  Vec3 normal_W;
  double offset;  // [m]
};

// The centre of mass as a point. With gap g, speed u and acceleration c along the normal: g + u t + c t^2/2 = 0, of
// whose roots the approaching one has the slope -sqrt(u^2 - 2 c g); written so that nothing cancels.
std::optional<double> point_meets_plane(const Motion& point, const Plane& plane);

// The same for the lowest point of a sphere of that radius [m].
std::optional<double> sphere_meets_plane(const Motion& sphere, double radius, const Plane& plane);

// Distance of the centres equal to the sum R of the radii [m]. With the relative position d and velocity v:
// |d + v t| = R, t = (d^2 - R^2) / (-d.v + sqrt(R^2 v^2 - |d x v|^2)); the radicand in this form keeps its digits
// for grazing spheres. If the spheres accelerate relative to each other there is no simple formula: then the time
// is found by advancing (below), up to `horizon` [s].
std::optional<double> sphere_meets_sphere(const Motion& a, double radius_a, const Motion& b, double radius_b,
                                          double horizon);

// The point fixed to a turning body at r_B from its centre of mass (body axes) [m], within [0, horizon] [s].
//
// Conservative advancement of second order: the height f of the point has |f''| <= M = |a_n| + w^2 |r_perp|, so that
// f(t + s) >= f + f' s - M s^2/2, and stepping to the root of that bound never steps over an impact. It converges
// quadratically and stops when f <= tolerance [m].
std::optional<double> corner_meets_plane(const Motion& body, const Vec3& r_B, const Plane& plane, double tolerance,
                                         double horizon);

// The first of the eight corners of a box of that size [m] (full edge lengths), to 1e-13 of its diagonal.
std::optional<double> box_meets_plane(const Motion& box, const Vec3& size, const Plane& plane, double horizon);

// Corner `index` (0..7) of a box of that size, in body axes [m]: bit k of the index chooses the side along axis k.
Vec3 box_corner(const Vec3& size, int index);

// How far above the root the search for a corner of a body of that size [m] may stop, relative to the size: a few
// hundred roundings, which is what evaluating a height costs.
inline constexpr double kImpactTolerance = 1e-13;

}  // namespace plumbline
