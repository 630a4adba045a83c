#include "spring_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "expression.hpp"
#include "scene.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

double not_negative(const Node& node, const Parameters& constants) {
  const double value = number(node, constants);
  if (!(value >= 0)) fail(node, fmt::format("must be >= 0, is {}", shortest(value)));
  return value;
}

double not_negative_or(const Node& table, const char* key, const Parameters& constants, double otherwise) {
  const Node* node = find(table, key);
  return node == nullptr ? otherwise : not_negative(*node, constants);
}

// A fixed body is a place in the world.
std::size_t end_named(const Node& node, const Scenario& scenario) {
  if (as_text(node) == "world") return kWorld;
  const std::size_t body = body_named(node, scenario.bodies);
  return scenario.bodies[body].fixed ? kWorld : body;
}

Vec3 on_body(std::size_t body, const Vec3& point_W, const Scenario& scenario) {
  if (body == kWorld) return point_W;
  const BodyState& s = scenario.bodies[body].initial;
  return s.q_WB.conjugate() * (point_W - s.p_WB);
}

Spring read_spring(const Node& table, const Parameters& constants, const Scenario& scenario) {
  allow_only(table, {"name", "between", "anchors", "stiffness", "damping", "length"});
  Spring spring;
  spring.name = as_text(need(table, "name", "name = \"spring\""));
  const Node& between = need(table, "between", "between = [\"world\", \"bob\"]");
  const auto& pair = as_array(between, 2);
  spring.a = end_named(pair[0], scenario);
  spring.b = end_named(pair[1], scenario);
  const auto& anchors =
      as_array(need(table, "anchors", "anchors = [[0, 0, 1], [0, 0, 0]]  # its ends at the start, world frame"), 2);
  Vec3 first = vector3(anchors[0], constants), second = vector3(anchors[1], constants);
  if (spring.b == kWorld) {
    std::swap(spring.a, spring.b);
    std::swap(first, second);
  }
  if (spring.b == kWorld) fail(between, "both ends are at rest; name a body that moves");
  if (spring.a == spring.b) fail(between, "a body cannot pull itself; name two bodies, or one and \"world\"");
  spring.on_a = on_body(spring.a, first, scenario);
  spring.on_b = on_body(spring.b, second, scenario);
  spring.stiffness = not_negative(need(table, "stiffness", "stiffness = 100  # N/m"), constants);
  spring.damping = not_negative_or(table, "damping", constants, 0);
  spring.length = not_negative_or(table, "length", constants, (second - first).norm());
  return spring;
}

// The expression of one drive and the variables that it reads. It stays where it is: it points into itself.
struct CompiledDrive {
  std::array<double, kDriveSymbols.size()> slots{};
  std::vector<Expression> effort;  // one; a vector because it is made after the slots
};

void require_coordinate(const Node& node, const Joint& joint) {
  if (joint.kind == JointKind::kHinge || joint.kind == JointKind::kSlider) return;
  fail(node, "only hinges and sliders have a coordinate that it can act on; remove this line");
}

}  // namespace

std::vector<Spring> read_springs(const Node& root, const Parameters& constants, const Scenario& scenario) {
  std::vector<Spring> springs;
  for (const Node& table : tables(root, "spring")) springs.push_back(read_spring(table, constants, scenario));
  return springs;
}

std::vector<JointSpring> read_joint_springs(const Node& root, const Parameters& constants, const Scenario& scenario) {
  std::vector<JointSpring> springs;
  for (std::size_t j = 0; j < scenario.joints.size(); ++j) {
    const Node& table = tables(root, "joint")[j];
    const Node *stiffness = find(table, "stiffness"), *damping = find(table, "damping"), *rest = find(table, "rest");
    if (stiffness == nullptr && damping == nullptr) {
      if (rest != nullptr) fail(*rest, "without stiffness there is nothing to rest; add stiffness or remove this line");
      continue;
    }
    require_coordinate(stiffness != nullptr ? *stiffness : *damping, scenario.joints[j]);
    springs.push_back({j, not_negative_or(table, "stiffness", constants, 0),
                       not_negative_or(table, "damping", constants, 0),
                       rest == nullptr ? 0 : number(*rest, constants)});
  }
  return springs;
}

std::vector<JointDrive> read_drives(const Node& root, const Parameters& constants, const Scenario& scenario) {
  std::vector<JointDrive> drives;
  for (std::size_t j = 0; j < scenario.joints.size(); ++j) {
    const Node* node = find(tables(root, "joint")[j], "drive");
    if (node == nullptr) continue;
    require_coordinate(*node, scenario.joints[j]);
    for (const auto& [name, value] : constants) {
      if (name == "q" || name == "dq") {
        fail(*node, fmt::format("'{}' is the joint's coordinate here; give the parameter another name", name));
      }
    }
    const auto compiled = std::make_shared<CompiledDrive>();
    compiled->effort.emplace_back(*node, constants, Variables{kDriveSymbols, compiled->slots.data()});
    drives.push_back({j,
                      [compiled](double t, double q, double rate) {
                        compiled->slots = {t, q, rate};
                        return compiled->effort.front()();
                      },
                      node->kind == NodeKind::kText ? node->text : shortest(node->number)});
  }
  return drives;
}

}  // namespace plumbline
