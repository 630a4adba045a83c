// What the laws keep whatever the motion: energy, momenta, and that bodies touch when they are said to.
#include "plumbline/core/invariant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plumbline/core/collision/contact.hpp"
#include "plumbline/core/joints/joint_equations.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "plumbline/core/metric.hpp"
#include "second_sources.hpp"

namespace plumbline {
namespace {

constexpr int kSamples = 200;

struct Kept {
  bool energy = false, momentum = false;  // angular momentum is kept where momentum is
};

// From what the scenario states, not from any motion. In doubt no: a force law may do no work, but who knows.
Kept kept_by(const Scenario& s) {
  if (!s.forces.empty() || !s.drives.empty()) return {};
  const auto any = [](const auto& list, auto&& is) { return std::any_of(list.begin(), list.end(), is); };
  const auto damps = [](const auto& spring) { return spring.damping > 0; };
  const bool stops = any(s.joints, [](const Joint& joint) { return joint.range.has_value(); });
  const bool loses = s.contact && (s.contact->restitution < 1 || s.contact->friction > 0);
  const auto to_world = [](const auto& tie) { return tie.a == kWorld; };
  const bool meets_the_world = s.contact && any(s.bodies, [](const Body& body) { return body.fixed; });
  return {!stops && !loses && !any(s.springs, damps) && !any(s.joint_springs, damps),
          s.gravity.isZero(0) && !meets_the_world && !any(s.joints, to_world) && !any(s.springs, to_world)};
}

struct Allowance {
  double energy = 0, momentum = 0, angular = 0;
};

// What the claimed errors of a reference may amount to, twice: now and at the start.
Allowance allowance(const Scenario& s, const Claim& claim) {
  const Extent& e = claim.extent;
  Allowance a;
  for (const Body& body : s.bodies) {
    if (body.fixed) continue;
    const double m = body.mass, inertia = body.inertia.maxCoeff();
    const double spin = inertia * (claim.spin + 2 * e.spin * claim.attitude);
    a.energy += m * (e.speed * claim.velocity + s.gravity.norm() * claim.place) + e.spin * spin;
    a.momentum += m * claim.velocity;
    a.angular += m * (e.place * claim.velocity + e.speed * claim.place) + spin;
  }
  for (const Spring& spring : s.springs) {
    const double arm = std::max(spring.on_a.norm(), spring.on_b.norm());
    a.energy += spring.stiffness * (2 * e.place + 2 * arm + spring.length) * 2 * (claim.place + arm * claim.attitude);
  }
  for (const JointSpring& spring : s.joint_springs) {
    const double error = 2 * std::max(claim.place, claim.attitude);
    a.energy += spring.stiffness * (2 * std::max(e.place, 4.0) + std::abs(spring.rest)) * error;
  }
  return {2 * a.energy, 2 * a.momentum, 2 * a.angular};
}

CertificationRow row(const std::string& text, double figure, double bound, double scale, bool independent) {
  return {"invariant", text, figure / scale, bound / scale, independent, {}};
}

// Largest change of a quantity over the samples of a motion.
template <typename Quantity, typename States>
double largest_change(const Quantity& quantity, const States& states_at, std::size_t samples) {
  const auto start = quantity(states_at(0));
  double change = 0;
  for (std::size_t k = 1; k < samples; ++k) {
    // A number or a vector, and no expression: that would refer to a vector that is gone.
    const std::decay_t<decltype(start)> difference = quantity(states_at(k)) - start;
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(difference)>>) {
      change = max_or_nan(change, std::abs(difference));
    } else {
      change = max_or_nan(change, difference.norm());
    }
  }
  return change;
}

// What a gate looks at: "energy" of "energy.max".
std::string quantity_of(const Gate& gate) { return gate.metric.substr(0, gate.metric.find('.')); }

// The truth as the core moves it, through the gate: for what no law keeps by itself.
void check_gate_on_simulation(const Scenario& scenario, const Gate& gate, Certification& result) {
  if (const auto why = why_not_simulated(scenario)) {
    result.left_out.push_back("invariant: " + gate.metric + " is kept by no law, and " + *why);
    return;
  }
  const double dt = *std::min_element(scenario.steps.begin(), scenario.steps.end());
  const Trajectory motion = simulated(scenario, dt, SimulatorOptions{}.contact_tolerance);
  Trajectory start(dt, scenario.bodies.size());
  for (std::size_t k = 0; k < motion.samples(); ++k) {
    const auto states = start.append();
    for (std::size_t b = 0; b < states.size(); ++b) states[b] = scenario.bodies[b].initial;
  }
  const double value = find_metric(gate.metric)->measure({scenario, motion, start});
  const double steps = static_cast<double>(scenario.step_count(dt));
  result.rows.push_back({"invariant", gate.metric + " of the core's simulation against the gate's limit", value,
                         gate.limit({dt, steps, 0x1p-53}), true, gate.place});
}

}  // namespace

