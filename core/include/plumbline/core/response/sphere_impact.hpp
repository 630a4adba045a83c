// Two spheres collide: the impulse in closed form (course slides 19-23, with the torque impulse that slide 23 leaves
// to the reader).
//
// n is the unit normal from the second sphere to the first, r the radii, and v the velocity of the first sphere's
// point of contact relative to the second's, spin included:
//
//   v = (v1 - r1 w1 x n) - (v2 + r2 w2 x n),   v_n = n . v,   v_t = v - v_n n.
//
// Along n the spins play no part, and slide 23's formula holds with the reduced mass m_r = m1 m2 / (m1 + m2), but only
// while the spheres approach, v_n < 0:
//
//   J_n = -(1 + e) m_r v_n.
//
// Across n the point of contact answers an impulse with the mobility k = 1/m1 + 1/m2 + r1^2/I1 + r2^2/I2. Either it
// grips, and the impulse stops it, or that would ask for more than friction gives, and it slips all through:
//
//   grip   |v_t|/k <= mu J_n :  J_t = -v_t/k
//   slip   otherwise         :  J_t = -mu J_n v_t/|v_t|
//
// For homogeneous spheres, I = 2/5 m r^2, k = (7/2)/m_r: they grip iff (2/7)|v_t| <= mu (1 + e)|v_n|, and then
// J_t = -(2/7) m_r v_t, whatever their sizes. One direction of slip all through is exact, since for spheres the impulse
// across n is parallel to v_t and never turns it (W. Goldsmith, Impact, Arnold 1960, ch. 2; W. J. Stronge, Impact
// Mechanics, Cambridge 2000, ch. 4).
//
// Valid for rigid spheres that touch in one point, Newton's restitution and Coulomb's friction with one coefficient.
// No tangential restitution: a gripping point stops dead, it does not spring back as a rubber ball does.
#pragma once

#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct ImpactSphere {
  double radius = 0;  // [m]
  double mass = 0;    // [kg]
  double moment = 0;  // of inertia about any axis through the centre [kg m^2]: 2/5 m r^2 when homogeneous
  BodyState state;
};

struct SphereImpact {
  enum class Regime {
    kParting,  // they do not approach: no impulse
    kGrip,     // the point of contact does not slide afterwards
    kSlip,
  };
  Regime regime = Regime::kParting;
  Vec3 impulse_W = Vec3::Zero();  // on the first sphere, its opposite on the second [N s]
  // Kinetic energy that becomes heat, along the normal and across it [J]:
  //   (1 - e^2)/2 m_r v_n^2   and   |J_t| |v_t| - k |J_t|^2 / 2.
  double lost_along = 0, lost_across = 0;
};

// Changes the velocities of two spheres at the moment at which they touch. The normal is the line of centres, so that
// there is no sign to get wrong; the two may be exchanged. Throws std::invalid_argument for a radius, mass or moment
// that is not > 0, spheres with the same centre, e outside [0, 1] or mu < 0.
SphereImpact collide_spheres(ImpactSphere& first, ImpactSphere& second, const ContactMaterial& material);

// The same against a plane that never moves, with the unit normal that points to the sphere's side of it:
// m_r = m, k = 1/m + r^2/I.
SphereImpact bounce_sphere(ImpactSphere& sphere, const Vec3& normal_W, const ContactMaterial& material);

}  // namespace plumbline
