#include "mjcf_reader.hpp"

#include "compiled_model.hpp"
#include "mjcf_contacts.hpp"

namespace plumbline {
namespace {

class MjcfReader {
 public:
  explicit MjcfReader(const ImportRequest& request)
      : model_(request, draft_.notes), m_(model_.m()), d_(model_.d()), link_of_(static_cast<std::size_t>(m_.nbody)) {}

  WorldDraft read() {
    draft_.format = "MJCF";
    draft_.title = m_.names;  // the first name is the model's
    draft_.gravity = (m_.opt.disableflags & mjDSBL_GRAVITY) != 0 ? Vec3(Vec3::Zero()) : model_.vec(m_.opt.gravity, 0);
    draft_.step = m_.opt.timestep;
    for (int b = 0; b < m_.nbody; ++b) add_link(b);
    for (int b = 1; b < m_.nbody; ++b) add_joints(b);
    for (int t = 0; t < m_.ntendon; ++t) add_tendon(t);
    for (int e = 0; e < m_.neq; ++e) add_equality(e);
    read_fields();
    add_contacts(model_, link_of_, restitution_, draft_);
    list_the_rest();
    return std::move(draft_);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void lose(const std::string& what) { draft_.losses.push_back(what); }
  void note(const std::string& what) { draft_.notes.push_back(what); }
  bool still(int body) const { return m_.body_weldid[body] == 0; }
  std::string body_name(int b) const { return b == 0 ? "world" : model_.named(mjOBJ_BODY, b, "body"); }

  // A body without joint and mass is a part of its parent: only a place where shapes stand.
  void add_link(int b) {
    if (b > 0 && !still(b) && m_.body_jntnum[b] == 0 && m_.body_mass[b] == 0) {
      link_of_[at(b)] = link_of_[at(m_.body_parentid[b])];
    } else {
      link_of_[at(b)] = draft_.links.size();
      DraftLink link;
      link.name = body_name(b);
      link.fixed = still(b);
      link.mass = m_.body_mass[b];
      const Mat3 axes = model_.mat(d_.ximat, b);
      link.inertia_com_W = axes * model_.vec(m_.body_inertia, b).asDiagonal() * axes.transpose();
      link.com = {model_.vec(d_.xipos, b), Quat(axes).normalized()};
      if (!link.fixed) set_velocity(b, link);
      draft_.links.push_back(std::move(link));
      if (m_.body_mocapid[b] >= 0)
        note("body '" + body_name(b) + "' stands still: what moves it from outside (mocap) is not in the file");
    }
    DraftLink& link = draft_.links[link_of_[at(b)]];
    for (int g = m_.body_geomadr[b]; g >= 0 && g < m_.body_geomadr[b] + m_.body_geomnum[b]; ++g) {
      link.shapes.push_back(shape_of(g));
    }
  }

  void set_velocity(int b, DraftLink& link) {
    if (m_.body_jntnum[b] == 1 && m_.jnt_type[m_.body_jntadr[b]] == mjJNT_FREE) {
      // As the file says it, without the rounding of MuJoCo's own sums.
      const mjtNum* const v = d_.qvel + m_.jnt_dofadr[m_.body_jntadr[b]];
      link.w_W = model_.mat(d_.xmat, b) * Vec3(v[3], v[4], v[5]);
      link.v_W = Vec3(v[0], v[1], v[2]) + link.w_W.cross(link.com.p_WF - model_.vec(d_.xpos, b));
      return;
    }
    mjtNum v[6];
    mj_objectVelocity(&m_, &d_, mjOBJ_BODY, b, v, 0);
    link.w_W = Vec3(v[0], v[1], v[2]);
    link.v_W = Vec3(v[3], v[4], v[5]);
  }

  DraftShape shape_of(int g) {
    const Vec3 size = model_.vec(m_.geom_size, g);
    const Mat3 axes = model_.mat(d_.geom_xmat, g);
    DraftShape shape;
    shape.name = model_.name(mjOBJ_GEOM, g);
    shape.at = {model_.vec(d_.geom_xpos, g), Quat(axes).normalized()};
    shape.collides = may_collide(m_, g);
    switch (m_.geom_type[g]) {
      case mjGEOM_PLANE:
        shape.kind = "plane";
        shape.shape = HalfSpace{axes.col(2)};
        break;
      case mjGEOM_SPHERE:
        shape.kind = "sphere";
        shape.shape = Sphere{size.x()};
        break;
      case mjGEOM_BOX:
        shape.kind = "box";
        shape.shape = Box{2 * size};
        break;
      case mjGEOM_CYLINDER:
        shape.kind = "cylinder";
        shape.shape = Cylinder{size.x(), 2 * size.y()};
        break;
      case mjGEOM_CAPSULE:
        shape.kind = "capsule";
        break;
      case mjGEOM_ELLIPSOID:
        shape.kind = "ellipsoid";
        break;
      case mjGEOM_MESH:
        shape.kind = "mesh";
        break;
      case mjGEOM_HFIELD:
        shape.kind = "heightmap";
        break;
      default:
        shape.kind = "geom of an unknown type";
    }
    return shape;
  }

  void add_joints(int b) {
    const std::size_t link = link_of_[at(b)], parent = link_of_[at(m_.body_parentid[b])];
    const int count = m_.body_jntnum[b];
    if (still(b) || link == parent) return;
    if (count == 0) {  // welded to its parent, with mass of its own
      DraftJoint joint;
      joint.name = body_name(b) + " on " + body_name(m_.body_parentid[b]);
      joint.kind = JointKind::kFixed;
      joint.a = parent;
      joint.b = link;
      joint.anchor_W = model_.vec(d_.xpos, b);
      draft_.joints.push_back(std::move(joint));
      return;
    }
    if (count > 1) {
      lose("body '" + body_name(b) + "' hangs by " + std::to_string(count) +
           " joints in a row; in a scenario one joint ties two bodies, and all have mass: put bodies between them");
      return;
    }
    add_joint(m_.body_jntadr[b], parent, link);
  }

  void add_joint(int j, std::size_t parent, std::size_t link) {
    const int dof = m_.jnt_dofadr[j], type = m_.jnt_type[j];
    DraftJoint joint;
    joint.name = model_.named(mjOBJ_JOINT, j, "joint");
    const std::string who = "joint '" + joint.name + "'";
    if (m_.dof_armature[dof] != 0)
      lose(who + " has armature " + shortest(m_.dof_armature[dof]) + ", inertia of a rotor");
    if (m_.dof_frictionloss[dof] != 0) lose(who + " has dry friction (frictionloss)");
    joint.stiffness = m_.jnt_stiffness[j];
    joint.damping = m_.dof_damping[dof];
    if (type == mjJNT_FREE) {
      if (joint.stiffness != 0 || joint.damping != 0)
        lose(who + " has a spring or damper to the world on all six axes");
      return;
    }
    joint.a = parent;
    joint.b = link;
    joint.anchor_W = model_.vec(d_.xanchor, j);
    joint.axis_W = model_.vec(d_.xaxis, j);
    joint.kind = type == mjJNT_BALL ? JointKind::kBall : type == mjJNT_HINGE ? JointKind::kHinge : JointKind::kSlider;
    if (type == mjJNT_BALL) {
      if (m_.jnt_limited[j] != 0) lose(who + ": the range of a ball joint");
    } else {
      const double q = d_.qpos[m_.jnt_qposadr[j]];
      joint.rest = m_.qpos_spring[m_.jnt_qposadr[j]] - q;
      if (m_.jnt_limited[j] != 0) joint.range = JointRange{m_.jnt_range[2 * j] - q, m_.jnt_range[2 * j + 1] - q};
    }
    draft_.joints.push_back(std::move(joint));
  }

  // Whether the tendon goes straight from one site to another.
  bool straight(int t) const {
    const int first = m_.tendon_adr[t];
    return m_.tendon_num[t] == 2 && m_.wrap_type[first] == mjWRAP_SITE && m_.wrap_type[first + 1] == mjWRAP_SITE;
  }
  std::size_t tendon_link(int t, int end) const { return link_of_[at(m_.site_bodyid[site(t, end)])]; }
  int site(int t, int end) const { return m_.wrap_objid[m_.tendon_adr[t] + end]; }

  void add_tendon(int t) {
    const std::string who = "tendon '" + model_.named(mjOBJ_TENDON, t, "tendon") + "'";
    if (m_.tendon_limited[t] != 0) lose(who + ": its limits of length");
    if (m_.tendon_frictionloss[t] != 0) lose(who + ": its dry friction");
    if (m_.tendon_stiffness[t] == 0 && m_.tendon_damping[t] == 0) return;
    if (!straight(t)) return lose(who + ": its spring; only one straight from site to site is a spring of a scenario");
    DraftSpring spring;
    spring.name = model_.named(mjOBJ_TENDON, t, "tendon");
    spring.a = tendon_link(t, 0);
    spring.b = tendon_link(t, 1);
    spring.end_a_W = model_.vec(d_.site_xpos, site(t, 0));
    spring.end_b_W = model_.vec(d_.site_xpos, site(t, 1));
    spring.stiffness = m_.tendon_stiffness[t];
    spring.damping = m_.tendon_damping[t];
    spring.length = m_.tendon_lengthspring[t];
    draft_.springs.push_back(std::move(spring));
  }

  void add_equality(int e) {
    DraftJoint joint;
    joint.name = model_.named(mjOBJ_EQUALITY, e, "equality");
    const std::string who = "equality '" + joint.name + "'";
    if (m_.eq_active[e] == 0) return note(who + " is switched off");
    const int first = m_.eq_obj1id[e], second = m_.eq_obj2id[e];
    const mjtNum* const data = m_.eq_data + mjNEQDATA * e;
    const auto in_world = [&](int b, const mjtNum* p) {
      return Vec3(model_.vec(d_.xpos, b) + model_.mat(d_.xmat, b) * Vec3(p[0], p[1], p[2]));
    };
    switch (m_.eq_type[e]) {
      case mjEQ_CONNECT: {
        joint.kind = JointKind::kBall;
        joint.anchor_W = in_world(first, data);
        const double gap = (in_world(second, data + 3) - joint.anchor_W).norm();
        if (gap > 1e-6) lose(who + ": its points are " + shortest(gap) + " m apart at the start");
        break;
      }
      case mjEQ_WELD:
        joint.kind = JointKind::kFixed;
        joint.anchor_W = model_.vec(d_.xpos, first);
        break;
      case mjEQ_TENDON: {
        // Without a second tendon only the first coefficient counts: what the length is off from the model's own.
        const bool keeps_length = second < 0 && data[0] == 0;
        if (!keeps_length || !straight(first)) return lose(who + " couples lengths of tendons");
        joint.kind = JointKind::kDistance;
        joint.a = tendon_link(first, 0);
        joint.b = tendon_link(first, 1);
        joint.anchor_W = model_.vec(d_.site_xpos, site(first, 0));
        joint.end_b_W = model_.vec(d_.site_xpos, site(first, 1));
        draft_.joints.push_back(std::move(joint));
        return;
      }
      default:
        return lose(who + " couples joints");
    }
    joint.a = link_of_[at(second)];
    joint.b = link_of_[at(first)];
    draft_.joints.push_back(std::move(joint));
  }

  void read_fields() {
    if (const mjtNum* d = model_.field("plumbline_duration", 1)) draft_.duration = d[0];
    if (const mjtNum* s = model_.field("plumbline_scales", 3)) draft_.scales = Scales{s[0], s[1], s[2]};
    if (const mjtNum* e = model_.field("plumbline_restitution", 1)) restitution_ = e[0];
  }

  void list_the_rest() {
    const mjOption& o = m_.opt;
    if (o.density != 0 || o.viscosity != 0) lose("the air or water around (density, viscosity)");
    for (int a = 0; a < m_.nu; ++a) {
      const std::string who = "actuator '" + model_.named(mjOBJ_ACTUATOR, a, "actuator") + "'";
      if (m_.actuator_biastype[a] == mjBIAS_NONE && m_.actuator_dyntype[a] == mjDYN_NONE) {
        note(who + " is left out: a motor without control does nothing");
      } else {
        lose(who + ": servos and muscles push by themselves; state a spring or a drive in its place");
      }
    }
    if (m_.nskin > 0) note(std::to_string(m_.nskin) + " skins are left out: they are only drawn");
    if (m_.nsensor > 0) note(std::to_string(m_.nsensor) + " sensors are left out");
  }

  WorldDraft draft_;
  CompiledModel model_;
  const mjModel& m_;
  const mjData& d_;
  std::vector<std::size_t> link_of_;  // of each body of MuJoCo
  double restitution_ = 0;
};

}  // namespace

WorldDraft read_mjcf(const ImportRequest& request) { return MjcfReader(request).read(); }

}  // namespace plumbline
