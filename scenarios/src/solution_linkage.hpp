// Linkages that one angle moves: bodies on parallel hinges to the world, and bodies that these carry round without
// turning them, as the couplers of parallel cranks are carried.
#pragma once

#include <memory>
#include <string>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// With the angle theta about the common axis n, every centre of mass runs on a circle with an arm a_i(theta):
//
//   M theta'' = n . (S(theta) x g),   M = sum of m_i |a_i|^2 + sum of n.I_i n over the bodies that turn,   S = sum m_i
//   a_i
//
// which is the pendulum of exact/planar_pendulum.hpp with w0^2 = |S| |g|/M, g and S without their parts along n. A
// hinge may have a range: the linkage stops there, and stays when gravity holds it against the stop.
//
// Throws std::invalid_argument for scenarios that it is not for.
std::shared_ptr<const Reference> solve_turning_linkage(const Scenario& scenario, std::string citation);

}  // namespace plumbline
