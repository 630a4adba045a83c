#include <fmt/format.h>

#include <algorithm>

#include "expression.hpp"
#include "scene.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

// The expressions of one [[force]] and the variables that they read. It stays where it is: they point into it.
struct CompiledForce {
  std::array<double, kForceSymbols.size()> slots{};
  std::vector<Expression> force, torque;  // three each; torque may be empty
  Vec3 at_B = Vec3::Zero();

  Wrench evaluate(double t, const BodyState& state) {
    const auto components = components_of(state);
    slots[0] = t;
    std::copy(components.begin(), components.end(), slots.begin() + 1);
    Wrench wrench;
    wrench.f_W = {force[0](), force[1](), force[2]()};
    if (!torque.empty()) wrench.tau_W = {torque[0](), torque[1](), torque[2]()};
    if (!at_B.isZero(0)) wrench.tau_W += (state.q_WB * at_B).cross(wrench.f_W);
    return wrench;
  }

  // What ForceLaw::couples_out_of_plane promises: in doubt it says yes.
  bool couples_out_of_plane() const {
    const auto reads_other_motion = [](const Expression& e) { return e.uses({"y", "vy", "qx", "qz", "wx", "wz"}); };
    if (reads_other_motion(force[0]) || reads_other_motion(force[2])) return true;
    if (!torque.empty() && (reads_other_motion(torque[1]) || !torque[0].is_zero() || !torque[2].is_zero())) return true;
    // (R at) x F lies along y only when both the arm and the force stay in the plane.
    return !at_B.isZero(0) && (at_B.y() != 0 || !force[1].is_zero());
  }
};

std::vector<Expression> three(const Node& node, const Parameters& constants, const Variables& variables) {
  std::vector<Expression> result;
  for (const Node& item : as_array(node, 3)) result.emplace_back(item, constants, variables);
  return result;
}

std::string as_written(const Node& vector) {
  std::vector<std::string> parts;
  for (const Node& item : vector.items)
    parts.push_back(item.kind == NodeKind::kText ? item.text : shortest(item.number));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

ForceLaw read_force(const Node& table, const Parameters& constants, const std::vector<Body>& bodies) {
  allow_only(table, {"body", "force", "torque", "at"});
  const Node& name = need(table, "body", "body = \"...\"");
  ForceLaw law;
  law.body = body_named(name, bodies);
  if (bodies[law.body].fixed) fail(name, fmt::format("'{}' is fixed, no force moves it; name another", name.text));

  auto compiled = std::make_shared<CompiledForce>();
  const Variables variables{kForceSymbols, compiled->slots.data()};
  const Node& force = need(table, "force", "force = [0, 0, 0]  # N");
  compiled->force = three(force, constants, variables);
  law.text = "force = " + as_written(force) + " N";
  if (const Node* torque = find(table, "torque")) {
    compiled->torque = three(*torque, constants, variables);
    law.text += ", torque = " + as_written(*torque) + " N m";
  }
  if (const Node* at = find(table, "at")) {
    compiled->at_B = vector3(*at, constants);
    law.text += ", at = " + as_written(*at) + " m";
  }
  law.has_torque = !compiled->at_B.isZero(0) || std::any_of(compiled->torque.begin(), compiled->torque.end(),
                                                            [](const Expression& e) { return !e.is_zero(); });
  law.couples_out_of_plane = compiled->couples_out_of_plane();
  law.evaluate = [compiled](double t, const BodyState& state) { return compiled->evaluate(t, state); };
  return law;
}

}  // namespace

std::vector<ForceLaw> read_forces(const Node& root, const Parameters& constants, const std::vector<Body>& bodies) {
  std::vector<ForceLaw> laws;
  for (const Node& table : tables(root, "force")) laws.push_back(read_force(table, constants, bodies));
  return laws;
}

}  // namespace plumbline
