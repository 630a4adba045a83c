#include "plumbline/exchange/scenario_text.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {
namespace {

// How near is a demand and not a bound: of a world that comes from elsewhere nobody has derived one.
constexpr const char* kEnergyLimit = "0.01";
constexpr const char* kEnergyReason =
    "nothing in this world takes energy away or brings some; a hundredth of the scale is a demand, not a bound: derive "
    "your own";
constexpr const char* kGapLimit = "0.001*length_scale";
constexpr const char* kGapReason =
    "joints hold; a thousandth of the world's size is a demand, not a bound: derive your own";

// toml++ writes 17 digits of every number, 0.1 as 0.10000000000000001: numbers are written here, words by it.
std::string list(std::initializer_list<std::string> items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "[" : ", ") + item;
  return text + "]";
}
std::string list(const Vec3& v) { return list({shortest(v.x()), shortest(v.y()), shortest(v.z())}); }

std::string quoted_text(const std::string& text) {
  std::ostringstream out;
  out << toml::toml_formatter{toml::value<std::string>(text), toml::format_flags::none};
  return out.str();
}

class Text {
 public:
  explicit Text(const Scenario& scenario) : scenario_(scenario) {}

  std::string write(const std::vector<std::string>& comments) {
    for (const std::string& comment : comments) add_comment(comment);
    if (!comments.empty()) out_ << '\n';
    add_head();
    for (const Body& body : scenario_.bodies) add_body(body);
    for (std::size_t k = 0; k < scenario_.joints.size(); ++k) add_joint(k);
    for (const Spring& spring : scenario_.springs) add_spring(spring);
    add_truth();
    return out_.str();
  }

 private:
  void line(const char* key, const std::string& value) { out_ << key << " = " << value << '\n'; }
  void number(const char* key, double value) { line(key, shortest(value)); }
  void words(const char* key, const std::string& value) { line(key, quoted_text(value)); }
  void header(const std::string& text) { out_ << '\n' << text << '\n'; }

  void add_comment(const std::string& comment) {
    std::string safe;
    for (const char c : comment) safe += c == '\n' ? ' ' : static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    out_ << "# " << safe << '\n';
  }

  void add_head() {
    words("id", scenario_.id);
    words("about", scenario_.about);
    words("source", scenario_.source);
    number("duration", scenario_.duration);
    line("gravity", list(scenario_.gravity));
    if (!scenario_.steps.empty()) {
      std::string steps;
      for (const double dt : scenario_.steps) steps += (steps.empty() ? "" : ", ") + shortest(dt);
      line("steps", "[" + steps + "]");
    }
    header("[scales]");
    number("length", scenario_.scales.length);
    number("time", scenario_.scales.time);
    number("mass", scenario_.scales.mass);
    if (scenario_.contact) {
      header("[contact]");
      number("restitution", scenario_.contact->restitution);
      number("friction", scenario_.contact->friction);
    }
  }

  static std::string shape_text(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return "{ sphere = " + shortest(sphere->radius) + " }";
    if (const auto* box = std::get_if<Box>(&shape)) return "{ box = " + list(box->size) + " }";
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      return "{ cylinder = " + list({shortest(cylinder->radius), shortest(cylinder->height)}) + " }";
    }
    return "{ half_space = " + list(std::get<HalfSpace>(shape).normal) + " }";
  }

  void add_body(const Body& body) {
    const BodyState& s = body.initial;
    const bool plane = std::holds_alternative<HalfSpace>(body.shape);
    header("[[body]]");
    words("name", body.name);
    line("shape", shape_text(body.shape));
    if (body.fixed && !plane) line("fixed", "true");
    if (!body.fixed) {
      number("mass", body.mass);
      line("inertia", list(body.inertia));
    }
    if (!s.p_WB.isZero(0)) line("position", list(s.p_WB));
    const Quat& q = s.q_WB;
    if (!plane && !q.vec().isZero(0)) {
      line("attitude", list({shortest(q.w()), shortest(q.x()), shortest(q.y()), shortest(q.z())}));
    }
    if (!body.fixed && !s.v_WB.isZero(0)) line("velocity", list(s.v_WB));
    if (!body.fixed && !s.w_WB.isZero(0)) line("angular_velocity", list(s.w_WB));
  }

  std::string end(std::size_t body) const {
    return quoted_text(body == kWorld ? "world" : scenario_.bodies[body].name);
  }
  Vec3 in_world(std::size_t body, const Vec3& point) const {
    if (body == kWorld) return point;
    const BodyState& s = scenario_.bodies[body].initial;
    return s.p_WB + s.q_WB * point;
  }

  void add_joint(std::size_t k) {
    const Joint& j = scenario_.joints[k];
    header("[[joint]]");
    words("name", j.name);
    words("kind", std::string(joint_name(j.kind)));
    line("between", list({end(j.a), end(j.b)}));
    if (j.kind == JointKind::kDistance) {
      line("anchors", list({list(in_world(j.a, j.on_a.anchor)), list(in_world(j.b, j.on_b.anchor))}));
    } else {
      line("anchor", list(in_world(j.b, j.on_b.anchor)));
    }
    if (j.kind == JointKind::kHinge || j.kind == JointKind::kSlider) {
      line("axis", list(Vec3(scenario_.bodies[j.b].initial.q_WB * j.on_b.axis())));
      if (j.range) line("range", list({shortest(j.range->low), shortest(j.range->high)}));
    }
    for (const JointSpring& spring : scenario_.joint_springs) {
      if (spring.joint != k) continue;
      number("stiffness", spring.stiffness);
      number("damping", spring.damping);
      number("rest", spring.rest);
    }
  }

  void add_spring(const Spring& spring) {
    header("[[spring]]");
    words("name", spring.name);
    line("between", list({end(spring.a), end(spring.b)}));
    line("anchors", list({list(in_world(spring.a, spring.on_a)), list(in_world(spring.b, spring.on_b))}));
    number("stiffness", spring.stiffness);
    number("damping", spring.damping);
    number("length", spring.length);
  }

  bool keeps_energy() const {
    if (scenario_.contact && (scenario_.contact->restitution < 1 || scenario_.contact->friction > 0)) return false;
    const auto damped = [](const auto& spring) { return spring.damping > 0; };
    // A stop is plastic.
    const auto stopped = [](const Joint& joint) { return joint.range.has_value(); };
    return std::none_of(scenario_.springs.begin(), scenario_.springs.end(), damped) &&
           std::none_of(scenario_.joint_springs.begin(), scenario_.joint_springs.end(), damped) &&
           std::none_of(scenario_.joints.begin(), scenario_.joints.end(), stopped);
  }

  void add_gate(const char* metric, const char* limit, const char* reason) {
    header("[[gate]]");
    words("metric", std::string(metric));
    words("limit", std::string(limit));
    words("reason", std::string(reason));
  }
  void add_truth() {
    header("[reference]");
    words("kind", std::string("invariants"));
    words("citation", std::string("mechanics: the motion itself is not known"));
    if (keeps_energy()) add_gate("energy.max", kEnergyLimit, kEnergyReason);
    if (!scenario_.joints.empty()) add_gate("joint_gap.max", kGapLimit, kGapReason);
  }

  const Scenario& scenario_;
  std::ostringstream out_;
};

}  // namespace

std::string scenario_text(const Scenario& scenario, const std::vector<std::string>& comments) {
  return Text(scenario).write(comments);
}

}  // namespace plumbline
