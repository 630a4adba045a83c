#include "plumbline/core/kinetics/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "plumbline/core/kinetics/force_following.hpp"
#include "plumbline/core/mass/newton_euler.hpp"

namespace plumbline {
namespace {

// A box that settles rocks from corner to corner, infinitely often in a finite time. On parabolas every one of these
// impacts is found; on straight lines no corner comes back, so that the series ends.
constexpr int kParabolicImpacts = 8;

// Boxes that settle upon boxes hand their rocking to and fro. After that many impacts in one step, those that a step of
// gravity explains do not rebound, whether or not the bodies are held up, and the rest of the step is gone through as
// one.
constexpr int kChatter = 32;

void rotate(BodyState& state, const Vec3& phi) {
  state.q_WB = rotation_by(phi) * state.q_WB;
  state.q_WB.normalize();  // rounding would let the length wander
}

// Newton's rule: the faster they meet, the faster they part; contacts that rest do not rebound.
double rebound_speed(double approach, double resting_speed, double restitution) {
  return approach <= resting_speed ? 0 : restitution * approach;
}

}  // namespace

FeatureSet simulator_features() {
  return FeatureSet::all().without({Feature::kJointsAndContact, Feature::kCylinderHalfSpace, Feature::kCylinderCylinder,
                                    Feature::kCylinderOther, Feature::kSpring, Feature::kJointSpring});
}

Simulator::Simulator(const Scenario& scenario, const Scheme& scheme, const SimulatorOptions& options)
    : scheme_(scheme),
      options_(options),
      gravity_(scenario.gravity),
      bodies_(scenario.bodies),
      material_(scenario.contact),
      wrenches_(scenario.bodies.size()) {
  require_possible(scheme, scenario);
  if (scheme.forces == ForceSampling::kFollowed) {
    throw std::invalid_argument(name(scheme) +
                                ": forces come to the simulator from outside, a step at a time, and are " +
                                "held over it; simulate() can follow the force laws of a scenario");
  }
  for (const Body& body : bodies_) {
    require_mass(body);
    states_.push_back(body.initial);
  }
  if (material_) pairs_ = contact_pairs(bodies_);
  if (!scenario.joints.empty()) jointed_.emplace(scenario, scheme.integrator);
}

void Simulator::apply(std::span<const Wrench> wrenches) {
  if (wrenches.size() != bodies_.size()) {
    throw std::invalid_argument(std::to_string(wrenches.size()) + " wrenches for " + std::to_string(bodies_.size()) +
                                " bodies: one per body is needed, zero for bodies without a force");
  }
  std::copy(wrenches.begin(), wrenches.end(), wrenches_.begin());
}

void Simulator::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("a step of " + std::to_string(dt) + " s: it must be > 0");
  dt_ = dt / scheme_.substeps;
  for (int k = 0; k < scheme_.substeps; ++k) {
    if (jointed_) {
      jointed_->step(dt_, wrenches_, states_);
      continue;
    }
    free_ = free_accelerations();
    if (scheme_.impact == ImpactRule::kExactTime || !material_) {  // where nothing touches, all rules agree
      step_exact_time(dt_);
    } else {
      step_from_start(dt_);
    }
  }
  std::fill(wrenches_.begin(), wrenches_.end(), Wrench{});
}

// m a = m g + f and I alpha = tau - w x I w, the last term in the scheme's way.
Simulator::Accelerations Simulator::free_accelerations() const {
  Accelerations result(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].fixed) continue;
    const Vec3& w = states_[i].w_WB;
    const Quat& q_WB = states_[i].q_WB;
    const Mat3 inverse_inertia_W = inertness_of(bodies_[i], q_WB).inverse_inertia_W;
    result[i].linear = gravity_ + wrenches_[i].f_W / bodies_[i].mass;
    switch (scheme_.gyroscopic) {
      case GyroscopicTerm::kExplicit:
        result[i].angular =
            angular_acceleration(inertia_in_world(bodies_[i], q_WB), inverse_inertia_W, w, wrenches_[i].tau_W);
        break;
      case GyroscopicTerm::kNone:
      case GyroscopicTerm::kExact:  // move() turns the body
        result[i].angular = inverse_inertia_W * wrenches_[i].tau_W;
        break;
      case GyroscopicTerm::kImplicit: {
        const Vec3 w_B = q_WB.conjugate() * w;
        const Vec3 change_B = gyroscopic_step(scheme_.gyroscopic, bodies_[i].inertia, w_B, dt_) - w_B;
        result[i].angular = inverse_inertia_W * wrenches_[i].tau_W + q_WB * change_B / dt_;
        break;
      }
    }
  }
  return result;
}

std::vector<Inertness> Simulator::inertness() const {
  std::vector<Inertness> result;
  for (std::size_t i = 0; i < bodies_.size(); ++i) result.push_back(inertness_of(bodies_[i], states_[i].q_WB));
  return result;
}

