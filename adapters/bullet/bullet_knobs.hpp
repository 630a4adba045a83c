// The knobs of Bullet, each written once: those of its contact solver, which both kinds of world have, and those of
// rigid bodies.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "plumbline/adapters/knob_table.hpp"

namespace plumbline {

struct BulletSolverKnobs {
  int solver_iterations;
  bool warm_starting;
  double restitution_threshold;
  bool split_impulse;
  double split_impulse_penetration_threshold, erp2, linear_slop, contact_processing_threshold;
  int plane_contact_iterations;
};

struct BulletRigidKnobs : BulletSolverKnobs {
  bool sleeping;
  double sleeping_linear_speed, sleeping_angular_speed, linear_damping, angular_damping;
  int gyroscopic;
  double erp, cfm;
};

KnobTable<BulletRigidKnobs> bullet_rigid_knob_table();

// Bullet's own default for "never": BT_LARGE_FLOAT, the same in both precisions.
inline constexpr double kBulletNever = 1e18;

template <typename Knobs>
KnobTable<Knobs>& add_bullet_solver_knobs(KnobTable<Knobs>& table) {
  using K = Knobs;
  return table
      .add(
          &K::solver_iterations, "solver_iterations", 10, 50, "",
          "sweeps of projected Gauss-Seidel over contacts and joints in a step; more, so that the contacts of one body "
          "agree")
      .add(&K::warm_starting, "warm_starting", true, true, "", "starts from the impulses of the step before")
      .add(&K::restitution_threshold, "restitution_threshold", 0.2, 0.0, "m/s",
           "slower impacts have e = 0; the scenario states no such threshold")
      .add(&K::split_impulse, "split_impulse", true, true, "",
           "corrects penetration with velocities that are forgotten after the step")
      .add(&K::split_impulse_penetration_threshold, "split_impulse_penetration_threshold", -0.04, 0.0, "m",
           "shallower penetration is corrected by real velocity: an impact seen at depth d rebounds with e + erp2 d/(v "
           "dt) instead of e; 0: never")
      .add(&K::erp2, "erp2", 0.2, 0.2, "1", "share of the penetration that a step corrects")
      .add(&K::linear_slop, "linear_slop", 0.0, 0.0, "m", "penetration that is left alone")
      .add(&K::contact_processing_threshold, "contact_processing_threshold", kBulletNever, 0.0, "m",
           "contacts farther apart are ignored; above 0 bodies are braked before they touch and do not rebound")
      .add(&K::plane_contact_iterations, "plane_contact_iterations", 1, 4, "",
           "support points sought per step between a box and a plane; with one a box that lands flat tumbles");
}

void set_bullet_solver(const BulletSolverKnobs& knobs, btDefaultCollisionConfiguration& collision,
                       btContactSolverInfo& solver);

}  // namespace plumbline
