// The linear equations that sweeps converge to, once it is known which points push, grip and slide.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/response/impulse.hpp"

namespace plumbline {

// A point of contact in the middle of the search.
struct PointImpulse {
  // Effective masses [kg]: what an impulse must be multiplied from to change the point's velocity by 1 m/s.
  double normal_mass, tangent_mass;
  double normal = 0;            // [N s]
  Vec3 tangent = Vec3::Zero();  // [N s]
};

// Velocity of a body's point at the arm r per unit impulse at the arm s of the same body: 1/m - [r] I^-1 [s].
Mat3 point_mobility(const Inertness& body, const Vec3& r, const Vec3& s);

// One Newton step on the equations of the points that push at present, for all of them at once:
//   v_n = rebound_speed;   v_t = 0 where the point grips;   J_t = mu J_n q/|q| with q = J_t - m v_t where it slides,
// the last being Coulomb's law as a sweep applies it, m the tangent mass. `states` hold the velocities under the
// present impulses. Points that do not push are left alone; an impulse may come out negative, and the next sweep tells.
// Of the many ways to share a load among more points than needed, the one nearest to the present impulses is taken.
void solve_pushing_points(std::span<const ImpactPoint> points, std::span<const Inertness> inertness,
                          std::span<const BodyState> states, std::span<PointImpulse> impulses);

}  // namespace plumbline
