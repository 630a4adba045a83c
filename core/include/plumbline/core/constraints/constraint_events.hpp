// When does a flying particle meet a constraint? The times that the zero-tolerance policy needs (course slide 33).
//
// Free flight p(t) = p + v t + a t^2/2 with constant acceleration. The squared distance from a centre c is a quartic in
// t,
//
//   |r + v t + a t^2/2|^2 - R^2 = (r^2 - R^2) + 2 r.v t + (v^2 + r.a) t^2 + v.a t^3 + a^2/4 t^4,    r = p - c,
//
// and a string that goes taut, a ball inside a sphere or a particle that hits a spherical obstacle are its zeros.
// Planes are in collision/time_of_impact.hpp (point_meets_plane).
//
// The time [s] is exact to rounding of R^2 divided by the slope of the quartic: 1e-15 or so unless the particle grazes
// the sphere. Nothing when they never meet, and for NaN.
#pragma once

#include <array>
#include <optional>

#include "plumbline/core/spatial.hpp"

namespace plumbline {

struct Flight {
  Vec3 p_W = Vec3::Zero();  // [m]
  Vec3 v_W = Vec3::Zero();  // [m/s]
  Vec3 a_W = Vec3::Zero();  // [m/s^2]
};

// The flight after t [s].
Flight after(const Flight& flight, double t);

// The coefficients of that quartic, constant first.
std::array<double, 5> distance_quartic(const Flight& flight, const Vec3& centre_W, double radius);

// The first t > 0 at which the particle comes into the sphere from outside.
std::optional<double> flight_enters_sphere(const Flight& flight, const Vec3& centre_W, double radius);
// The first t > 0 at which it leaves the sphere from inside: a string from the centre goes taut.
std::optional<double> flight_leaves_sphere(const Flight& flight, const Vec3& centre_W, double radius);

// Velocity after meeting a surface of unit normal n (towards the free side) with restitution e: the approaching part of
// v along n is turned round and multiplied by e (slide 22); a parting velocity stays.
Vec3 rebound(const Vec3& v_W, const Vec3& normal_W, double restitution);

}  // namespace plumbline
