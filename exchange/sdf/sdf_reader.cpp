#include "sdf_reader.hpp"

#include <cmath>
#include <map>

#include "sdf_file.hpp"
#include "sdf_links.hpp"

namespace plumbline {
namespace {

constexpr double kUnlimited = 1e15;  // SDF writes 1e16 where there is no limit
constexpr double kSamePlace = 1e-9;  // [m]

bool has_no_limits(const sdf::JointAxis& axis) { return axis.Lower() <= -kUnlimited && axis.Upper() >= kUnlimited; }

class SdfReader {
 public:
  explicit SdfReader(const ImportRequest& request) : file_(load_sdf(request, draft_)) {}

  WorldDraft read() {
    if (file_.root.WorldCount() > 0) {
      read_world(*file_.root.WorldByIndex(0));
      if (file_.root.WorldCount() > 1) draft_.losses.emplace_back("further worlds in the file: only the first is read");
    } else {
      draft_.title = file_.root.Model()->Name();
      draft_.gravity = Vec3(0, 0, -9.8);
      draft_.notes.emplace_back("a model without a world: gravity is SDF's default, 9.8 m/s^2 downwards");
      add_model(*file_.root.Model(), {}, "", false, 0);
    }
    name_links();
    add_sdf_contacts(links_, draft_);
    return std::move(draft_);
  }

 private:
  void read_world(const sdf::World& world) {
    draft_.title = world.Name();
    draft_.gravity = vec(world.Gravity());
    if (const sdf::Physics* physics = world.PhysicsDefault()) draft_.step = physics->MaxStepSize();
    read_fields(*world.Element());
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) add_model(*world.ModelByIndex(i), {}, "", false, i);
    if (world.ActorCount() > 0)
      draft_.losses.push_back(std::to_string(world.ActorCount()) + " actors, which move by a script");
    if (world.LightCount() > 0) draft_.notes.push_back(std::to_string(world.LightCount()) + " lights are left out");
    note_plugins(*world.Element(), "the world");
    for (const auto& [name, recorded] : file_.recorded) {
      if (!recorded_used_.contains(name)) draft_.losses.push_back("state of '" + name + "': there is no such link");
    }
  }

  void read_fields(sdf::Element& world) {
    const auto numbers = [&](const char* name) {
      std::vector<double> values;
      if (world.HasElement(name)) {
        std::istringstream text(world.GetElement(name)->Get<std::string>());
        for (double x = 0; text >> x;) values.push_back(x);
      }
      return values;
    };
    if (const auto d = numbers("plumbline:duration"); d.size() == 1) draft_.duration = d[0];
    if (const auto s = numbers("plumbline:scales"); s.size() == 3) draft_.scales = Scales{s[0], s[1], s[2]};
  }

  void note_plugins(sdf::Element& element, const std::string& whose) {
    if (!element.HasElement("plugin")) return;
    for (auto plugin = element.GetElement("plugin"); plugin; plugin = plugin->GetNextElement("plugin")) {
      const std::string text = "plugin '" + plugin->Get<std::string>("name") + "' of " + whose;
      if (whose == "the world") {
        draft_.notes.push_back(text + " is left out");
      } else {
        draft_.losses.push_back(text + ": what it does to the motion is not in the file");
      }
    }
  }

