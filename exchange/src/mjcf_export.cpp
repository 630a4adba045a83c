// MJCF, in the dialect of MuJoCo 2.2. A body's frame is the scenario's: at its centre of mass, along its principal
// axes.
#include "body_tree.hpp"
#include "formats.hpp"
#include "plumbline/core/joints/joint_equations.hpp"
#include "xml_writer.hpp"

namespace plumbline {
namespace {

constexpr double kSecondPointOfHinge = 1;  // [m] along the axis: two points on it are as good as the axis

bool hangs(JointKind kind) { return kind != JointKind::kDistance; }

const char* type_of(JointKind kind) {
  switch (kind) {
    case JointKind::kBall:
      return "ball";
    case JointKind::kHinge:
      return "hinge";
    case JointKind::kSlider:
      return "slide";
    default:
      return nullptr;  // a body without joint is part of its parent
  }
}

class MjcfWriter {
 public:
  explicit MjcfWriter(const Scenario& scenario)
      : scenario_(scenario), tree_(body_tree(scenario, hangs)), losses_(losses_of_every_format(scenario)) {
    for (const Body& body : scenario.bodies) states_.push_back(body.initial);
  }

  ExportedWorld write() {
    // The element first and the preamble last: it lists what writing the element has lost.
    root_ = document_.NewElement("mujoco");
    set(*root_, "model", scenario_.id);
    add_options();
    add_fields();
    add_bodies();
    add_exclusions();
    add_springs();
    add_left_over();
    add_keyframe();
    if (scenario_.contact && scenario_.contact->restitution > 0) {
      losses_.push_back("restitution " + shortest(scenario_.contact->restitution) +
                        ": MJCF has none; contacts are springs and dampers (solref). Kept as custom field "
                        "plumbline_restitution, which only plumbline import reads");
    }
    add_preamble(document_, "MJCF", scenario_.case_name(), losses_);
    document_.InsertEndChild(root_);
    return {printed(document_), losses_};
  }

 private:
  void add_options() {
    Xml& compiler = child(*root_, "compiler");
    set(compiler, "angle", "radian");
    set(compiler, "inertiafromgeom", "false");  // masses and inertias are stated
    Xml& option = child(*root_, "option");
    set(option, "gravity", spaced(scenario_.gravity));
    if (!scenario_.steps.empty()) set(option, "timestep", shortest(scenario_.steps.front()));
  }

  void add_field(Xml& custom, const char* name, const std::string& numbers) {
    Xml& field = child(custom, "numeric");
    set(field, "name", name);
    set(field, "data", numbers);
  }
  void add_fields() {
    Xml& custom = child(*root_, "custom");
    add_field(custom, "plumbline_duration", shortest(scenario_.duration));
    const Scales& s = scenario_.scales;
    add_field(custom, "plumbline_scales", spaced({s.length, s.time, s.mass}));
    if (scenario_.contact) add_field(custom, "plumbline_restitution", shortest(scenario_.contact->restitution));
  }

  void add_geom(Xml& parent, const Body& body, bool placed) {
    Xml& geom = child(parent, "geom");
    set(geom, "name", body.name);
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      set(geom, "type", "sphere");
      set(geom, "size", shortest(sphere->radius));
    } else if (const auto* box = std::get_if<Box>(&body.shape)) {
      set(geom, "type", "box");
      set(geom, "size", spaced(Vec3(0.5 * box->size)));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
      set(geom, "type", "cylinder");
      set(geom, "size", spaced({cylinder->radius, 0.5 * cylinder->height}));
    } else {
      set(geom, "type", "plane");
      set(geom, "size", "0 0 1");  // endless both ways
      set(geom, "pos", spaced(body.initial.p_WB));
      set(geom, "quat", spaced(Quat::FromTwoVectors(Vec3::UnitZ(), std::get<HalfSpace>(body.shape).normal)));
    }
    if (placed && !std::holds_alternative<HalfSpace>(body.shape)) {
      set(geom, "pos", spaced(body.initial.p_WB));
      set(geom, "quat", spaced(body.initial.q_WB));
    }
    if (!scenario_.contact) {
      set(geom, "contype", "0");
      set(geom, "conaffinity", "0");
      return;
    }
    const double mu = scenario_.contact->friction;
    set(geom, "condim", mu > 0 ? "3" : "1");  // MuJoCo takes the larger coefficient of a pair, and here all are equal
    if (mu > 0) set(geom, "friction", spaced({mu, 0, 0}));
  }

