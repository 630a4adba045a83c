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

toml::array array_of(std::initializer_list<double> numbers) {
  toml::array array;
  for (const double x : numbers) array.push_back(x);
  return array;
}
toml::array array_of(const Vec3& v) { return array_of({v.x(), v.y(), v.z()}); }

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
  // toml++ sorts keys by name; a line each keeps the order that people read in.
  template <typename Value>
  void line(const char* key, Value&& value) {
    const toml::table table{{key, std::forward<Value>(value)}};
    out_ << toml::toml_formatter{table, toml::format_flags::allow_literal_strings} << '\n';
  }
  void header(const std::string& text) { out_ << '\n' << text << '\n'; }

  void add_comment(const std::string& comment) {
    std::string safe;
    for (const char c : comment) safe += c == '\n' ? ' ' : static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    out_ << "# " << safe << '\n';
  }

  void add_head() {
    line("id", scenario_.id);
    line("about", scenario_.about);
    line("source", scenario_.source);
    line("duration", scenario_.duration);
    line("gravity", array_of(scenario_.gravity));
    if (!scenario_.steps.empty()) {
      toml::array steps;
      for (const double dt : scenario_.steps) steps.push_back(dt);
      line("steps", std::move(steps));
    }
    header("[scales]");
    line("length", scenario_.scales.length);
    line("time", scenario_.scales.time);
    line("mass", scenario_.scales.mass);
    if (scenario_.contact) {
      header("[contact]");
      line("restitution", scenario_.contact->restitution);
      line("friction", scenario_.contact->friction);
    }
  }

  static toml::table shape_table(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return toml::table{{"sphere", sphere->radius}};
    if (const auto* box = std::get_if<Box>(&shape)) return toml::table{{"box", array_of(box->size)}};
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      return toml::table{{"cylinder", array_of({cylinder->radius, cylinder->height})}};
    }
    return toml::table{{"half_space", array_of(std::get<HalfSpace>(shape).normal)}};
  }

  void add_body(const Body& body) {
    const BodyState& s = body.initial;
    const bool plane = std::holds_alternative<HalfSpace>(body.shape);
    header("[[body]]");
    line("name", body.name);
    toml::table shape = shape_table(body.shape);
    shape.is_inline(true);
    line("shape", std::move(shape));
    if (body.fixed && !plane) line("fixed", true);
    if (!body.fixed) {
      line("mass", body.mass);
      line("inertia", array_of(body.inertia));
    }
    if (!s.p_WB.isZero(0)) line("position", array_of(s.p_WB));
    if (!plane && !s.q_WB.vec().isZero(0)) line("attitude", array_of({s.q_WB.w(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z()}));
    if (!body.fixed && !s.v_WB.isZero(0)) line("velocity", array_of(s.v_WB));
    if (!body.fixed && !s.w_WB.isZero(0)) line("angular_velocity", array_of(s.w_WB));
  }

  const std::string& name_of(std::size_t body) const {
    static const std::string kWorldName = "world";
    return body == kWorld ? kWorldName : scenario_.bodies[body].name;
  }
  Vec3 in_world(std::size_t body, const Vec3& point) const {
    if (body == kWorld) return point;
    const BodyState& s = scenario_.bodies[body].initial;
    return s.p_WB + s.q_WB * point;
  }
  toml::array pair(std::size_t a, std::size_t b) const {
    toml::array array;
    array.push_back(name_of(a));
    array.push_back(name_of(b));
    return array;
  }
  static toml::array points(const Vec3& a, const Vec3& b) {
    toml::array array;
    array.push_back(array_of(a));
    array.push_back(array_of(b));
    return array;
  }

  void add_joint(std::size_t k) {
    const Joint& j = scenario_.joints[k];
    header("[[joint]]");
    line("name", j.name);
    line("kind", std::string(joint_name(j.kind)));
    line("between", pair(j.a, j.b));
    if (j.kind == JointKind::kDistance) {
      line("anchors", points(in_world(j.a, j.on_a.anchor), in_world(j.b, j.on_b.anchor)));
    } else {
      line("anchor", array_of(in_world(j.b, j.on_b.anchor)));
    }
    if (j.kind == JointKind::kHinge || j.kind == JointKind::kSlider) {
      line("axis", array_of(Vec3(scenario_.bodies[j.b].initial.q_WB * j.on_b.axis())));
      if (j.range) line("range", array_of({j.range->low, j.range->high}));
    }
    for (const JointSpring& spring : scenario_.joint_springs) {
      if (spring.joint != k) continue;
      line("stiffness", spring.stiffness);
      line("damping", spring.damping);
      line("rest", spring.rest);
    }
  }

  void add_spring(const Spring& spring) {
    header("[[spring]]");
    line("name", spring.name);
    line("between", pair(spring.a, spring.b));
    line("anchors", points(in_world(spring.a, spring.on_a), in_world(spring.b, spring.on_b)));
    line("stiffness", spring.stiffness);
    line("damping", spring.damping);
    line("length", spring.length);
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
    line("metric", std::string(metric));
    line("limit", std::string(limit));
    line("reason", std::string(reason));
  }
  void add_truth() {
    header("[reference]");
    line("kind", std::string("invariants"));
    line("citation", std::string("mechanics: the motion itself is not known"));
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
