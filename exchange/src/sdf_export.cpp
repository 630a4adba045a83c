// SDF 1.9, the format of Gazebo. A link's frame is the scenario's body frame, stated in the world; bodies that joints
// tie share a model.
#include <algorithm>

#include "formats.hpp"
#include "xml_writer.hpp"

namespace plumbline {
namespace {

constexpr const char* kWorldName = "plumbline";  // "world" is reserved

const char* type_of(const Joint& joint) {
  switch (joint.kind) {
    case JointKind::kBall:
      return "ball";
    case JointKind::kHinge:
      return joint.range ? "revolute" : "continuous";
    case JointKind::kSlider:
      return "prismatic";
    case JointKind::kFixed:
      return "fixed";
    case JointKind::kDistance:
      return nullptr;
  }
  return nullptr;
}

class SdfWriter {
 public:
  explicit SdfWriter(const Scenario& scenario) : scenario_(scenario), losses_(losses_of_every_format(scenario)) {}

  ExportedWorld write() {
    Xml* root = document_.NewElement("sdf");
    set(*root, "version", "1.9");
    set(*root, "xmlns:plumbline", "urn:plumbline");
    world_ = &child(*root, "world");
    set(*world_, "name", kWorldName);
    child(*world_, "gravity", spaced(scenario_.gravity));
    if (!scenario_.steps.empty()) {
      Xml& physics = child(*world_, "physics");
      set(physics, "name", "plumbline");
      set(physics, "type", "ignored");
      child(physics, "max_step_size", shortest(scenario_.steps.front()));
      child(physics, "real_time_factor", "1");
    }
    add_fields();
    for (const Body& body : scenario_.bodies) {
      if (body.fixed) add_fixed(body);
    }
    for (const auto& group : groups()) add_group(group);
    add_state();
    for (const Spring& spring : scenario_.springs) {
      losses_.push_back("spring " + quoted(spring.name) + ": SDF has springs on the axes of joints only; dropped");
    }
    for (const Joint& joint : scenario_.joints) {
      if (joint.kind == JointKind::kDistance) {
        losses_.push_back("joint " + quoted(joint.name) + ": distance joint has no SDF equivalent; dropped");
      }
    }
    add_preamble(document_, "SDF", scenario_.case_name(), losses_);
    document_.InsertEndChild(root);
    return {printed(document_), losses_};
  }

 private:
  // SDF passes over elements with a prefix.
  void add_fields() {
    const Scales& s = scenario_.scales;
    child(*world_, "plumbline:id", scenario_.id);
    child(*world_, "plumbline:duration", shortest(scenario_.duration));
    child(*world_, "plumbline:scales", spaced({s.length, s.time, s.mass}));
  }

  void add_pose(Xml& element, const Vec3& p, const Quat& q) {
    Xml& pose = child(element, "pose", spaced(p) + ' ' + spaced({q.x(), q.y(), q.z(), q.w()}));
    set(pose, "rotation_format", "quat_xyzw");
  }

  void add_geometry(Xml& parent, const Shape& shape) {
    Xml& geometry = child(parent, "geometry");
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      child(child(geometry, "sphere"), "radius", shortest(sphere->radius));
    } else if (const auto* box = std::get_if<Box>(&shape)) {
      child(child(geometry, "box"), "size", spaced(box->size));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      Xml& element = child(geometry, "cylinder");
      child(element, "radius", shortest(cylinder->radius));
      child(element, "length", shortest(cylinder->height));
    } else {
      Xml& plane = child(geometry, "plane");
      child(plane, "normal", spaced(std::get<HalfSpace>(shape).normal));
      child(plane, "size", "100 100");  // as drawn: what collides has no end
    }
  }

  void add_shape(Xml& link, const Shape& shape) {
    Xml& visual = child(link, "visual");
    set(visual, "name", "visual");
    add_geometry(visual, shape);
    if (!scenario_.contact) return;
    Xml& collision = child(link, "collision");
    set(collision, "name", "collision");
    add_geometry(collision, shape);
    Xml& surface = child(collision, "surface");
    Xml& bounce = child(surface, "bounce");
    child(bounce, "restitution_coefficient", shortest(scenario_.contact->restitution));
    child(bounce, "threshold", "0");
    Xml& ode = child(child(surface, "friction"), "ode");
    child(ode, "mu", shortest(scenario_.contact->friction));
    child(ode, "mu2", shortest(scenario_.contact->friction));
  }

  void add_fixed(const Body& body) {
    Xml& model = child(*world_, "model");
    set(model, "name", body.name);
    child(model, "static", "true");
    Xml& link = child(model, "link");
    set(link, "name", body.name);
    add_pose(link, body.initial.p_WB, body.initial.q_WB);
    add_shape(link, body.shape);
  }

  void add_link(Xml& model, const Body& body) {
    Xml& link = child(model, "link");
    set(link, "name", body.name);
    add_pose(link, body.initial.p_WB, body.initial.q_WB);
    Xml& inertial = child(link, "inertial");
    child(inertial, "mass", shortest(body.mass));
    Xml& inertia = child(inertial, "inertia");
    const char* const diagonal[] = {"ixx", "iyy", "izz"};
    for (int i = 0; i < 3; ++i) child(inertia, diagonal[i], shortest(body.inertia(i)));
    for (const char* zero : {"ixy", "ixz", "iyz"}) child(inertia, zero, "0");
    add_shape(link, body.shape);
  }

