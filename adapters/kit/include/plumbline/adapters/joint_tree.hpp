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

// The rate of the joint's coordinate in the initial states: of a hinge w_B - w_A along its axis [rad/s], of a slider
// the speed of B's anchor along it [m/s].
double initial_rate(const Scenario& scenario, const Joint& joint);
// Angular velocity of b relative to a, in b's axes [rad/s]: what a ball joint starts with.
Vec3 initial_relative_rotation(const Scenario& scenario, const Joint& joint);
// The state of a joint's end: kWorld stands still at the origin.
BodyState initial_state_of(const Scenario& scenario, std::size_t body);

}  // namespace plumbline
