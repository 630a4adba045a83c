// Bodies and joints as a tree that hangs from the world: what engines in reduced coordinates are built from.
//
// Every moving body hangs by one joint from its parent, or floats free of any. Joints that would close a loop are left
// over, and so are all distance joints: a rod is no coordinate. An engine holds those by constraints, if it can.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct TreeLink {
  std::size_t body = 0;
  // How it hangs: joint.b is `body`, joint.a its parent or kWorld; turned round where the scenario states it the other
  // way. None: the body floats.
  std::optional<Joint> joint;
  std::size_t stated = 0;  // place of that joint in Scenario::joints
};

struct JointTree {
  std::vector<TreeLink> links;         // every moving body once, parents before their children
  std::vector<std::size_t> left_over;  // places in Scenario::joints
};

JointTree joint_tree(const Scenario& scenario);

// The spring on the joint by which that body hangs, in the coordinate of link.joint; none if there is none. (The range
// of link.joint is in that coordinate already.)
std::optional<JointSpring> spring_on(const Scenario& scenario, const TreeLink& link);
// Throws std::invalid_argument, naming the joint and the way out, where one that is left over has a range or a spring:
// in joint coordinates there is nothing for them to act on.
void require_coordinates(const Scenario& scenario, const JointTree& tree);

// The rate of the joint's coordinate in the initial states: of a hinge w_B - w_A along its axis [rad/s], of a slider
// the speed of B's anchor along it [m/s].
double initial_rate(const Scenario& scenario, const Joint& joint);
// Angular velocity of b relative to a, in b's axes [rad/s]: what a ball joint starts with.
Vec3 initial_relative_rotation(const Scenario& scenario, const Joint& joint);
// The state of a joint's end: kWorld stands still at the origin.
BodyState initial_state_of(const Scenario& scenario, std::size_t body);

}  // namespace plumbline
