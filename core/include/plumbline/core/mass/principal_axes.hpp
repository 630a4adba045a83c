// Principal axes: the attitude in which an inertia tensor is diagonal, and the Body that is made of it.
//
//   I = R_FB diag(moments) R_FB^T     (Goldstein, section 5.4)
//
// A Body (body.hpp) has its frame in the centre of mass along its principal axes. Mass properties in any frame F become
// one by this turn; the Body's shape is then given in axes that are turned with it.
#pragma once

#include "plumbline/core/mass/mass_properties.hpp"

namespace plumbline {

struct PrincipalAxes {
  Vec3 moments = Vec3::Zero();   // [kg m^2]
  Quat q_FB = Quat::Identity();  // columns of its matrix: the principal axes in F, right-handed
};

// Each principal axis is paired with the axis of F that it lies closest to, so that a tensor that is diagonal already
// comes back as it is, with the identity. Equal moments: any axes in their plane are principal, and one choice is
// returned. The tensor must be symmetric; throws std::invalid_argument as require_physical does.
PrincipalAxes principal_axes(const Mat3& inertia);

// Makes `body` have these properties, known in frame F at attitude q_WF with origin p_WF [m]: fills mass, inertia and
// the pose in body.initial; name, shape and velocities stay. With the diagonal tensor of a solid its axes are F's own.
void give_mass(Body& body, const MassProperties& properties, const Quat& q_WF, const Vec3& p_WF);

}  // namespace plumbline
