// URDF: one tree of links from a root link named world. A link's frame stands at the joint that it hangs by, with the
// axes of the body; mass and shape stand where the centre of mass is.
#include "body_tree.hpp"
#include "formats.hpp"
#include "xml_writer.hpp"

namespace plumbline {
namespace {

// URDF wants an effort and a speed of every limit; nothing in a scenario comes near these.
constexpr double kNoLimit = 1e9;

bool hangs(JointKind kind) {
  return kind == JointKind::kHinge || kind == JointKind::kSlider || kind == JointKind::kFixed;
}

class UrdfWriter {
 public:
  explicit UrdfWriter(const Scenario& scenario)
      : scenario_(scenario), tree_(body_tree(scenario, hangs)), losses_(losses_of_every_format(scenario)) {}

  ExportedWorld write() {
    Xml* root = document_.NewElement("robot");
    set(*root, "name", scenario_.id);
    root_ = root;
    set(child(*root, "link"), "name", "world");
    for (const Body& body : scenario_.bodies) {
      if (body.fixed) add_fixed(body);
    }
    for (const TreeNode& node : tree_.nodes) add_node(node);
    list_losses();
    add_preamble(document_, "URDF", scenario_.case_name(), losses_);
    document_.InsertEndChild(root);
    return {printed(document_), losses_};
  }

 private:
  // From the centre of mass to the link's frame, in body axes.
  static Vec3 frame_of(const TreeNode& node) { return node.joint ? node.joint->on_b.anchor : Vec3::Zero(); }

  void add_origin(Xml& element, const Vec3& p, const Quat& q) {
    Xml& origin = child(element, "origin");
    set(origin, "xyz", spaced(p));
    set(origin, "rpy", spaced_rpy(q));
  }

  void add_shape(Xml& link, const Shape& shape, const Vec3& at) {
    for (const char* tag : {"visual", "collision"}) {
      if (tag == std::string("collision") && !scenario_.contact) continue;
      Xml& element = child(link, tag);
      add_origin(element, at, Quat::Identity());
      Xml& geometry = child(element, "geometry");
      if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        set(child(geometry, "sphere"), "radius", shortest(sphere->radius));
      } else if (const auto* box = std::get_if<Box>(&shape)) {
        set(child(geometry, "box"), "size", spaced(box->size));
      } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        Xml& form = child(geometry, "cylinder");
        set(form, "radius", shortest(cylinder->radius));
        set(form, "length", shortest(cylinder->height));
      }
    }
  }

  Xml& add_joint(const std::string& name, const char* type, const std::string& parent, const std::string& link) {
    Xml& joint = child(*root_, "joint");
    set(joint, "name", name);
    set(joint, "type", type);
    set(child(joint, "parent"), "link", parent);
    set(child(joint, "child"), "link", link);
    return joint;
  }

  void add_fixed(const Body& body) {
    if (std::holds_alternative<HalfSpace>(body.shape)) {
      losses_.push_back("half_space " + quoted(body.name) + ": URDF has no plane; dropped");
      return;
    }
    Xml& link = child(*root_, "link");
    set(link, "name", body.name);
    add_shape(link, body.shape, Vec3::Zero());
    add_origin(add_joint(body.name + " stands", "fixed", "world", body.name), body.initial.p_WB, body.initial.q_WB);
  }

  void add_node(const TreeNode& node) {
    const Body& body = scenario_.bodies[node.body];
    const Vec3 com = -frame_of(node);
    Xml& link = child(*root_, "link");
    set(link, "name", body.name);
    Xml& inertial = child(link, "inertial");
    add_origin(inertial, com, Quat::Identity());
    set(child(inertial, "mass"), "value", shortest(body.mass));
    Xml& inertia = child(inertial, "inertia");
    const char* const diagonal[] = {"ixx", "iyy", "izz"};
    for (int i = 0; i < 3; ++i) set(inertia, diagonal[i], shortest(body.inertia(i)));
    for (const char* zero : {"ixy", "ixz", "iyz"}) set(inertia, zero, "0");
    add_shape(link, body.shape, com);
    hang(node);
  }

