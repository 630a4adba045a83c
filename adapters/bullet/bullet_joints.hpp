// A scenario's joint as one of Bullet's constraints between rigid bodies.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

// How limits of joints stop; what each does is told beside the knobs.
struct BulletStops {
  double stop_erp, hinge_stop_bias, hinge_stop_bounce;
};

// `a` is Bullet's own fixed body for a joint to the world.
std::unique_ptr<btTypedConstraint> bullet_joint(const Joint& joint, btRigidBody& a, btRigidBody& b,
                                                const BulletStops& stops);

}  // namespace plumbline
