// The model is written as MJCF, MuJoCo's own format, in memory: this version has no other door.
#include "mujoco_model.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace plumbline {
namespace {

constexpr const char* kFile = "scenario.xml";
// Room for contacts: this version drops what exceeds it. Eight a pair is the most, between two boxes; of many bodies
// not all touch at once. A full list ends the run.
constexpr std::size_t kContactsPerPair = 8;
constexpr std::size_t kContactsPerMovingBody = 16;
constexpr std::size_t kRowsPerMovingBody = 6;  // of no constraint: the stack is sized by the rows, too small for few
constexpr std::size_t kRowsPerLeftOver = 6;    // of a joint that closes a loop
constexpr double kSecondPointOfHinge = 1;      // [m]

std::string attribute(const char* name, std::initializer_list<double> numbers) {
  std::string text;
  for (double x : numbers) text += (text.empty() ? "" : " ") + shortest(x);
  return std::string(" ") + name + "=\"" + text + "\"";
}
std::string attribute(const char* name, const std::string& text) {
  return std::string(" ") + name + "=\"" + text + "\"";
}
std::string attribute(const char* name, const Vec3& v) { return attribute(name, {v.x(), v.y(), v.z()}); }
std::string attribute(const char* name, const Quat& q) { return attribute(name, {q.w(), q.x(), q.y(), q.z()}); }

// In contact with nothing of its own accord: pairs are listed.
std::string geom(const Body& body, std::size_t i) {
  std::string text = "<geom contype=\"0\" conaffinity=\"0\"" + attribute("name", mujoco_name(i));
  if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
    text += " type=\"sphere\"" + attribute("size", {sphere->radius});
  } else if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
    text += " type=\"cylinder\"" + attribute("size", {cylinder->radius, 0.5 * cylinder->height});
  } else if (const auto* box = std::get_if<Box>(&body.shape)) {
    text += " type=\"box\"" + attribute("size", Vec3(0.5 * box->size));
  } else {
    text += " type=\"plane\" size=\"0 0 1\"" + attribute("zaxis", std::get<HalfSpace>(body.shape).normal);
    return text + attribute("pos", body.initial.p_WB) + "/>";
  }
  if (body.fixed) text += attribute("pos", body.initial.p_WB) + attribute("quat", body.initial.q_WB);
  return text + "/>";
}

// What bounds and pulls the coordinate of a hinge or slider.
std::string on_coordinate(const Scenario& scenario, const TreeLink& link) {
  std::string text;
  if (const auto& range = link.joint->range) {
    text += " limited=\"true\"" + attribute("range", {range->low, range->high});
  }
  if (const auto spring = spring_on(scenario, link)) {
    text += attribute("stiffness", {spring->stiffness}) + attribute("damping", {spring->damping}) +
            attribute("springref", {spring->rest});
  }
  return text;
}

std::string joint(const Scenario& scenario, const TreeLink& link) {
  if (!link.joint) return "<freejoint" + attribute("name", mujoco_name(link.body)) + "/>";
  const char* type = nullptr;
  switch (link.joint->kind) {
    case JointKind::kBall:
      type = "ball";
      break;
    case JointKind::kHinge:
      type = "hinge";
      break;
    case JointKind::kSlider:
      type = "slide";
      break;
    case JointKind::kFixed:  // a body without a joint is part of its parent
    case JointKind::kDistance:
      return "";
  }
  return "<joint" + attribute("name", mujoco_name(link.body)) + attribute("type", type) +
         attribute("pos", link.joint->on_b.anchor) + attribute("axis", link.joint->on_b.axis()) +
         on_coordinate(scenario, link) + "/>";
}

// An end of rod "s0", spring "p0", ...
std::string site(const std::string& line, char end, const Vec3& anchor) {
  return "<site" + attribute("name", line + end) + attribute("pos", anchor) + "/>";
}

std::string tendon(const std::string& line, const std::string& attributes) {
  return "<spatial" + attribute("name", line) + attributes + "><site" + attribute("site", line + "a") + "/><site" +
         attribute("site", line + "b") + "/></spatial>";
}

class ModelText {
 public:
  ModelText(const Scenario& scenario, const JointTree& tree) : scenario_(scenario), tree_(tree) {}

  std::string write() {
    const std::string bodies = children_of(kWorld);
    const std::string pairs = contact_pairs(), ties = left_over();
    for (std::size_t k = 0; k < scenario_.springs.size(); ++k) {
      const Spring& s = scenario_.springs[k];
      tendons_ +=
          tendon("p" + std::to_string(k), attribute("stiffness", {s.stiffness}) + attribute("damping", {s.damping}) +
                                              attribute("springlength", {s.length}));
    }
    if (!tendons_.empty()) tendons_ = "<tendon>" + tendons_ + "</tendon>";
    return "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\" balanceinertia=\"false\" boundmass=\"0\" "
           "boundinertia=\"0\"/>" +
           size() + "<worldbody>" + bodies + "</worldbody><contact>" + pairs + "</contact>" + tendons_ + ties +
           "</mujoco>";
  }

