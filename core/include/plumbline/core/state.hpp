// What is known of a body at one instant, and what may act on it during one step.
#pragma once

#include "plumbline/core/spatial.hpp"

namespace plumbline {

// State of body B's centre of mass frame in the world frame W.
struct BodyState {
  Vec3 p_WB = Vec3::Zero();      // position of the centre of mass [m]
  Quat q_WB = Quat::Identity();  // attitude: x_W = q_WB * x_B, unit
  Vec3 v_WB = Vec3::Zero();      // velocity of the centre of mass [m/s]
  Vec3 w_WB = Vec3::Zero();      // angular velocity, expressed in W [rad/s]
};
static_assert(sizeof(BodyState) == 13 * sizeof(double), "a trajectory is one plain block of doubles");

// Force and torque on one body, held constant over one step.
struct Wrench {
  Vec3 f_W = Vec3::Zero();    // force on the centre of mass, in W [N]
  Vec3 tau_W = Vec3::Zero();  // torque about the centre of mass, in W [N m]
};

// True when all 13 numbers are finite.
bool is_finite(const BodyState& state);

}  // namespace plumbline
