// A scenario as the SDF text that Gazebo's users write: one model for every group of jointed bodies.
#pragma once

#include <string>
#include <vector>

#include "plumbline/adapters/joint_tree.hpp"

namespace plumbline {

struct GzGroup {
  std::vector<TreeLink> links;  // parents before their children; a fixed body stands alone
};

std::vector<GzGroup> gz_groups(const Scenario& scenario);

// Names of links and joints in the text, by their places in the scenario.
std::string gz_link_name(std::size_t body);
std::string gz_joint_name(std::size_t joint);

// Turns z to the normal: a plane is stated facing z.
Quat half_space_attitude(const HalfSpace& half);

// Throws std::invalid_argument for what SDF or DART would quietly take for something else.
std::string gz_scene_text(const Scenario& scenario, const std::vector<GzGroup>& groups);

}  // namespace plumbline