  void hang(const TreeNode& node) {
    const Body& body = scenario_.bodies[node.body];
    const BodyState from = start_of(scenario_, node.parent), &to = body.initial;
    Vec3 parent_frame = Vec3::Zero();
    for (const TreeNode& other : tree_.nodes) {
      if (other.body == node.parent) parent_frame = frame_of(other);
    }
    const Vec3 at_W = to.p_WB + to.q_WB * frame_of(node);
    const Vec3 at = from.q_WB.conjugate() * (at_W - from.p_WB) - parent_frame;
    const std::string parent = node.parent == kWorld ? "world" : scenario_.bodies[node.parent].name;
    const char* type = "floating";
    if (node.joint && node.joint->kind == JointKind::kFixed) type = "fixed";
    if (node.joint && node.joint->kind == JointKind::kHinge) type = node.joint->range ? "revolute" : "continuous";
    if (node.joint && node.joint->kind == JointKind::kSlider) type = "prismatic";
    Xml& joint = add_joint(node.joint ? node.joint->name : body.name + " floats", type, parent, body.name);
    add_origin(joint, at, from.q_WB.conjugate() * to.q_WB);
    if (!node.joint || node.joint->kind == JointKind::kFixed) return;
    set(child(joint, "axis"), "xyz", spaced(node.joint->on_b.axis()));
    add_limit(joint, *node.joint);
    if (const auto spring = spring_of(scenario_, node)) {
      set(child(joint, "dynamics"), "damping", shortest(spring->damping));
      if (spring->stiffness > 0) {
        losses_.push_back("stiffness of joint " + quoted(node.joint->name) + ": URDF has none; dropped");
      }
    }
  }

  void add_limit(Xml& joint, const Joint& stated) {
    if (!stated.range && stated.kind == JointKind::kHinge) return;
    const JointRange range = stated.range.value_or(JointRange{-kNoLimit, kNoLimit});
    Xml& limit = child(joint, "limit");
    set(limit, "lower", shortest(range.low));
    set(limit, "upper", shortest(range.high));
    set(limit, "effort", shortest(kNoLimit));
    set(limit, "velocity", shortest(kNoLimit));
  }

  void list_losses() {
    const auto lose = [&](const std::string& what) { losses_.push_back(what); };
    if (!scenario_.gravity.isZero(0)) lose("gravity " + spaced(scenario_.gravity) + ": URDF has none");
    if (scenario_.contact) {
      lose("restitution " + shortest(scenario_.contact->restitution) + " and friction " +
           shortest(scenario_.contact->friction) + ": URDF has no contact laws");
    }
    for (const Body& body : scenario_.bodies) {
      if (body.fixed || (body.initial.v_WB.isZero(0) && body.initial.w_WB.isZero(0))) continue;
      lose("initial velocity of " + quoted(body.name) + ": URDF has none");
    }
    for (const Spring& spring : scenario_.springs) lose("spring " + quoted(spring.name) + ": URDF has none; dropped");
    for (const std::size_t k : tree_.left_over) {
      const Joint& joint = scenario_.joints[k];
      lose("joint " + quoted(joint.name) + ": " + std::string(joint_name(joint.kind)) +
           (hangs(joint.kind) ? " joint closes a loop, and URDF is a tree; dropped"
                              : " joint has no URDF equivalent; dropped"));
    }
    lose("duration and scales: URDF has no room for them");
  }

  const Scenario& scenario_;
  BodyTree tree_;
  std::vector<std::string> losses_;
  tinyxml2::XMLDocument document_;
  Xml* root_ = nullptr;
};

}  // namespace

ExportedWorld to_urdf(const Scenario& scenario) { return UrdfWriter(scenario).write(); }

}  // namespace plumbline
