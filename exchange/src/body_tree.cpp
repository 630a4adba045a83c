#include "body_tree.hpp"

namespace plumbline {
namespace {

class Grower {
 public:
  Grower(const Scenario& scenario, bool (*hangs)(JointKind))
      : scenario_(scenario), hangs_(hangs), place_(scenario.bodies.size(), kWorld) {}

  BodyTree grow() {
    hang_from(kWorld, kWorld);
    for (std::size_t body = 0; body < scenario_.bodies.size(); ++body) {
      if (scenario_.bodies[body].fixed || place_[body] != kWorld) continue;
      add({body, kWorld, std::nullopt, kWorld, false, {}}, kWorld);
      hang_from(body, place_[body]);
    }
    std::vector<bool> used(scenario_.joints.size(), false);
    for (const TreeNode& node : tree_.nodes) {
      if (node.joint) used[node.stated] = true;
    }
    for (std::size_t k = 0; k < used.size(); ++k) {
      if (!used[k]) tree_.left_over.push_back(k);
    }
    return std::move(tree_);
  }

 private:
  void add(TreeNode node, std::size_t parent_place) {
    place_[node.body] = tree_.nodes.size();
    (parent_place == kWorld ? tree_.roots : tree_.nodes[parent_place].children).push_back(tree_.nodes.size());
    tree_.nodes.push_back(std::move(node));
  }

  // Level by level, so that a loop is cut far from the world.
  void hang_from(std::size_t root, std::size_t root_place) {
    std::vector<std::pair<std::size_t, std::size_t>> parents = {{root, root_place}};
    for (std::size_t next = 0; next < parents.size(); ++next) {
      const auto [parent, parent_place] = parents[next];
      for (std::size_t k = 0; k < scenario_.joints.size(); ++k) {
        const Joint& joint = scenario_.joints[k];
        const bool turned = joint.a != parent;
        if (!hangs_(joint.kind) || (turned && (joint.b != parent || joint.a == kWorld))) continue;
        const std::size_t child = turned ? joint.a : joint.b;
        if (place_[child] != kWorld) continue;
        add({child, parent, turned ? reversed(joint) : joint, k, turned, {}}, parent_place);
        parents.emplace_back(child, place_[child]);
      }
    }
  }

  const Scenario& scenario_;
  bool (*hangs_)(JointKind);
  std::vector<std::size_t> place_;
  BodyTree tree_;
};

}  // namespace

BodyTree body_tree(const Scenario& scenario, bool (*hangs)(JointKind)) { return Grower(scenario, hangs).grow(); }

BodyState start_of(const Scenario& scenario, std::size_t body) {
  return body == kWorld ? BodyState{} : scenario.bodies[body].initial;
}

std::optional<JointSpring> spring_of(const Scenario& scenario, const TreeNode& node) {
  for (JointSpring spring : scenario.joint_springs) {
    if (!node.joint || spring.joint != node.stated) continue;
    if (node.turned) spring.rest = -spring.rest;  // a coordinate that is seen from its other end counts backwards
    return spring;
  }
  return std::nullopt;
}

}  // namespace plumbline
