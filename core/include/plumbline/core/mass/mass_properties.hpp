// Mass, centre of mass and inertia tensor of a part, and how parts add up (course slide 7, step 1: body properties).
//
//   moved by R, p       com -> R com + p     I -> R I R^T
//   about a point q     I_q = I + m (|r|^2 1 - r r^T),  r = com - q             (parallel axes: Huygens, Steiner)
//   a sum of parts      m = sum m_k,  com = sum m_k com_k / m,  I = sum of every I_k about the common com
//
// Source: Goldstein, Classical Mechanics, section 5.3. A hole is a part with negative mass. Sums are exact up to
// rounding, whatever the attitudes; what is left must be a physical body again, and `require_physical` checks that.
#pragma once

#include <span>

#include "plumbline/core/body.hpp"

namespace plumbline {

// Expressed in the frame of the part. The inertia is about the centre of mass, never about the origin.
struct MassProperties {
  double mass = 0;                  // [kg]
  Vec3 com = Vec3::Zero();          // centre of mass [m]
  Mat3 inertia_com = Mat3::Zero();  // tensor about com: diagonal moments, minus the products outside it [kg m^2]
};

// The same part seen from a frame A in which its own frame F has attitude q_AF and origin p_AF [m].
MassProperties placed(const MassProperties& part, const Quat& q_AF, const Vec3& p_AF);

// All parts as one body, all given in the same frame. Throws std::invalid_argument when the sum is not physical.
MassProperties compound(std::span<const MassProperties> parts);

// The part as a hole: mass and inertia negative. Only for compound().
MassProperties hole(const MassProperties& part);

// Inertia tensor [kg m^2] about the point q instead of the centre of mass.
Mat3 inertia_about(const MassProperties& part, const Vec3& q);

// Throws std::invalid_argument unless the mass is > 0, the tensor symmetric, and its principal moments >= 0 with none
// larger than the sum of the others: I1 + I2 - I3 = 2 int x3^2 dm, which no distribution of mass makes negative.
void require_physical(const MassProperties& part);

}  // namespace plumbline
