#include "joint_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "expression.hpp"
#include "plumbline/core/joints/joint_equations.hpp"
#include "scene.hpp"
#include "spelling.hpp"

namespace plumbline {
namespace {

constexpr std::string_view kWorldName = "world";

// Typing errors are far larger, and the rounding of any sensible expression far smaller.
constexpr double kVelocityTolerance = 1e-9;

JointKind read_kind(const Node& node) {
  std::vector<std::string> names;
  for (const JointKind kind :
       {JointKind::kBall, JointKind::kHinge, JointKind::kSlider, JointKind::kFixed, JointKind::kDistance}) {
    names.emplace_back(joint_name(kind));
    if (node.text == names.back()) return kind;
  }
  fail(node, fmt::format("unknown joint '{}'; {}known: {}", node.text, did_you_mean(node.text, names),
                         fmt::join(names, ", ")));
}

class JointReader {
 public:
  JointReader(const Node& table, const Parameters& constants, const Scenario& scenario)
      : table_(table), constants_(constants), scenario_(scenario) {
    for (const Body& body : scenario.bodies) states_.push_back(body.initial);
  }

  Joint read() const {
    allow_only(table_, {"name", "kind", "between", "anchor", "anchors", "axis", "range", "stiffness", "damping", "rest",
                        "drive"});
    const std::string& name = as_text(need(table_, "name", "name = \"hinge\""));
    const Node& kind_node = need(table_, "kind", "kind = \"hinge\"  # ball, hinge, slider, fixed or distance");
    as_text(kind_node);
    const JointKind kind = read_kind(kind_node);
    const Node& between = need(table_, "between", "between = [\"world\", \"arm\"]");
    const auto& pair = as_array(between, 2);
    std::size_t a = end_named(pair[0]), b = end_named(pair[1]);
    if (a == kWorld && b == kWorld) fail(between, "both ends are at rest; name a body that moves");
    if (a == b) fail(between, "a body cannot be tied to itself; name two bodies, or one and \"world\"");
    const bool turned = b == kWorld;  // the world can only be a
    if (turned) std::swap(a, b);
    Joint joint = kind == JointKind::kDistance ? read_rod(a, b, turned) : read_frame(kind, a, b);
    joint.name = name;
    read_range(joint);
    require_rates(joint, kind);
    return joint;
  }

 private:
  // A fixed body is a place in the world.
  std::size_t end_named(const Node& node) const {
    if (as_text(node) == kWorldName) return kWorld;
    const std::size_t body = body_named(node, scenario_.bodies);
    return scenario_.bodies[body].fixed ? kWorld : body;
  }

  void refuse_key(const char* key, const char* why) const {
    if (const Node* node = find(table_, key)) fail(*node, why);
  }

  Joint read_rod(std::size_t a, std::size_t b, bool turned) const {
    refuse_key("anchor", "a distance joint has two ends; write anchors = [[x, y, z], [x, y, z]]");
    refuse_key("axis", "a distance joint has no axis; remove this line");
    const Node& node =
        need(table_, "anchors", "anchors = [[0, 0, 1], [0, 0, 0]]  # its ends at the start, world frame");
    const auto& ends = as_array(node, 2);
    const Vec3 first = vector3(ends[0], constants_), second = vector3(ends[1], constants_);
    if (!((second - first).norm() > 0)) fail(node, "its ends are the same point; for no distance use kind = \"ball\"");
    return turned ? rod_between(a, b, states_, second, first) : rod_between(a, b, states_, first, second);
  }

  Joint read_frame(JointKind kind, std::size_t a, std::size_t b) const {
    refuse_key("anchors", "only a distance joint has two ends; write anchor = [x, y, z]");
    const Vec3 anchor = vector3(need(table_, "anchor", "anchor = [0, 0, 0]  # at the start, world frame"), constants_);
    if (kind != JointKind::kHinge && kind != JointKind::kSlider) {
      refuse_key("axis", "only hinges and sliders have an axis; remove this line");
      return joint_at(kind, a, b, states_, anchor);
    }
    const Node& axis_node = need(table_, "axis", "axis = [0, 1, 0]  # at the start, world frame");
    const Vec3 axis = vector3(axis_node, constants_);
    if (!(axis.norm() > 0)) fail(axis_node, "must not be the zero vector; [0, 1, 0] turns in the x-z plane");
    return joint_at(kind, a, b, states_, anchor, axis);
  }

  void read_range(Joint& joint) const {
    const Node* node = find(table_, "range");
    if (node == nullptr) return;
    if (joint.kind != JointKind::kHinge && joint.kind != JointKind::kSlider) {
      fail(*node, "only hinges and sliders have a coordinate to bound; remove this line");
    }
    const auto& bounds = as_array(*node, 2);
    const JointRange range{number(bounds[0], constants_), number(bounds[1], constants_)};
    if (!(range.low <= 0 && 0 <= range.high && range.low < range.high)) {
      fail(*node, "must hold 0, where the joint starts: [low, high] with low <= 0 <= high");
    }
    if (joint.kind == JointKind::kHinge && !(range.low > -std::numbers::pi && range.high < std::numbers::pi)) {
      fail(*node, "the angle of a hinge is known within (-pi, pi); take bounds inside it");
    }
    joint.range = range;
  }

  void require_rates(const Joint& joint, JointKind kind) const {
    double worst = 0;
    for (const JointRow& row : joint_rows(joint, states_)) worst = std::max(worst, std::abs(rate(row, states_)));
    if (worst <= kVelocityTolerance * std::max(1.0, scenario_.scales.velocity())) return;
    fail(table_, fmt::format("the {} joint '{}' would come apart: the bodies start with {} a second across it; correct "
                             "their velocity or angular_velocity",
                             joint_name(kind), joint.name, shortest(worst)));
  }

  const Node& table_;
  const Parameters& constants_;
  const Scenario& scenario_;
  std::vector<BodyState> states_;
};

}  // namespace

std::vector<Joint> read_joints(const Node& root, const Parameters& constants, const Scenario& scenario) {
  std::vector<Joint> joints;
  for (const Node& table : tables(root, "joint")) {
    Joint joint = JointReader(table, constants, scenario).read();
    if (std::any_of(joints.begin(), joints.end(), [&](const Joint& j) { return j.name == joint.name; })) {
      fail(need(table, "name", ""), fmt::format("the name '{}' is used twice; give each joint its own", joint.name));
    }
    joints.push_back(std::move(joint));
  }
  return joints;
}

}  // namespace plumbline
