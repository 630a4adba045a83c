#include "bullet_knobs.hpp"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include "bullet_conversions.hpp"

namespace plumbline {
namespace {

btScalar pair_restitution(const btCollisionObject* a, const btCollisionObject*) { return a->getRestitution(); }
btScalar pair_friction(const btCollisionObject* a, const btCollisionObject*) { return a->getFriction(); }

}  // namespace

void take_material_of_the_pair() {
  gCalculateCombinedRestitutionCallback = pair_restitution;
  gCalculateCombinedFrictionCallback = pair_friction;
}

KnobTable<BulletRigidKnobs> bullet_rigid_knob_table() {
  using K = BulletRigidKnobs;
  KnobTable<K> table;
  table
      .add(&K::sleeping, "sleeping", true, false, "",
           "stops bodies that have been slow for 2 s; a force on a sleeping body is lost")
      .add(&K::sleeping_linear_speed, "sleeping_linear_speed", 0.8, 0.8, "m/s", "slower than this counts as slow")
      .add(&K::sleeping_angular_speed, "sleeping_angular_speed", 1.0, 1.0, "rad/s", "slower than this counts as slow")
      .add(&K::linear_damping, "linear_damping", 0.0, 0.0, "1", "share of the velocity lost per second")
      .add(&K::angular_damping, "angular_damping", 0.0, 0.0, "1", "share of the angular velocity lost per second")
      .choose(&K::gyroscopic, "gyroscopic",
              {{"none", 0},
               {"explicit", int{BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT}},
               {"implicit_body", int{BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY}},
               {"implicit_world", int{BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD}}},
              "implicit_body", "implicit_body", "how w x I w is integrated");
  add_bullet_contact_knobs(table)
      .add(&K::warm_starting, "warm_starting", true, true, "", "starts from the impulses of the step before")
      .add(&K::split_impulse, "split_impulse", true, true, "",
           "corrects penetration with velocities that are forgotten after the step")
      .add(&K::split_impulse_penetration_threshold, "split_impulse_penetration_threshold", -0.04, 0.0, "m",
           "shallower penetration is corrected by real velocity: an impact seen at depth d rebounds with e + erp2 d/(v "
           "dt) instead of e; 0: never")
      .add(&K::erp2, "erp2", 0.2, 0.2, "1", "share of the penetration that a step corrects")
      .add(&K::erp, "erp", 0.2, 0.2, "1", "share of what a joint is off that a step corrects, by real velocity")
      .add(&K::stop_erp, "stop_erp", 0.2, 0, "1",
           "share of what a limit of a joint was passed by that a step corrects, by real velocity: a stop reached at "
           "depth d throws back with stop_erp d/dt; without it the joint stays that far beyond")
      .add(&K::hinge_stop_bounce, "hinge_stop_bounce", 1, 0, "1",
           "restitution of a hinge's limits, which Bullet calls relaxation; 1 unless told otherwise")
      .add(&K::hinge_stop_bias, "hinge_stop_bias", 0.3, 1, "1",
           "factor on both, the correction and the restitution of a hinge's limits")
      .add(&K::cfm, "cfm", 0, 0, "s/kg", "softness of the constraints, contacts and joints alike");
  return table;
}

void set_bullet_contact(const BulletContactKnobs& knobs, btDefaultCollisionConfiguration& collision,
                        btContactSolverInfo& solver) {
  if (knobs.plane_contact_iterations > 1) {
    collision.setPlaneConvexMultipointIterations(knobs.plane_contact_iterations, knobs.plane_contact_iterations);
  }
  solver.m_numIterations = knobs.solver_iterations;
  solver.m_restitutionVelocityThreshold = real(knobs.restitution_threshold);
  solver.m_erp2 = real(knobs.erp2);
  solver.m_linearSlop = real(knobs.linear_slop);
}

}  // namespace plumbline
