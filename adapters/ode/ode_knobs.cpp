#include "ode_knobs.hpp"

#include <ode/ode.h>

namespace plumbline {

KnobTable<OdeKnobs> ode_knob_table(OdeSolver solver) {
  using K = OdeKnobs;
  KnobTable<K> table;
  table
      .add(&K::erp, "erp", 0.2, 0.2, "1",
           "share of the error that a step corrects, by real velocity: of penetration and of what a joint holds")
      .add(&K::cfm, "cfm", 1e-10, 1e-10, "s/kg", "softness of the constraints, contacts and joints alike")
      .add(&K::stop_erp, "stop_erp", 0.2, 0, "1",
           "share of what a limit of a joint was passed by that a step corrects, by real velocity: a stop reached at "
           "depth d throws back with stop_erp d/dt; without it the joint stays that far beyond")
      .add(&K::max_correcting_velocity, "max_correcting_velocity", dInfinity, dInfinity, "m/s",
           "separating velocity that the correction of a contact may cause")
      .add(&K::correct_within_gravity_step, "correct_within_gravity_step", false, true, "",
           "also limits that velocity to |g| dt, which gravity takes back within one step; without it e = 0 rebounds "
           "with up to erp times the approach speed")
      .add(&K::surface_layer, "surface_layer", 0, 0, "m", "penetration that is left alone")
      .add(&K::bounce_threshold, "bounce_threshold", 0, 0, "m/s", "slower rebounds have e = 0")
      .choose(&K::friction, "friction_model",
              {{"force_limit", OdeFriction::kForceLimit},
               {"pyramid", OdeFriction::kPyramid},
               {"aligned_pyramid", OdeFriction::kAlignedPyramid}},
              "force_limit", "aligned_pyramid",
              "force_limit: mu is a force in newtons, ODE's meaning unless told otherwise; pyramid: Coulomb's mu along "
              "two fixed axes; aligned_pyramid: the first axis is the direction of sliding, which is Coulomb's cone")
      .add(&K::auto_disable, "auto_disable", false, false, "", "stops bodies that have been slow for a while")
      .add(&K::linear_damping, "linear_damping", 0, 0, "1", "share of the velocity lost per step")
      .add(&K::angular_damping, "angular_damping", 0, 0, "1", "share of the angular velocity lost per step")
      .add(&K::gyroscopic, "gyroscopic", true, true, "", "integrates w x I w");
  if (solver == OdeSolver::kQuickStep) {
    table
        .add(&K::iterations, "quickstep_iterations", 20, 100, "",
             "sweeps over the constraints in a step; more, so that the contacts of one body agree")
        .add(&K::over_relaxation, "quickstep_over_relaxation", 1.3, 1.3, "1", "factor on the correction of each sweep");
  }
  return table;
}

}  // namespace plumbline
