// The second opinions, one function each. Each appends its rows, or says in `left_out` why it has none.
#pragma once

#include <optional>

#include "claim.hpp"
#include "plumbline/core/integration/stepper.hpp"
#include "plumbline/core/trajectory.hpp"
#include "plumbline/harness/certification.hpp"

namespace plumbline {

// Nothing touches and no joint has a limit: positions and velocities have no jumps or kinks but those of the forces.
bool is_smooth(const Scenario& scenario);

// motion.cpp: the first state, the equation of motion and the joints.
void check_start(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result);
void check_motion(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result);
void check_joints(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result);

// integration.cpp: integrated references and tables of a smooth motion against another integration; t_valid.
void check_agreement(const Scenario& scenario, const Reference& reference, Certification& result);
void check_validity(const Scenario& scenario, const Reference& reference, Certification& result);

// simulation.cpp: motion with impacts and limits.
void check_simulation(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result);
// What keeps the core from moving such a scenario; nothing when it can.
std::optional<std::string> why_not_simulated(const Scenario& scenario);
// The core's motion in steps of dt [s], cut at impacts and at limits of joints.
Trajectory simulated(const Scenario& scenario, double dt, double contact_tolerance);

// invariants.cpp: what is conserved, and that bodies touch at the times of events.
void check_invariants(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result);
void check_touch(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result);
// For scenarios of which only invariants are known: does the law keep what the gates ask for, and does a simulation?
void check_kept(const Scenario& scenario, Certification& result);

// threshold_search.cpp
void check_threshold(const Scenario& scenario, Certification& result);

}  // namespace plumbline