  void add_model(const sdf::Model& model, const PlacedFrame& parent, const std::string& scope, bool is_static,
                 std::uint64_t top) {
    const PlacedFrame frame = placed(parent, model.SemanticPose(), model.RawPose());
    const std::string own = scope + model.Name() + "::";
    const bool still = is_static || model.Static();
    const bool collides_inside = model.SelfCollide();
    if (model.EnableWind()) draft_.losses.push_back("wind on model '" + model.Name() + "'");
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      add_link(*model.LinkByIndex(i), frame, own, still, collides_inside, top);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) add_model(*model.ModelByIndex(i), frame, own, still, top);
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) add_joint(*model.JointByIndex(i), frame, own);
    note_plugins(*model.Element(), "model '" + model.Name() + "'");
  }

  void add_link(const sdf::Link& link, const PlacedFrame& model, const std::string& scope, bool still,
                bool collides_inside, std::uint64_t top) {
    SdfLink result = read_link(link, model, still, draft_);
    result.path = scope + link.Name();
    result.model = top;
    result.collides_inside = collides_inside;
    if (const auto recorded = file_.recorded.find(result.path); recorded != file_.recorded.end()) {
      recorded_used_[result.path] = true;
      DraftLink& draft = draft_.links.back();
      const Vec3 arm = draft.com.p_WF - result.frame.p_WF;
      draft.w_W = recorded->second.w_W;
      draft.v_W = recorded->second.v_W + draft.w_W.cross(arm);
      const auto& place = recorded->second.place;
      if (place && (*place - result.frame.p_WF).norm() > kSamePlace) {
        draft_.losses.push_back("state of '" + result.path + "': it puts the link elsewhere than its model does");
      }
    }
    place_of_[result.path] = links_.size();
    links_.push_back(std::move(result));
  }

  std::optional<std::size_t> link_at(const std::string& scope, const std::string& name) const {
    if (name == "world") return kWorld;
    const auto found = place_of_.find(scope + name);
    if (found == place_of_.end()) return std::nullopt;
    return found->second;
  }

  static std::optional<JointKind> kind_of(sdf::JointType type) {
    switch (type) {
      case sdf::JointType::BALL:
        return JointKind::kBall;
      case sdf::JointType::CONTINUOUS:
      case sdf::JointType::REVOLUTE:
        return JointKind::kHinge;
      case sdf::JointType::PRISMATIC:
        return JointKind::kSlider;
      case sdf::JointType::FIXED:
        return JointKind::kFixed;
      default:
        return std::nullopt;
    }
  }

  void add_joint(const sdf::Joint& joint, const PlacedFrame& model, const std::string& scope) {
    const std::string who = "joint '" + joint.Name() + "'";
    const auto lose = [&](const std::string& what) { draft_.losses.push_back(who + what); };
    std::string parent, child;
    joint.ResolveParentLink(parent);
    joint.ResolveChildLink(child);
    const auto a = link_at(scope, parent), b = link_at(scope, child);
    if (!a || !b) return lose(": its links '" + parent + "' and '" + child + "' are not both there");
    for (const std::size_t end : {*a, *b}) {
      if (end != kWorld) links_[end].tied_to.push_back(end == *a ? *b : *a);
    }
    const auto kind = kind_of(joint.Type());
    if (!kind)
      return lose(": two axes in one, screws and gears have no counterpart; hinges and sliders do, one a joint");
    DraftJoint draft;
    draft.name = joint.Name();
    draft.kind = *kind;
    draft.a = *a;
    draft.b = *b;
    ignition::math::Pose3d pose;
    if (!joint.SemanticPose().Resolve(pose, "__model__").empty()) return lose(": its pose cannot be resolved");
    draft.anchor_W = model.p_WF + model.q_WF * vec(pose.Pos());
    if (const sdf::JointAxis* axis = joint.Axis(); axis != nullptr && needs_axis(*kind)) {
      ignition::math::Vector3d xyz;
      if (!axis->ResolveXyz(xyz, "__model__").empty()) return lose(": its axis cannot be resolved");
      draft.axis_W = model.q_WF * vec(xyz);
      draft.stiffness = axis->SpringStiffness();
      draft.damping = axis->Damping();
      draft.rest = axis->SpringReference();
      if (axis->Friction() != 0) lose(" has dry friction");
      if (!has_no_limits(*axis)) draft.range = JointRange{axis->Lower(), axis->Upper()};
    }
    draft_.joints.push_back(std::move(draft));
  }
  static bool needs_axis(JointKind kind) { return kind == JointKind::kHinge || kind == JointKind::kSlider; }

  // By the link's own name where no other has it.
  void name_links() {
    std::map<std::string, int> count;
    for (const DraftLink& link : draft_.links) ++count[link.name];
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (count[draft_.links[i].name] == 1) continue;
      std::string& name = draft_.links[i].name;
      name = links_[i].path;
      for (std::size_t at = name.find("::"); at != name.npos; at = name.find("::")) name.replace(at, 2, "_");
    }
  }

  WorldDraft draft_;
  SdfFile file_;
  std::vector<SdfLink> links_;  // as draft_.links
  std::map<std::string, std::size_t> place_of_;
  std::map<std::string, bool> recorded_used_;
};

}  // namespace

WorldDraft read_sdf(const ImportRequest& request) { return SdfReader(request).read(); }

}  // namespace plumbline
