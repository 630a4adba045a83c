// The knobs of Bullet, each written once: those of its contacts, which both kinds of world have, and those of rigid
// bodies.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "bullet_joints.hpp"
#include "plumbline/adapters/knob_table.hpp"

namespace plumbline {

struct BulletContactKnobs {
  int solver_iterations;
  double restitution_threshold, erp2, linear_slop, contact_processing_threshold;
  int plane_contact_iterations;
};

struct BulletRigidKnobs : BulletContactKnobs, BulletStops {
  bool sleeping;
  double sleeping_linear_speed, sleeping_angular_speed, linear_damping, angular_damping;
  int gyroscopic;
  bool warm_starting, split_impulse;
  double split_impulse_penetration_threshold, erp, cfm;
};

KnobTable<BulletRigidKnobs> bullet_rigid_knob_table();

// Large enough for "never" in both precisions; so is Bullet's own BT_LARGE_FLOAT.
inline constexpr double kBulletNever = 1e18;

// All but erp2, whose meaning differs.
template <typename Knobs>
KnobTable<Knobs>& add_bullet_contact_knobs(KnobTable<Knobs>& table) {
  using K = Knobs;
  return table
      .add(
          &K::solver_iterations, "solver_iterations", 10, 50, "",
          "sweeps of projected Gauss-Seidel over contacts and joints in a step; more, so that the contacts of one body "
          "agree")
      .add(&K::restitution_threshold, "restitution_threshold", 0.2, 0.0, "m/s",
           "slower impacts have e = 0; the scenario states no such threshold")
      .add(&K::linear_slop, "linear_slop", 0.0, 0.0, "m", "penetration that is left alone")
      .add(&K::contact_processing_threshold, "contact_processing_threshold", kBulletNever, 0.0, "m",
           "contacts farther apart are ignored; above 0 bodies are braked before they touch and do not rebound")
      .add(&K::plane_contact_iterations, "plane_contact_iterations", 1, 4, "",
           "support points sought per step between a box and a plane; with one a box that lands flat tumbles");
}

// Every body carries the coefficients of the pair, so the pair's value is that of either of them; Bullet itself would
// multiply the two. Holds for the whole process.
void take_material_of_the_pair();

// Hands them on, erp2 too.
void set_bullet_contact(const BulletContactKnobs& knobs, btDefaultCollisionConfiguration& collision,
                        btContactSolverInfo& solver);

}  // namespace plumbline
