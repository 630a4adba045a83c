// Numerical schemes: how one step of dt turns forces into motion.
//
// A scheme is a plain value that names itself. It is put together from five choices:
//
// 1. The integrator (course slides 26-30 and 39-41). With the acceleration a, a step of h takes (x, v) to
//
//      explicit Euler        x + v h              v + a h     (slide 30: the old velocity moves the body)
//      semi-implicit Euler   x + (v + a h) h      v + a h     (the velocity first: what most engines do)
//      velocity Verlet       x + v h + a h^2/2    v + a h     (exact as long as a really is constant)
//
//    About an exact parabola the two Euler schemes are off by a t h/2, explicit on one side and semi-implicit on the
//    other. Rotation goes the same way, and the attitude moves on the group, q <- exp(w h) q, with the w that plays the
//    part of the velocity above: the old one, the new one, or for Verlet their mean.
// 2. The gyroscopic term: kinetics/gyroscopic.hpp.
// 3. The forces: held over the step, as an engine must that is handed them from outside, or followed within it.
//    Position Verlet, Runge-Kutta and Dormand-Prince need forces that they can follow, and velocity Verlet is of second
//    order only then: kinetics/force_following.hpp.
// 4. The impact rule: when bodies that meet get their impulse.
// 5. Substeps: a step of dt is gone through as n steps of dt/n under the same held forces.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/kinetics/gyroscopic.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

enum class Integrator {
  kSemiImplicitEuler,
  kExplicitEuler,
  kVelocityVerlet,
  kPositionVerlet,
  kRungeKutta4,
  kDormandPrince8
};

// "semi-implicit Euler": the name it also has in the table of all integrators, integration/stepper_table.hpp.
std::string_view name(Integrator integrator);

// Where a step takes its forces from.
enum class ForceSampling {
  // Evaluated once, at the start of the step: so does every engine that is handed its forces.
  kHeld,
  // Evaluated wherever the integrator asks, within the step and at its end. For bodies that never touch.
  kFollowed,
};

// What happens in a step in which bodies meet.
enum class ImpactRule {
  // The step is cut at the exact time of each impact, and what is left of it is gone through with the new velocities.
  kExactTime,
  // Bodies that touch or overlap at the start of the step get their impulse there, after the forces have changed the
  // velocities, and then move through the whole step. An impact inside a step is noticed at the next one.
  kStepStart,
  // The same, but the rebound is counted from the speed before the forces acted.
  kStepStartBeforeForces,
};

struct Scheme {
  Integrator integrator = Integrator::kSemiImplicitEuler;
  ImpactRule impact = ImpactRule::kExactTime;
  GyroscopicTerm gyroscopic = GyroscopicTerm::kExplicit;
  ForceSampling forces = ForceSampling::kHeld;
  int substeps = 1;
  bool operator==(const Scheme&) const = default;
};

// All of it: "semi-implicit Euler, explicit gyroscopic term, impacts at their exact time"; forces and substeps are
// named where they are not held and 1.
std::string name(const Scheme& scheme);
// The same for one scenario, without the choices that make no difference there: the impact rule where bodies never
// touch, the gyroscopic term where no body that moves has unequal moments.
std::string name(const Scheme& scheme, const Scenario& scenario);

// Throws std::invalid_argument when the choices cannot go together on that scenario, with the way out: forces that are
// followed and exact free rotation know no impacts, and some integrators must follow the forces.
void require_possible(const Scheme& scheme, const Scenario& scenario);

// The schemes that are worth comparing an engine with on that scenario: what an engine can do, all different there.
std::vector<Scheme> candidate_schemes(const Scenario& scenario);

}  // namespace plumbline
