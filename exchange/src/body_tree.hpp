// Bodies and joints as trees that hang from the world: the shape of MJCF and URDF files.
#pragma once

#include <optional>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct TreeNode {
  std::size_t body = 0;
  std::size_t parent = kWorld;        // a moving body, or the world
  std::optional<Joint> joint;         // joint.b is `body`, joint.a its parent; none: the body floats
  std::size_t stated = kWorld;        // place of that joint in Scenario::joints
  bool turned = false;                // the scenario states it the other way round
  std::vector<std::size_t> children;  // places in BodyTree::nodes
};

struct BodyTree {
  std::vector<TreeNode> nodes;         // every moving body, parents before children
  std::vector<std::size_t> roots;      // places of those that float or hang from the world
  std::vector<std::size_t> left_over;  // places in Scenario::joints: rods, what closes loops, what may not hang
};

// Only joints of kinds for which `hangs` is true make a tree.
BodyTree body_tree(const Scenario& scenario, bool (*hangs)(JointKind));

// The world stands still at the origin.
BodyState start_of(const Scenario& scenario, std::size_t body);

// What acts on the coordinate of that joint, as its tree node counts it; null without any.
std::optional<JointSpring> spring_of(const Scenario& scenario, const TreeNode& node);

}  // namespace plumbline