 private:
  // What stands on that body: its ends of rods and springs, and every body that hangs from it.
  std::string children_of(std::size_t parent) {
    std::string text;
    for (std::size_t k : tree_.left_over) {
      const Joint& j = scenario_.joints[k];
      if (j.kind != JointKind::kDistance) continue;
      if (j.a == parent) text += site("s" + std::to_string(k), 'a', j.on_a.anchor);
      if (j.b == parent) text += site("s" + std::to_string(k), 'b', j.on_b.anchor);
    }
    for (std::size_t k = 0; k < scenario_.springs.size(); ++k) {
      const Spring& s = scenario_.springs[k];
      if (s.a == parent) text += site("p" + std::to_string(k), 'a', s.on_a);
      if (s.b == parent) text += site("p" + std::to_string(k), 'b', s.on_b);
    }
    if (parent == kWorld) {
      for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
        if (scenario_.bodies[i].fixed) text += geom(scenario_.bodies[i], i);
      }
    }
    for (const TreeLink& link : tree_.links) {
      if ((link.joint ? link.joint->a : kWorld) != parent) continue;
      const Body& body = scenario_.bodies[link.body];
      const BodyState from = initial_state_of(scenario_, parent), &to = body.initial;
      text += "<body" + attribute("name", mujoco_name(link.body)) +
              attribute("pos", from.q_WB.conjugate() * (to.p_WB - from.p_WB)) +
              attribute("quat", from.q_WB.conjugate() * to.q_WB) + "><inertial pos=\"0 0 0\"" +
              attribute("mass", {body.mass}) + attribute("diaginertia", body.inertia) + "/>" + joint(scenario_, link) +
              geom(body, link.body) + children_of(link.body) + "</body>";
    }
    return text;
  }

  // Every pair that may touch, so that no rule combines coefficients. Without friction one direction is enough.
  std::string contact_pairs() {
    std::string text;
    if (!scenario_.contact) return text;
    const double mu = scenario_.contact->friction;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if ((scenario_.bodies[i].fixed && scenario_.bodies[j].fixed) || joined(scenario_, i, j)) continue;
        text += "<pair" + attribute("geom1", mujoco_name(j)) + attribute("geom2", mujoco_name(i)) +
                attribute("condim", mu > 0 ? "3" : "1") + attribute("friction", {mu, mu, 0, 0, 0}) + "/>";
        ++pairs_;
      }
    }
    return text;
  }

  // Joints that close a loop, and rods: equality constraints. All hold in the starting pose, which is what MuJoCo takes
  // their targets from.
  std::string left_over() {
    std::string text;
    for (std::size_t k : tree_.left_over) {
      const Joint& j = scenario_.joints[k];
      const std::string bodies =
          attribute("body1", mujoco_name(j.b)) + (j.a == kWorld ? std::string() : attribute("body2", mujoco_name(j.a)));
      const auto connect = [&](const Vec3& at) { return "<connect" + bodies + attribute("anchor", at) + "/>"; };
      const std::string name = "s" + std::to_string(k);
      switch (j.kind) {
        case JointKind::kBall:
          text += connect(j.on_b.anchor);
          break;
        case JointKind::kHinge:
          text += connect(j.on_b.anchor) + connect(j.on_b.anchor + kSecondPointOfHinge * j.on_b.axis());
          break;
        case JointKind::kFixed:
          text += "<weld" + bodies + "/>";
          break;
        case JointKind::kDistance:
          tendons_ += tendon(name, "");
          text += "<tendon" + attribute("tendon1", name) + "/>";
          break;
        case JointKind::kSlider:
          throw std::invalid_argument("slider '" + j.name +
                                      "' closes a loop, which MuJoCo has no constraint for: state it before the loop's "
                                      "other joints");
      }
    }
    return "<equality>" + text + "</equality>";
  }

  std::string size() const {
    const std::size_t contacts = std::min(kContactsPerPair * pairs_, kContactsPerMovingBody * tree_.links.size());
    const std::size_t per_contact = scenario_.contact && scenario_.contact->friction > 0 ? 4 : 1;  // pyramid: 4
    const std::size_t rows =
        per_contact * contacts + kRowsPerLeftOver * tree_.left_over.size() + kRowsPerMovingBody * tree_.links.size();
    return "<size nconmax=\"" + std::to_string(contacts) + "\" njmax=\"" + std::to_string(rows) + "\"/>";
  }

  const Scenario& scenario_;
  const JointTree& tree_;
  std::size_t pairs_ = 0;
  std::string tendons_;
};

}  // namespace

std::string mujoco_name(std::size_t body) { return "b" + std::to_string(body); }

MujocoModel mujoco_model(const Scenario& scenario, const JointTree& tree) {
  require_coordinates(scenario, tree);
  const std::string text = ModelText(scenario, tree).write();
  const auto files = std::make_unique<mjVFS>();  // megabytes: not on the stack
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), kFile, static_cast<int>(text.size())) != 0) {
    throw std::invalid_argument("the scenario is too large for MuJoCo's reader of models");
  }
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kFile)], text.data(), text.size());
  std::array<char, 1000> fault{};
  MujocoModel model(mj_loadXML(kFile, files.get(), fault.data(), static_cast<int>(fault.size())));
  mj_deleteVFS(files.get());
  if (!model) throw std::invalid_argument(std::string("MuJoCo refuses the model: ") + fault.data());
  return model;
}

}  // namespace plumbline
