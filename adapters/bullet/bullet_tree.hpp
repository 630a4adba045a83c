// A scenario's trees of joints as Bullet's articulated bodies.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include <memory>
#include <vector>

#include "plumbline/adapters/joint_tree.hpp"

namespace plumbline {

// The links of each tree, parents first.
std::vector<std::vector<TreeLink>> bullet_trees(const Scenario& scenario);

// Link number `i` of `tree`, which hangs from link `parent`, -1 for the base. Where things stand now is the zero of its
// coordinates.
void set_up_link(btMultiBody& tree, int i, int parent, const Scenario& scenario, const TreeLink& link);

// Once all links are there and finalizeMultiDof() was called.
std::unique_ptr<btMultiBodyConstraint> bullet_stop(btMultiBody& tree, int i, const JointRange& range,
                                                   double max_impulse);
void set_initial_rate(btMultiBody& tree, int i, const Scenario& scenario, const Joint& joint);

}  // namespace plumbline
