#include "bullet_tree.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>

#include <stdexcept>

#include "bullet_conversions.hpp"

namespace plumbline {
namespace {

// The joint that a link hangs by, with where things stand now as its zero.
struct Hanging {
  btQuaternion parent_to_link;
  btVector3 pivot_on_parent, pivot_to_link;  // in the parent's axes, in the link's axes
  btVector3 axis;                            // in the link's axes
};

Hanging hanging(const Scenario& scenario, const Joint& joint) {
  const BodyState parent = initial_state_of(scenario, joint.a), link = initial_state_of(scenario, joint.b);
  const Vec3 pivot_W = link.p_WB + link.q_WB * joint.on_b.anchor;
  return {quaternion(link.q_WB.conjugate() * parent.q_WB), vector(parent.q_WB.conjugate() * (pivot_W - parent.p_WB)),
          vector(-joint.on_b.anchor), vector(joint.on_b.axis())};
}

}  // namespace

std::vector<std::vector<TreeLink>> bullet_trees(const Scenario& scenario) {
  const JointTree forest = joint_tree(scenario);
  std::vector<std::vector<TreeLink>> trees;
  std::vector<std::size_t> tree_of(scenario.bodies.size());
  for (const TreeLink& link : forest.links) {
    const bool root = !link.joint || link.joint->a == kWorld;
    if (root) trees.emplace_back();
    tree_of[link.body] = root ? trees.size() - 1 : tree_of[link.joint->a];
    trees[tree_of[link.body]].push_back(link);
  }
  return trees;
}

void set_up_link(btMultiBody& tree, int i, int parent, const Scenario& scenario, const TreeLink& link) {
  const Body& body = scenario.bodies[link.body];
  const Hanging h = hanging(scenario, *link.joint);
  const btScalar mass = real(body.mass);
  const btVector3 inertia = vector(body.inertia);
  switch (link.joint->kind) {
    case JointKind::kBall:
      return tree.setupSpherical(i, mass, inertia, parent, h.parent_to_link, h.pivot_on_parent, h.pivot_to_link, true);
    case JointKind::kHinge:
      return tree.setupRevolute(i, mass, inertia, parent, h.parent_to_link, h.axis, h.pivot_on_parent, h.pivot_to_link,
                                true);
    case JointKind::kSlider:
      return tree.setupPrismatic(i, mass, inertia, parent, h.parent_to_link, h.axis, h.pivot_on_parent, h.pivot_to_link,
                                 true);
    case JointKind::kFixed:
      return tree.setupFixed(i, mass, inertia, parent, h.parent_to_link, h.pivot_on_parent, h.pivot_to_link);
    case JointKind::kDistance:
      break;
  }
  throw std::logic_error("a rod is no joint of a tree");
}

std::unique_ptr<btMultiBodyConstraint> bullet_stop(btMultiBody& tree, int i, const JointRange& range,
                                                   double max_impulse) {
  auto stop = std::make_unique<btMultiBodyJointLimitConstraint>(&tree, i, real(range.low), real(range.high));
  stop->setMaxAppliedImpulse(real(max_impulse));
  stop->finalizeMultiDof();
  return stop;
}

void set_initial_rate(btMultiBody& tree, int i, const Scenario& scenario, const Joint& joint) {
  if (joint.kind == JointKind::kHinge || joint.kind == JointKind::kSlider) {
    tree.setJointVel(i, real(initial_rate(scenario, joint)));
  } else if (joint.kind == JointKind::kBall) {
    const btVector3 w = vector(initial_relative_rotation(scenario, joint));
    tree.setJointVelMultiDof(i, static_cast<const btScalar*>(w));
  }
}

}  // namespace plumbline
