// Springs, dampers and motors of a scenario file.
#pragma once

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// [[spring]]: between two points of bodies or of the world, given where they are at the start.
std::vector<Spring> read_springs(const Node& root, const Parameters& constants, const Scenario& scenario);

// The keys stiffness, damping and rest of [[joint]]; scenario.joints must have been read.
std::vector<JointSpring> read_joint_springs(const Node& root, const Parameters& constants, const Scenario& scenario);

// The key drive of [[joint]]: an expression of t, q and dq. Evaluating it writes into variables that copies share.
std::vector<JointDrive> read_drives(const Node& root, const Parameters& constants, const Scenario& scenario);

}  // namespace plumbline
