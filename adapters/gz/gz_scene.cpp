#include "gz_scene.hpp"

#include <cmath>
#include <stdexcept>

namespace plumbline {
namespace {

std::string words(const Vec3& v) { return shortest(v.x()) + " " + shortest(v.y()) + " " + shortest(v.z()); }

std::string tag(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

std::string pose(const Vec3& p, const Quat& q) {
  return "<pose rotation_format='quat_xyzw'>" + words(p) + " " + words(q.vec()) + " " + shortest(q.w()) + "</pose>";
}

std::string geometry(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return tag("geometry", tag("sphere", tag("radius", shortest(sphere->radius))));
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    return tag("geometry", tag("box", tag("size", words(box->size))));
  }
  // Facing z: its pose turns it, since the layer turns normals below the horizon the wrong way.
  return tag("geometry", tag("plane", tag("normal", "0 0 1")));
}

std::string collision(const Body& body, const ContactMaterial& contact) {
  std::string text = geometry(body.shape);
  if (const auto* half = std::get_if<HalfSpace>(&body.shape)) {
    text += pose(Vec3::Zero(), half_space_attitude(*half));
  }
  // DART takes the smaller friction of the two, and the product of the restitutions.
  const std::string mu = shortest(contact.friction);
  const std::string e = shortest(std::sqrt(contact.restitution));
  text += tag("surface", tag("friction", tag("ode", tag("mu", mu) + tag("mu2", mu))) +
                             tag("bounce", tag("restitution_coefficient", e) + tag("threshold", "0")));
  return "<collision name='shape'>" + text + "</collision>";
}

std::string inertial(const Body& body) {
  return tag("inertial",
             tag("mass", shortest(body.mass)) +
                 tag("inertia", tag("ixx", shortest(body.inertia.x())) + tag("iyy", shortest(body.inertia.y())) +
                                    tag("izz", shortest(body.inertia.z())) + tag("ixy", "0") + tag("ixz", "0") +
                                    tag("iyz", "0")));
}

std::string link(const Scenario& scenario, std::size_t i) {
  const Body& body = scenario.bodies[i];
  // A half-space states its plane by normal and point; what attitude it has does not count.
  const bool plane = std::holds_alternative<HalfSpace>(body.shape);
  std::string text = pose(body.initial.p_WB, plane ? Quat(Quat::Identity()) : body.initial.q_WB);
  if (!body.fixed) text += inertial(body);
  if (scenario.contact) text += collision(body, *scenario.contact);
  return "<link name='" + gz_link_name(i) + "'>" + text + "</link>";
}

std::string joint(const TreeLink& tree_link) {
  const Joint& j = *tree_link.joint;
  const char* type = j.kind == JointKind::kHinge    ? "revolute"
                     : j.kind == JointKind::kSlider ? "prismatic"
                     : j.kind == JointKind::kBall   ? "ball"
                                                    : "fixed";
  // The joint's frame has the axes of the child.
  std::string text = pose(j.on_b.anchor, Quat::Identity());
  text += tag("parent", j.a == kWorld ? "world" : gz_link_name(j.a)) + tag("child", gz_link_name(j.b));
  if (j.kind == JointKind::kHinge || j.kind == JointKind::kSlider)
    text += tag("axis", tag("xyz", words(j.on_b.axis())));
  return "<joint name='" + gz_joint_name(tree_link.stated) + "' type='" + type + "'>" + text + "</joint>";
}

void require_noticed(const ContactMaterial& contact) {
  constexpr double kTakenForNone = 1e-3;  // per pair; friction is the smaller of two equal ones
  for (double coefficient : {contact.restitution, contact.friction}) {
    if (coefficient == 0 || coefficient > kTakenForNone) continue;
    throw std::invalid_argument("DART takes restitution and friction up to 0.001 for none: state 0 or more than that");
  }
}

}  // namespace

std::string gz_link_name(std::size_t body) { return "body" + std::to_string(body); }
std::string gz_joint_name(std::size_t joint) { return "joint" + std::to_string(joint); }

Quat half_space_attitude(const HalfSpace& half) { return Quat::FromTwoVectors(Vec3::UnitZ(), half.normal); }

std::vector<GzGroup> gz_groups(const Scenario& scenario) {
  std::vector<GzGroup> groups;
  std::vector<std::size_t> group_of(scenario.bodies.size());
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    if (scenario.bodies[i].fixed) groups.push_back({{TreeLink{i, std::nullopt, 0}}});
  }
  for (const TreeLink& tree_link : joint_tree(scenario).links) {
    const bool root = !tree_link.joint || tree_link.joint->a == kWorld;
    if (root) groups.emplace_back();
    const std::size_t group = root ? groups.size() - 1 : group_of[tree_link.joint->a];
    group_of[tree_link.body] = group;
    groups[group].links.push_back(tree_link);
  }
  return groups;
}

std::string gz_scene_text(const Scenario& scenario, const std::vector<GzGroup>& groups) {
  if (scenario.contact) require_noticed(*scenario.contact);
  std::string text = tag("gravity", words(scenario.gravity));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    // Bodies of a model collide when it says so; those that a joint ties never do.
    std::string model = tag("self_collide", "true");
    if (scenario.bodies[groups[g].links.front().body].fixed) model += tag("static", "true");
    for (const TreeLink& tree_link : groups[g].links) model += link(scenario, tree_link.body);
    for (const TreeLink& tree_link : groups[g].links) {
      if (tree_link.joint) model += joint(tree_link);
    }
    text += "<model name='group" + std::to_string(g) + "'>" + model + "</model>";
  }
  return "<?xml version='1.0'?><sdf version='1.9'><world name='scenario'>" + text + "</world></sdf>";
}

}  // namespace plumbline
