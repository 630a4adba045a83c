#include "plumbline/core/scenario.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "plumbline/core/feature.hpp"
#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {

std::string shortest(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

std::string Scenario::case_name() const {
  std::string name = id;
  char separator = '/';
  for (const auto& [key, value] : swept) {
    name += separator + key + '=' + shortest(value);
    separator = ',';
  }
  return name;
}

std::size_t Scenario::step_count(double dt) const {
  const double ratio = duration / dt;
  const double nearest = std::round(ratio);
  const bool whole_but_for_rounding = std::abs(ratio - nearest) <= 1e-9 * nearest;
  return static_cast<std::size_t>(whole_but_for_rounding ? nearest : std::floor(ratio));
}

std::size_t Scenario::body_index(const std::string& name) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) return i;
  }
  throw std::out_of_range("scenario " + id + " has no body '" + name + "'");
}

bool joined(const Scenario& scenario, std::size_t body, std::size_t other) {
  return std::any_of(scenario.joints.begin(), scenario.joints.end(), [&](const Joint& joint) {
    return (joint.a == body && joint.b == other) || (joint.a == other && joint.b == body);
  });
}

void require_sound(const Scenario& scenario) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (!scenario.gravity.allFinite()) refuse("gravity must be finite");
  for (const Body& body : scenario.bodies) {
    const std::string who = "body '" + body.name + "'";
    require_mass(body);
    if (!is_finite(body.initial)) refuse(who + ": its initial state must be finite");
    if (std::abs(body.initial.q_WB.norm() - 1) > 1e-9) refuse(who + ": its attitude must be a unit quaternion");
    if (body.fixed) continue;
    if (std::holds_alternative<HalfSpace>(body.shape))
      refuse(who + " is a half-space, which cannot move; make it fixed");
    if (!std::isfinite(body.mass)) refuse(who + ": its mass must be finite");
    if (!(body.inertia.minCoeff() > 0 && body.inertia.allFinite())) {
      refuse(who + " moves and needs moments of inertia > 0 about all three axes");
    }
  }
  const auto moves = [&](std::size_t body) { return body < scenario.bodies.size() && !scenario.bodies[body].fixed; };
  for (const Spring& spring : scenario.springs) {
    const std::string who = "spring '" + spring.name + "'";
    if (!moves(spring.b) || (spring.a != kWorld && !moves(spring.a)) || spring.a == spring.b) {
      refuse(who + " must tie two bodies that move, or one and the world");
    }
    for (const double number : {spring.stiffness, spring.damping, spring.length}) {
      if (!(number >= 0 && std::isfinite(number))) refuse(who + ": stiffness, damping and length must be >= 0");
    }
    if (!spring.on_a.allFinite() || !spring.on_b.allFinite()) refuse(who + ": its points must be finite");
  }
  const auto require_coordinate = [&](std::size_t joint, const char* what) {
    if (joint >= scenario.joints.size()) refuse(std::string(what) + " acts on a joint that does not exist");
    const JointKind kind = scenario.joints[joint].kind;
    if (kind == JointKind::kHinge || kind == JointKind::kSlider) return;
    refuse("joint '" + scenario.joints[joint].name + "': " + what + " needs a hinge or a slider to act on");
  };
  for (const JointDrive& drive : scenario.drives) require_coordinate(drive.joint, "a drive");
  for (const JointSpring& spring : scenario.joint_springs) {
    require_coordinate(spring.joint, "a spring");
    if (!(spring.stiffness >= 0 && std::isfinite(spring.stiffness) && spring.damping >= 0 &&
          std::isfinite(spring.damping) && std::isfinite(spring.rest))) {
      refuse("joint '" + scenario.joints[spring.joint].name + "': stiffness and damping must be >= 0, rest finite");
    }
  }
  if (scenario.joints.empty()) return;
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  require_valid(articulated_body(scenario));
  for (const Joint& joint : scenario.joints) {
    const std::string who = "joint '" + joint.name + "'";
    for (const std::size_t end : {joint.a, joint.b}) {
      if (end != kWorld && scenario.bodies[end].fixed) {
        refuse(who + " leads to '" + scenario.bodies[end].name + "', which is fixed; tie it to the world instead");
      }
    }
    // Typing errors are far larger, and the rounding of any sensible expression far smaller.
    constexpr double kTolerance = 1e-9;
    const double length = scenario.scales.length, speed = scenario.scales.velocity();
    for (const JointRow& row : joint_rows(joint, states)) {
      if (!(std::abs(row.error) <= kTolerance * std::max(1.0, length))) {
        refuse(who + " does not hold in the initial positions: it is " + shortest(row.error) + " off");
      }
      if (!(std::abs(rate(row, states)) <= kTolerance * std::max(1.0, speed))) {
        refuse(who + " does not hold in the initial velocities: it would come apart with " +
               shortest(rate(row, states)) + " a second; correct velocity or angular_velocity of its bodies");
      }
    }
  }
}

ArticulatedBody articulated_body(const Scenario& scenario) {
  ArticulatedBody result;
  for (const Body& body : scenario.bodies) {
    result.bodies.push_back(body.fixed ? BodyInertia{1, Mat3::Identity()}
                                       : BodyInertia{body.mass, body.inertia.asDiagonal()});
  }
  result.joints = scenario.joints;
  result.gravity_W = scenario.gravity;
  return result;
}

std::string_view tier_name(Tier tier) {
  static constexpr std::string_view kNames[] = {"smoke", "standard", "full"};
  return kNames[static_cast<std::size_t>(tier)];
}

bool has_forces(const Scenario& scenario, const FeatureSet& native) {
  return !scenario.forces.empty() || !scenario.drives.empty() ||
         (!scenario.springs.empty() && !native.contains(Feature::kSpring)) ||
         (!scenario.joint_springs.empty() && !native.contains(Feature::kJointSpring));
}

void evaluate_forces(const Scenario& scenario, double t, std::span<const BodyState> states,
                     std::span<Wrench> wrenches) {
  evaluate_forces(scenario, t, states, wrenches, {});
}

void evaluate_forces(const Scenario& scenario, double t, std::span<const BodyState> states, std::span<Wrench> wrenches,
                     const FeatureSet& native) {
  std::fill(wrenches.begin(), wrenches.end(), Wrench{});
  for (const ForceLaw& law : scenario.forces) {
    const Wrench wrench = law.evaluate(t, states[law.body]);
    wrenches[law.body].f_W += wrench.f_W;
    wrenches[law.body].tau_W += wrench.tau_W;
  }
  if (!native.contains(Feature::kSpring)) {
    for (const Spring& spring : scenario.springs) add_wrenches(spring, states, wrenches);
  }
  if (!native.contains(Feature::kJointSpring)) {
    for (const JointSpring& spring : scenario.joint_springs) {
      const Joint& joint = scenario.joints[spring.joint];
      add_wrenches(joint, effort_of(spring, joint, states), states, wrenches);
    }
  }
  for (const JointDrive& drive : scenario.drives) {
    const Joint& joint = scenario.joints[drive.joint];
    const JointRow row = coordinate_row(joint, states);
    add_wrenches(joint, drive.effort(t, row.error, rate(row, states)), states, wrenches);
  }
  // A wrench of a fixed body moves nothing; engines are promised zero.
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    if (scenario.bodies[i].fixed) wrenches[i] = {};
  }
}

}  // namespace plumbline
