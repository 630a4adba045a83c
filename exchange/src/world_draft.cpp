#include "plumbline/exchange/world_draft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body_draft.hpp"

namespace plumbline {
namespace {

constexpr std::size_t kNamed = 10;  // of a kind: a cloth has thousands of pairs

class Assembly {
 public:
  explicit Assembly(const WorldDraft& draft) : draft_(draft) {
    world_.losses = draft.losses;
    world_.notes = draft.notes;
  }

  ImportedWorld assemble() {
    Scenario& s = world_.scenario;
    s.gravity = draft_.gravity;
    add_bodies();
    for (const DraftJoint& joint : draft_.joints) add_joint(joint);
    for (const DraftSpring& spring : draft_.springs) add_spring(spring);
    add_contact();
    set_scales();
    s.duration = draft_.duration.value_or(1);
    s.t_valid = s.duration;
    if (draft_.step && *draft_.step <= s.duration) s.steps = {*draft_.step};
    return std::move(world_);
  }

 private:
  void add_bodies() {
    NameList names;
    for (const DraftLink& link : draft_.links) {
      places_.emplace_back();
      for (Body& body : bodies_of(link, !draft_.contacts.empty(), names, world_)) {
        places_.back().push_back(world_.scenario.bodies.size());
        states_.push_back(body.initial);
        world_.scenario.bodies.push_back(std::move(body));
      }
    }
  }

  // The moving body of a link, kWorld for what stands still, none for a link that was lost.
  std::optional<std::size_t> end_of(std::size_t link) const {
    if (link == kWorld || draft_.links[link].fixed) return kWorld;
    if (places_[link].empty()) return std::nullopt;
    return places_[link].front();
  }

  void add_joint(const DraftJoint& draft) {
    const auto lose = [&](const std::string& what) { world_.losses.push_back("joint '" + draft.name + "'" + what); };
    auto a = end_of(draft.a), b = end_of(draft.b);
    if (!a || !b) return lose(": one of its links was left out");
    if (*a == kWorld && *b == kWorld) {
      world_.notes.push_back("joint '" + draft.name + "' ties what stands still to what stands still: left out");
      return;
    }
    const bool turned = *b == kWorld;  // a scenario's joint has the world on its first side
    if (turned) std::swap(a, b);
    Joint joint;
    if (draft.kind == JointKind::kDistance) {
      const Vec3 &first = turned ? draft.end_b_W : draft.anchor_W, &second = turned ? draft.anchor_W : draft.end_b_W;
      if (!((second - first).norm() > 0)) return lose(": its rod has no length; a ball joint would say the same");
      joint = rod_between(*a, *b, states_, first, second);
    } else {
      joint = joint_at(draft.kind, *a, *b, states_, draft.anchor_W, draft.axis_W);
    }
    joint.name = joint_names_.take(draft.name);
    if (draft.range) joint.range = turned ? JointRange{-draft.range->high, -draft.range->low} : *draft.range;
    if (joint.range && !usable(joint)) {
      lose(": its range [" + shortest(joint.range->low) + ", " + shortest(joint.range->high) +
           "], counted from the start, is none that a scenario can have: it must hold 0, and of a hinge lie within "
           "(-pi, pi)");
      joint.range.reset();
    }
    if (draft.stiffness != 0 || draft.damping != 0) {
      if (joint.kind == JointKind::kHinge || joint.kind == JointKind::kSlider) {
        world_.scenario.joint_springs.push_back(
            {world_.scenario.joints.size(), draft.stiffness, draft.damping, turned ? -draft.rest : draft.rest});
      } else {
        lose(": a " + std::string(joint_name(joint.kind)) + " joint has no spring or damper; left out");
      }
    }
    world_.scenario.joints.push_back(std::move(joint));
  }

  static bool usable(const Joint& joint) {
    const JointRange& r = *joint.range;
    if (joint.kind != JointKind::kHinge && joint.kind != JointKind::kSlider) return false;
    if (!(std::isfinite(r.low) && std::isfinite(r.high) && r.low <= 0 && r.high >= 0 && r.low < r.high)) return false;
    return joint.kind == JointKind::kSlider || (r.low > -std::numbers::pi && r.high < std::numbers::pi);
  }