void Simulator::step_exact_time(double dt) {
  switch (scheme_.integrator) {
    case Integrator::kSemiImplicitEuler:
      kick(dt);
      fly(dt, false);
      break;
    case Integrator::kExplicitEuler:
      fly(dt, false);
      kick(dt);
      break;
    case Integrator::kVelocityVerlet:
      fly(dt, true);
      break;
    case Integrator::kPositionVerlet:
    case Integrator::kRungeKutta4:
    case Integrator::kDormandPrince8:
      throw std::logic_error(name(scheme_) + " follows its forces and is not stepped here");
  }
}

// All of the forces' impulse at once; where bodies rest on each other the contact answers it at once.
void Simulator::kick(double dt) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    states_[i].v_WB += free_[i].linear * dt;
    states_[i].w_WB += free_[i].angular * dt;
  }
  std::vector<Contact> contacts = touching();
  const std::vector<bool> held = held_up(contacts);
  std::erase_if(contacts, [&](const Contact& c) { return !(approach_speed(c, states_) <= resting_speed(c, held)); });
  support(contacts, states_);
}

void Simulator::support(std::span<const Contact> contacts, std::span<BodyState> states) const {
  if (contacts.empty()) return;
  std::vector<ImpactPoint> points;
  for (const Contact& c : contacts) points.push_back({c, 0, material_->friction});
  apply_impulses(points, inertness(), states, options_.leaps);
}

// The held accelerations of the coming `duration`, those of resting contacts included: whatever keeps the bodies from
// approaching until its end, spread evenly. A point that is about to part counts too: if it were left to fall back
// within the same step, two points of one box would take turns at that without end.
Simulator::Accelerations Simulator::supported_accelerations(double duration) const {
  std::vector<Contact> contacts = touching();
  std::erase_if(contacts, [&](const Contact& c) { return !(approach_speed(c, states_) <= rounding_speed(c)); });
  if (contacts.empty() || !(duration > 0)) return free_;
  std::vector<BodyState> end = states_;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    end[i].v_WB += free_[i].linear * duration;
    end[i].w_WB += free_[i].angular * duration;
  }
  support(contacts, end);
  Accelerations result(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    result[i].linear = (end[i].v_WB - states_[i].v_WB) / duration;
    result[i].angular = (end[i].w_WB - states_[i].w_WB) / duration;
  }
  return result;
}

// From impact to impact to the end of the step.
void Simulator::fly(double duration, bool accelerated) {
  for (int events = 0;; ++events) {
    if (accelerated && events == kParabolicImpacts) {
      kick(duration);
      accelerated = false;
    }
    const Accelerations held = accelerated ? supported_accelerations(duration) : Accelerations(bodies_.size());
    const std::optional<double> impact = first_impact(held, duration);
    move(held, duration, impact.value_or(duration));
    if (!impact) return;
    if (events == options_.max_events_per_step) {
      throw std::runtime_error("more than " + std::to_string(options_.max_events_per_step) +
                               " impacts in one step of " + shortest(dt_) +
                               " s: bodies are caught between others; take a smaller dt or allow more events");
    }
    duration -= *impact;
    const bool chatter = events >= kChatter;
    const bool rebounds = resolve_impacts(chatter);
    if (chatter && !rebounds) {
      if (duration > 0) settle(duration);
      return;
    }
  }
}

std::optional<double> Simulator::first_impact(const Accelerations& held, double horizon) const {
  std::optional<double> first;
  for (const Pair pair : pairs_) {
    const std::optional<double> t = pair_impact(pair, held, horizon);
    if (t && *t <= horizon && (!first || *t < *first)) first = t;
  }
  return first;
}

// Points that touch without approaching are left out: rounding would make them meet again and again at once.
std::optional<double> Simulator::pair_impact(Pair pair, const Accelerations& held, double horizon) const {
  const Motion a = motion(pair.a, held, horizon), b = motion(pair.b, held, horizon);
  const Shape &shape_a = bodies_[pair.a].shape, &shape_b = bodies_[pair.b].shape;
  std::vector<Contact> contacts;
  append_contacts(bodies_, states_, pair, contacts);
  const auto left_alone = [&](const Contact& c) { return c.gap <= tolerance(pair) && rests(c); };

  if (std::holds_alternative<Box>(shape_b)) {
    if (!within_reach(pair, held, horizon)) return std::nullopt;
    if (rests_on(pair, contacts)) return next_point_meets(pair, contacts, a, b, horizon);
    const std::optional<Touch> touch = shapes_meet(shape_a, a, shape_b, b, horizon);
    return touch ? std::optional(touch->time) : std::nullopt;
  }
  if (const auto* sphere_b = std::get_if<Sphere>(&shape_b)) {
    if (left_alone(contacts.front())) return std::nullopt;
    return sphere_meets_sphere(a, std::get<Sphere>(shape_a).radius, b, sphere_b->radius, horizon);
  }
  const Vec3& normal_W = std::get<HalfSpace>(shape_b).normal;
  const Plane plane{normal_W, normal_W.dot(b.start.p_WB)};
  if (const auto* sphere_a = std::get_if<Sphere>(&shape_a)) {
    if (left_alone(contacts.front())) return std::nullopt;
    return sphere_meets_plane(a, sphere_a->radius, plane);
  }
  const Vec3& size = std::get<Box>(shape_a).size;
  std::optional<double> first;
  for (int k = 0; k < 8; ++k) {
    if (left_alone(contacts[static_cast<std::size_t>(k)])) continue;
    const auto t = corner_meets_plane(a, box_corner(size, k), plane, kImpactTolerance * size.norm(), horizon);
    if (t && *t <= horizon && (!first || *t < *first)) first = t;
  }
  return first;
}

