// Numerical schemes: how one step of dt turns forces into motion.
//
// Forces and torques are evaluated once, at the start of the step, and held over it: so does every engine. With the
// held acceleration a, a step of dt takes (x, v) to
//
//   explicit Euler        x + v dt              v + a dt     (course slide 30)
//   semi-implicit Euler   x + (v + a dt) dt     v + a dt     (the velocity first: what most engines do)
//   velocity Verlet       x + v dt + a dt^2/2   v + a dt     (exact as long as a really is constant)
//
// About an exact parabola the two Euler schemes are off by a t dt/2, explicit on one side and semi-implicit on the
// other. Rotation goes the same way: the angular acceleration alpha = I^-1 (tau - w x I w) is taken at the start of
// the step, gyroscopic term included, and the attitude moves on the group, q <- exp(w dt) q, with the w that plays
// the part of the velocity above: the old one, the new one, or for Verlet their mean.
#pragma once

#include <span>
#include <string>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

enum class Integrator { kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet };

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
  bool operator==(const Scheme&) const = default;
};

// "semi-implicit Euler, impacts at their exact time".
std::string name(const Scheme& scheme);
// The same for one scenario: without the impact rule where bodies never touch, since there all rules agree.
std::string name(const Scheme& scheme, const Scenario& scenario);

// The schemes that are worth comparing an engine with, all different.
std::span<const Scheme> candidate_schemes();
// Those of them that differ on that scenario: one per integrator where bodies never touch.
std::span<const Scheme> candidate_schemes(const Scenario& scenario);

}  // namespace plumbline
