#include "plumbline/adapters/joint_tree.hpp"

#include <algorithm>
#include <stdexcept>

#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {
namespace {

class TreeBuilder {
 public:
  explicit TreeBuilder(const Scenario& scenario)
      : scenario_(scenario), placed_(scenario.bodies.size(), false), used_(scenario.joints.size(), false) {}

  JointTree build() {
    hang_from(kWorld);
    // Groups that no joint ties to the world float as a whole, by the body that was stated first.
    for (std::size_t body = 0; body < scenario_.bodies.size(); ++body) {
      if (placed_[body] || scenario_.bodies[body].fixed) continue;
      place({body, std::nullopt, 0});
      hang_from(body);
    }
    for (std::size_t k = 0; k < used_.size(); ++k) {
      if (!used_[k]) tree_.left_over.push_back(k);
    }
    return std::move(tree_);
  }

 private:
  void place(TreeLink link) {
    placed_[link.body] = true;
    tree_.links.push_back(std::move(link));
  }

  // Everything that hangs from that body, in the order of the joints, level by level.
  void hang_from(std::size_t root) {
    std::vector<std::size_t> parents = {root};
    for (std::size_t next = 0; next < parents.size(); ++next) {
      const std::size_t parent = parents[next];
      for (std::size_t k = 0; k < scenario_.joints.size(); ++k) {
        const Joint& joint = scenario_.joints[k];
        if (used_[k] || joint.kind == JointKind::kDistance) continue;
        const bool as_stated = joint.a == parent, turned = joint.b == parent && joint.a != kWorld;
        if (!as_stated && !turned) continue;
        const std::size_t child = as_stated ? joint.b : joint.a;
        if (placed_[child]) continue;
        used_[k] = true;
        place({child, as_stated ? joint : reversed(joint), k});
        parents.push_back(child);
      }
    }
  }

  const Scenario& scenario_;
  std::vector<bool> placed_, used_;
  JointTree tree_;
};

}  // namespace

JointTree joint_tree(const Scenario& scenario) { return TreeBuilder(scenario).build(); }

std::optional<JointSpring> spring_on(const Scenario& scenario, const TreeLink& link) {
  if (!link.joint) return std::nullopt;
  for (const JointSpring& stated : scenario.joint_springs) {
    if (stated.joint != link.stated) continue;
    JointSpring spring = stated;
    if (scenario.joints[link.stated].b != link.body) spring.rest = -spring.rest;  // turned round
    return spring;
  }
  return std::nullopt;
}

void require_coordinates(const Scenario& scenario, const JointTree& tree) {
  for (const std::size_t k : tree.left_over) {
    const bool sprung = std::any_of(scenario.joint_springs.begin(), scenario.joint_springs.end(),
                                    [&](const JointSpring& spring) { return spring.joint == k; });
    if (!sprung && !scenario.joints[k].range) continue;
    throw std::invalid_argument("joint '" + scenario.joints[k].name + "' closes a loop and has a range or a spring, " +
                                "for which this engine has no coordinate: state it before the loop's other joints");
  }
}

BodyState initial_state_of(const Scenario& scenario, std::size_t body) {
  return body == kWorld ? BodyState{} : scenario.bodies[body].initial;
}

double initial_rate(const Scenario& scenario, const Joint& joint) {
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  return rate(coordinate_row(joint, states), states);
}

Vec3 initial_relative_rotation(const Scenario& scenario, const Joint& joint) {
  const BodyState a = initial_state_of(scenario, joint.a), b = initial_state_of(scenario, joint.b);
  return b.q_WB.conjugate() * (b.w_WB - a.w_WB);
}

}  // namespace plumbline