  void add_spring(const DraftSpring& draft) {
    auto a = end_of(draft.a), b = end_of(draft.b);
    Vec3 first = draft.end_a_W, second = draft.end_b_W;
    if (!a || !b || *a == *b) {
      world_.losses.push_back("spring '" + draft.name + "': its ends are on one body, or on one that was left out");
      return;
    }
    if (*b == kWorld) {
      std::swap(a, b);
      std::swap(first, second);
    }
    const auto local = [&](std::size_t body, const Vec3& point) -> Vec3 {
      if (body == kWorld) return point;
      return states_[body].q_WB.conjugate() * (point - states_[body].p_WB);
    };
    world_.scenario.springs.push_back(
        {draft.name, *a, *b, local(*a, first), local(*b, second), draft.stiffness, draft.damping, draft.length});
  }

  // One law for all pairs, and all pairs but those that joints tie.
  void add_contact() {
    if (draft_.contacts.empty()) return;
    const ContactMaterial& law = draft_.contacts.front().material;
    world_.scenario.contact = law;
    if (!(law.friction >= 0 && law.restitution >= 0 && law.restitution <= 1)) {
      world_.losses.push_back("contact law out of range: friction " + shortest(law.friction) + ", restitution " +
                              shortest(law.restitution));
      world_.scenario.contact = ContactMaterial{};
    }
    std::vector<std::vector<bool>> collide(draft_.links.size(), std::vector<bool>(draft_.links.size(), false));
    std::vector<std::string> laws, pairs;
    for (const DraftContact& c : draft_.contacts) {
      collide[c.a][c.b] = collide[c.b][c.a] = true;
      if (c.material.friction == law.friction && c.material.restitution == law.restitution) continue;
      laws.push_back("contact of '" + draft_.links[c.a].name + "' with '" + draft_.links[c.b].name + "' has friction " +
                     shortest(c.material.friction) + " and restitution " + shortest(c.material.restitution) +
                     "; a scenario has one law for all pairs, here " + shortest(law.friction) + " and " +
                     shortest(law.restitution));
    }
    for (std::size_t i = 0; i < draft_.links.size(); ++i) {
      for (std::size_t j = i + 1; j < draft_.links.size(); ++j) {
        std::string difference = pair_difference(i, j, collide[i][j]);
        if (!difference.empty()) pairs.push_back(std::move(difference));
      }
    }
    lose_some(laws);
    lose_some(pairs);
  }
  void lose_some(const std::vector<std::string>& all) {
    for (std::size_t i = 0; i < std::min(all.size(), kNamed); ++i) world_.losses.push_back(all[i]);
    if (all.size() > kNamed) {
      world_.losses.push_back("and of " + std::to_string(all.size() - kNamed) + " further pairs the same can be said");
    }
  }

  // Where the file and a scenario differ about this pair; empty where they agree.
  std::string pair_difference(std::size_t i, std::size_t j, bool in_file) const {
    const DraftLink &a = draft_.links[i], &b = draft_.links[j];
    if ((a.fixed && b.fixed) || places_[i].empty() || places_[j].empty()) return "";
    const bool here = !joined(world_.scenario, places_[i].front(), places_[j].front());
    if (here == in_file) return "";
    return "'" + a.name + "' and '" + b.name + "' " +
           (in_file ? "collide although a joint ties them, which they do not in a scenario"
                    : "do not collide in the file; in a scenario all bodies do that no joint ties");
  }

  void set_scales() {
    Scenario& s = world_.scenario;
    if (draft_.scales) {
      s.scales = *draft_.scales;
      return;
    }
    double mass = 0, speed = 0;
    Eigen::AlignedBox3d places;
    for (const Body& body : s.bodies) {
      if (body.fixed) continue;
      mass += body.mass;
      speed = std::max(speed, body.initial.v_WB.norm());
      places.extend(body.initial.p_WB);
    }
    for (const Joint& joint : s.joints) {
      if (joint.a == kWorld) places.extend(joint.on_a.anchor);
    }
    double length = places.isEmpty() ? 1 : places.diagonal().norm();
    for (const Body& body : s.bodies) {
      if (!body.fixed) length = std::max(length, std::sqrt(body.inertia.sum() / body.mass));
    }
    s.scales.length = length > 0 ? length : 1;
    s.scales.mass = mass > 0 ? mass : 1;
    const double fall = std::sqrt(s.gravity.norm() * s.scales.length);
    const double velocity = std::max(fall, speed);
    s.scales.time = velocity > 0 ? s.scales.length / velocity : 1;
  }

  const WorldDraft& draft_;
  ImportedWorld world_;
  NameList joint_names_;
  std::vector<std::vector<std::size_t>> places_;  // of each link: its bodies
  std::vector<BodyState> states_;
};

}  // namespace

ImportedWorld assemble(const WorldDraft& draft) { return Assembly(draft).assemble(); }

}  // namespace plumbline
