// Smooth motion with forces that are followed within the step: what an engine cannot do that is handed them from
// outside.
//
// Here an integrator has the order that its textbook promises also where forces depend on position or velocity:
// velocity Verlet 2, Runge-Kutta 4. Beside a run with held forces it tells how much of an error is the price of holding
// them.
#pragma once

#include "plumbline/core/integration/stepper.hpp"
#include "plumbline/core/kinetics/scheme.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

// The scenario's equations of motion: m a = m g + f and I alpha = tau - w x I w, with the last term left out for
// GyroscopicTerm::kNone. Bodies that are fixed, and axes whose moment of inertia is 0, have no acceleration. The
// scenario is copied. Where joints hold the bodies their forces are part of it, with the explicit gyroscopic term.
AccelerationField acceleration_field(const Scenario& scenario, GyroscopicTerm gyroscopic = GyroscopicTerm::kExplicit);

// The integrator of a scheme behind the interface that all integrators share.
std::unique_ptr<Stepper> make_stepper(Integrator integrator);

// A whole run, initial state included: scenario.step_count(dt) steps. Throws std::invalid_argument where
// require_possible() does, and for a body without mass.
Trajectory follow_forces(const Scenario& scenario, const Scheme& scheme, double dt);

}  // namespace plumbline