  // Links and joints of a model share their names.
  std::string name_of(const Joint& joint) {
    const auto has_name = [&](const Body& body) { return body.name == joint.name; };
    if (std::none_of(scenario_.bodies.begin(), scenario_.bodies.end(), has_name)) return joint.name;
    losses_.push_back("name of joint " + quoted(joint.name) + ": a body has it; written as " +
                      quoted(joint.name + " joint"));
    return joint.name + " joint";
  }

  // The pose of a joint is stated in its child, and its axis in that frame.
  void add_joint(Xml& model, std::size_t k) {
    const Joint& j = scenario_.joints[k];
    Xml& joint = child(model, "joint");
    set(joint, "name", name_of(j));
    set(joint, "type", type_of(j));
    child(joint, "parent", j.a == kWorld ? "world" : scenario_.bodies[j.a].name);
    child(joint, "child", scenario_.bodies[j.b].name);
    child(joint, "pose", spaced(j.on_b.anchor) + " 0 0 0");
    if (j.kind == JointKind::kBall && j.range) {
      losses_.push_back("range of ball joint " + quoted(j.name) + ": SDF has none; dropped");
    }
    if (j.kind != JointKind::kHinge && j.kind != JointKind::kSlider) return;
    Xml& axis = child(joint, "axis");
    child(axis, "xyz", spaced(j.on_b.axis()));
    if (j.range) {
      Xml& limit = child(axis, "limit");
      child(limit, "lower", shortest(j.range->low));
      child(limit, "upper", shortest(j.range->high));
    }
    for (const JointSpring& spring : scenario_.joint_springs) {
      if (spring.joint != k) continue;
      Xml& dynamics = child(axis, "dynamics");
      child(dynamics, "damping", shortest(spring.damping));
      child(dynamics, "spring_reference", shortest(spring.rest));
      child(dynamics, "spring_stiffness", shortest(spring.stiffness));
    }
  }

  // Moving bodies that joints tie to each other, in the order of their first ones.
  std::vector<std::vector<std::size_t>> groups() const {
    std::vector<std::size_t> group_of(scenario_.bodies.size());
    for (std::size_t i = 0; i < group_of.size(); ++i) group_of[i] = i;
    for (const Joint& joint : scenario_.joints) {
      if (joint.a == kWorld || type_of(joint) == nullptr) continue;
      const auto [low, high] = std::minmax(group_of[joint.a], group_of[joint.b]);
      std::replace(group_of.begin(), group_of.end(), std::size_t{high}, std::size_t{low});
    }
    std::vector<std::vector<std::size_t>> result;
    for (std::size_t group = 0; group < group_of.size(); ++group) {
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < group_of.size(); ++i) {
        if (group_of[i] == group && !scenario_.bodies[i].fixed) members.push_back(i);
      }
      if (!members.empty()) result.push_back(std::move(members));
    }
    return result;
  }

  void add_group(const std::vector<std::size_t>& bodies) {
    Xml& model = child(*world_, "model");
    set(model, "name", scenario_.bodies[bodies.front()].name);
    if (scenario_.contact && bodies.size() > 1) child(model, "self_collide", "true");
    for (const std::size_t body : bodies) {
      add_link(model, scenario_.bodies[body]);
      models_.push_back({body, bodies.front()});
    }
    for (std::size_t k = 0; k < scenario_.joints.size(); ++k) {
      const Joint& joint = scenario_.joints[k];
      const bool ours = std::find(bodies.begin(), bodies.end(), joint.b) != bodies.end();
      if (ours && type_of(joint) != nullptr) add_joint(model, k);
    }
  }

  // SDF's only place for velocities is a recorded state of the world.
  void add_state() {
    Xml* state = nullptr;
    for (const auto& [body, first] : models_) {
      const BodyState& s = scenario_.bodies[body].initial;
      if (s.v_WB.isZero(0) && s.w_WB.isZero(0)) continue;
      if (state == nullptr) {
        state = &child(*world_, "state");
        set(*state, "world_name", kWorldName);
      }
      // A model's pose in a state would be its pose relative to the world: all of them stand at the origin.
      Xml& model = child(*state, "model");
      set(model, "name", scenario_.bodies[first].name);
      Xml& link = child(model, "link");
      set(link, "name", scenario_.bodies[body].name);
      add_pose(link, s.p_WB, s.q_WB);
      child(link, "velocity", spaced(s.v_WB) + ' ' + spaced(s.w_WB));
      losses_.push_back("initial velocity of " + quoted(scenario_.bodies[body].name) +
                        ": in <state>, which Gazebo Classic and plumbline import read, and Gazebo Sim does not");
    }
  }

  struct Member {
    std::size_t body, first;
  };
  const Scenario& scenario_;
  std::vector<std::string> losses_;
  std::vector<Member> models_;
  tinyxml2::XMLDocument document_;
  Xml* world_ = nullptr;
};

}  // namespace

ExportedWorld to_sdf(const Scenario& scenario) { return SdfWriter(scenario).write(); }

}  // namespace plumbline