void check_invariants(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result) {
  const Kept kept = kept_by(scenario);
  if (!kept.energy && !kept.momentum) return;
  const Allowance allowed = allowance(scenario, claim);
  const double until = compared_until(scenario);
  const auto states_at = [&](std::size_t k) {
    return states_of(scenario, reference, until * static_cast<double>(k) / kSamples);
  };
  const auto change = [&](const auto& quantity) { return largest_change(quantity, states_at, kSamples + 1); };
  if (kept.energy) {
    const double found = change([&](const std::vector<BodyState>& states) { return energy(scenario, states); });
    result.rows.push_back(row("energy, which nothing changes", found, allowed.energy, scenario.scales.energy(), false));
  }
  if (kept.momentum) {
    const double linear = change([&](const auto& states) { return momentum(scenario, states); });
    const double angular = change([&](const auto& states) { return angular_momentum(scenario, states); });
    const double scale = scenario.scales.momentum();
    result.rows.push_back(row("momentum, which nothing changes", linear, allowed.momentum, scale, false));
    result.rows.push_back(row("angular momentum, which nothing changes", angular, allowed.angular,
                              scale * scenario.scales.length, false));
  }
}

void check_kept(const Scenario& scenario, Certification& result) {
  const Kept kept = kept_by(scenario);
  for (const Gate& gate : scenario.gates) {
    const std::string quantity = quantity_of(gate);
    const bool by_law = quantity == "joint_gap" || (quantity == "energy" ? kept.energy : kept.momentum);
    if (by_law) {
      // Zero is what the law says; a bound above it is what the gate grants.
      const double dt = *std::min_element(scenario.steps.begin(), scenario.steps.end());
      const double steps = static_cast<double>(scenario.step_count(dt));
      result.rows.push_back({"invariant", quantity + ": nothing that the scenario states can change it", 0,
                             gate.limit({dt, steps, 0x1p-53}), true, gate.place});
      continue;
    }
    try {
      check_gate_on_simulation(scenario, gate, result);
    } catch (const std::exception& e) {
      result.left_out.push_back("invariant: " + gate.metric + " in the core's simulation: " + e.what());
    }
  }
}

void check_touch(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result) {
  if (scenario.events.empty()) return;
  Worst worst;
  for (const Event& event : scenario.events) {
    if (event.time > compared_until(scenario)) continue;
    const auto states = states_of(scenario, reference, event.time);
    std::vector<Contact> contacts;
    try {
      for (const Pair& pair : contact_pairs(scenario.bodies)) {
        const bool meant =
            (pair.a == event.body_a && pair.b == event.body_b) || (pair.a == event.body_b && pair.b == event.body_a);
        if (meant) append_contacts(scenario.bodies, states, pair, contacts);
      }
    } catch (const std::exception& e) {
      result.left_out.push_back(std::string("touch: ") + e.what());
      return;
    }
    double gap = contacts.empty() ? std::numeric_limits<double>::infinity() : contacts.front().gap;
    for (const Contact& contact : contacts) gap = std::isnan(contact.gap) ? contact.gap : std::min(gap, contact.gap);
    const double bound = 4 * (claim.place + claim.extent.place * claim.attitude);
    worst.offer(std::abs(gap), bound, scenario.scales.length, "gap of the bodies at '" + event.name + "'");
  }
  if (worst.ratio >= 0 || std::isnan(worst.ratio)) {
    result.rows.push_back({"touch", worst.what, worst.figure, worst.bound, false, {}});
  }
}

}  // namespace plumbline