  void add_bodies() {
    Xml& world = child(*root_, "worldbody");
    for (const Body& body : scenario_.bodies) {
      if (body.fixed) add_geom(world, body, true);
    }
    add_sites(world, kWorld);
    for (const std::size_t node : tree_.roots) add_body(world, tree_.nodes[node]);
  }

  void add_body(Xml& parent, const TreeNode& node) {
    const Body& body = scenario_.bodies[node.body];
    const BodyState from = start_of(scenario_, node.parent), &to = body.initial;
    Xml& element = child(parent, "body");
    set(element, "name", body.name);
    set(element, "pos", spaced(Vec3(from.q_WB.conjugate() * (to.p_WB - from.p_WB))));
    set(element, "quat", spaced(from.q_WB.conjugate() * to.q_WB));
    Xml& inertial = child(element, "inertial");
    set(inertial, "pos", "0 0 0");
    set(inertial, "mass", shortest(body.mass));
    set(inertial, "diaginertia", spaced(body.inertia));
    if (!node.joint) {
      set(child(element, "freejoint"), "name", body.name);
    } else if (type_of(node.joint->kind) != nullptr) {
      add_joint(element, node);
    }
    add_velocity(node);
    add_geom(element, body, false);
    add_sites(element, node.body);
    for (const std::size_t next : node.children) add_body(element, tree_.nodes[next]);
  }

  void add_joint(Xml& element, const TreeNode& node) {
    const Joint& j = *node.joint;
    Xml& joint = child(element, "joint");
    set(joint, "name", j.name);
    set(joint, "type", type_of(j.kind));
    set(joint, "pos", spaced(j.on_b.anchor));
    if (j.kind == JointKind::kBall) {
      if (j.range)
        losses_.push_back("range of ball joint " + quoted(j.name) + ": MuJoCo's also counts the twist; dropped");
      return;
    }
    set(joint, "axis", spaced(j.on_b.axis()));
    if (j.range) {
      set(joint, "limited", "true");
      set(joint, "range", spaced({j.range->low, j.range->high}));
    }
    if (const auto spring = spring_of(scenario_, node)) {
      set(joint, "stiffness", shortest(spring->stiffness));
      set(joint, "damping", shortest(spring->damping));
      set(joint, "springref", shortest(spring->rest));
    }
  }

  // In the order of MuJoCo's generalised velocities, which is that of the file.
  void add_velocity(const TreeNode& node) {
    const BodyState& s = scenario_.bodies[node.body].initial;
    const auto append = [&](const Vec3& v) { velocities_.insert(velocities_.end(), v.data(), v.data() + 3); };
    if (!node.joint) {
      append(s.v_WB);
      append(s.q_WB.conjugate() * s.w_WB);
    } else if (node.joint->kind == JointKind::kBall) {
      append(s.q_WB.conjugate() * (s.w_WB - start_of(scenario_, node.parent).w_WB));
    } else if (node.joint->kind != JointKind::kFixed) {
      velocities_.push_back(rate(coordinate_row(*node.joint, states_), states_));
    }
  }

  void add_site(Xml& body, const std::string& name, const Vec3& place) {
    Xml& site = child(body, "site");
    set(site, "name", name);
    set(site, "pos", spaced(place));
  }
  void add_sites(Xml& element, std::size_t body) {
    for (const Spring& spring : scenario_.springs) {
      if (spring.a == body) add_site(element, spring.name + " a", spring.on_a);
      if (spring.b == body) add_site(element, spring.name + " b", spring.on_b);
    }
    for (const Joint& joint : scenario_.joints) {
      if (joint.kind != JointKind::kDistance) continue;
      if (joint.a == body) add_site(element, joint.name + " a", joint.on_a.anchor);
      if (joint.b == body) add_site(element, joint.name + " b", joint.on_b.anchor);
    }
  }