// The attitude turns with the mean angular velocity of the time ahead, as exp(w dt) q asks for one axis.
Motion Simulator::motion(std::size_t body, const Accelerations& held, double horizon) const {
  Motion result{states_[body], held[body].linear};
  result.start.w_WB += 0.5 * horizon * held[body].angular;
  return result;
}

void Simulator::move(const Accelerations& held, double horizon, double duration) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].fixed) continue;
    BodyState& s = states_[i];
    s.p_WB += s.v_WB * duration + 0.5 * duration * duration * held[i].linear;
    if (scheme_.gyroscopic == GyroscopicTerm::kExact) {
      // Half of the torque's impulse before the free rotation and half behind it keep the step of second order.
      s.w_WB += 0.5 * duration * held[i].angular;
      turn_freely(bodies_[i].inertia, duration, s);
      s.w_WB += 0.5 * duration * held[i].angular;
    } else {
      rotate(s, motion(i, held, horizon).start.w_WB * duration);
      s.w_WB += held[i].angular * duration;
    }
    s.v_WB += held[i].linear * duration;
  }
}

// All points that touch at this instant get their impulses together. Whether any of them rebounds.
bool Simulator::resolve_impacts(bool chatter) {
  std::vector<ImpactPoint> points;
  bool rebounds = false;
  const std::vector<Contact> contacts = touching();
  const std::vector<bool> held = chatter ? std::vector<bool>(bodies_.size(), true) : held_up(contacts);
  for (const Contact& c : contacts) {
    const double speed = rebound_speed(approach_speed(c, states_), resting_speed(c, held), material_->restitution);
    points.push_back({c, speed, material_->friction});
    rebounds = rebounds || speed > 0;
  }
  apply_impulses(points, inertness(), states_, options_.leaps);
  return rebounds;
}

// Straight on to the end of the step, with no point closing by more than its gap on the way.
void Simulator::settle(double duration) {
  std::vector<ImpactPoint> points;
  std::vector<Contact> contacts;
  for (const Pair pair : pairs_) append_contacts(bodies_, states_, pair, contacts);
  for (const Contact& c : contacts) {
    points.push_back({c, -std::max(c.gap, 0.0) / duration, material_->friction});
  }
  apply_impulses(points, inertness(), states_, options_.leaps);
  const Accelerations none(bodies_.size());
  move(none, duration, duration);
}

void Simulator::step_from_start(double dt) {
  const std::vector<BodyState> before = states_;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    states_[i].v_WB += free_[i].linear * dt;
    states_[i].w_WB += free_[i].angular * dt;
  }
  const std::span<const BodyState> counted = scheme_.impact == ImpactRule::kStepStart ? states_ : before;
  std::vector<ImpactPoint> points;
  const std::vector<Contact> contacts = touching();
  const std::vector<bool> held = held_up(contacts);
  for (const Contact& c : contacts) {
    points.push_back({c, rebound_speed(approach_speed(c, counted), resting_speed(c, held), material_->restitution),
                      material_->friction});
  }
  apply_impulses(points, inertness(), states_, options_.leaps);

  // How much of the new velocity the positions see.
  const double share = scheme_.integrator == Integrator::kSemiImplicitEuler ? 1.0
                       : scheme_.integrator == Integrator::kExplicitEuler   ? 0.0
                                                                            : 0.5;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].fixed) continue;
    states_[i].p_WB += (before[i].v_WB + share * (states_[i].v_WB - before[i].v_WB)) * dt;
    rotate(states_[i], (before[i].w_WB + share * (states_[i].w_WB - before[i].w_WB)) * dt);
  }
}

Trajectory simulate(const Scenario& scenario, const Scheme& scheme, double dt, const SimulatorOptions& options) {
  if (scheme.forces == ForceSampling::kFollowed) return follow_forces(scenario, scheme, dt);
  Simulator simulator(scenario, scheme, options);
  const std::size_t steps = scenario.step_count(dt);
  Trajectory trajectory(dt, scenario.bodies.size());
  trajectory.reserve(steps + 1);
  const auto record = [&] {
    const auto states = simulator.states();
    std::copy(states.begin(), states.end(), trajectory.append().begin());
  };
  record();
  std::vector<Wrench> wrenches(scenario.bodies.size());
  for (std::size_t k = 0; k < steps; ++k) {
    evaluate_forces(scenario, trajectory.time(k), simulator.states(), wrenches);
    simulator.apply(wrenches);
    simulator.step(dt);
    record();
  }
  return trajectory;
}

}  // namespace plumbline
