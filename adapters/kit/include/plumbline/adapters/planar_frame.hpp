// The x-z plane of a scenario as the x-y plane of a planar engine.
//
// The engine's (x, y) are the scenario's (x, z). A positive rotation about +y turns z towards x; a positive one in the
// engine turns its x towards its y, that is x towards z: angle = -(angle about +y), and likewise for angular velocity
// and torque.
#pragma once

#include "plumbline/core/body.hpp"

namespace plumbline {

// What is left of a state in the plane: what a planar engine knows of a body.
struct PlanarState {
  double x = 0, z = 0;    // [m]
  double angle = 0;       // counted as the engine does [rad]
  double vx = 0, vz = 0;  // [m/s]
  double w = 0;           // counted as the engine does [rad/s]
};

// Rotation out of the plane is dropped: the angle is that of the twist of q_WB about y.
PlanarState in_plane(const BodyState& state);
// Nothing moves along y, nor turns out of the plane.
BodyState in_space(const PlanarState& state);
// The same for a body that stood beside the plane, or was turned before it began to turn in it: a cylinder whose axis
// is y, a ball that lies anyhow. What the plane does not know of it stays as it was.
BodyState in_space(const PlanarState& state, const BodyState& initial);
// Moment of inertia about the y axis of W [kg m^2], which no motion in the plane changes.
double planar_inertia(const Body& body);
// The engine's torque [N m] of a torque in W; of none +0, which is what nobody's torque is in an engine.
inline double planar_torque(const Vec3& tau_W) { return 0.0 - tau_W.y(); }

}  // namespace plumbline