  // Bodies that a joint ties do not collide. MuJoCo leaves out parents and children by itself, but not where the parent
  // stands still, and not those that a rod or a loop's joint ties.
  void add_exclusions() {
    if (!scenario_.contact) return;
    for (const Joint& joint : scenario_.joints) {
      if (joint.a == kWorld) continue;
      Xml& exclude = child(section("contact"), "exclude");
      set(exclude, "body1", scenario_.bodies[joint.a].name);
      set(exclude, "body2", scenario_.bodies[joint.b].name);
    }
  }

  Xml& add_tendon(const std::string& name) {
    Xml& tendon = child(section("tendon"), "spatial");
    set(tendon, "name", name);
    for (const char* end : {" a", " b"}) set(child(tendon, "site"), "site", name + end);
    return tendon;
  }
  void add_springs() {
    for (const Spring& spring : scenario_.springs) {
      Xml& tendon = add_tendon(spring.name);
      set(tendon, "stiffness", shortest(spring.stiffness));
      set(tendon, "damping", shortest(spring.damping));
      set(tendon, "springlength", shortest(spring.length));
    }
  }

  // Joints that close loops, and rods. All hold at the start, which is where MuJoCo takes their targets from.
  void add_left_over() {
    for (const std::size_t k : tree_.left_over) {
      const Joint& j = scenario_.joints[k];
      for (const JointSpring& spring : scenario_.joint_springs) {
        if (spring.joint == k) {
          losses_.push_back("spring of joint " + quoted(j.name) +
                            ": it closes a loop, and MJCF's equalities have none");
        }
      }
      if (j.range)
        losses_.push_back("range of joint " + quoted(j.name) + ": it closes a loop, and equalities have none");
      switch (j.kind) {
        case JointKind::kBall:
          add_equality("connect", j, j.name, j.on_b.anchor);
          break;
        case JointKind::kHinge:
          add_equality("connect", j, j.name, j.on_b.anchor);
          add_equality("connect", j, j.name + " 2", j.on_b.anchor + kSecondPointOfHinge * j.on_b.axis());
          losses_.push_back("hinge " + quoted(j.name) + ": it closes a loop; written as two points of its axis");
          break;
        case JointKind::kFixed:
          add_equality("weld", j, j.name, std::nullopt);
          break;
        case JointKind::kDistance: {
          add_tendon(j.name);
          Xml& equality = child(section("equality"), "tendon");
          set(equality, "name", j.name);
          set(equality, "tendon1", j.name);
          break;
        }
        case JointKind::kSlider:
          losses_.push_back("slider " + quoted(j.name) +
                            ": it closes a loop, for which MJCF has no constraint; dropped");
          break;
      }
    }
  }
  void add_equality(const char* kind, const Joint& joint, const std::string& name, const std::optional<Vec3>& anchor) {
    Xml& equality = child(section("equality"), kind);
    set(equality, "name", name);
    set(equality, "body1", scenario_.bodies[joint.b].name);
    if (joint.a != kWorld) set(equality, "body2", scenario_.bodies[joint.a].name);
    if (anchor) set(equality, "anchor", spaced(*anchor));
  }

  void add_keyframe() {
    std::string text;
    for (const double v : velocities_) text += (text.empty() ? "" : " ") + shortest(v);
    if (text.empty()) return;
    Xml& key = child(section("keyframe"), "key");
    set(key, "name", "start");
    set(key, "qvel", text);
  }

  // Made when the first thing stands in it.
  Xml& section(const char* tag) {
    Xml* found = root_->FirstChildElement(tag);
    return found != nullptr ? *found : child(*root_, tag);
  }

  const Scenario& scenario_;
  BodyTree tree_;
  std::vector<std::string> losses_;
  std::vector<BodyState> states_;
  std::vector<double> velocities_;
  tinyxml2::XMLDocument document_;
  Xml* root_ = nullptr;
};

}  // namespace

ExportedWorld to_mjcf(const Scenario& scenario) { return MjcfWriter(scenario).write(); }

}  // namespace plumbline
