// Motion with impacts and limits of joints: the core moves the bodies itself, and cuts its steps at each impact.
//
// Velocity Verlet is exact where accelerations are constant between impacts. Where they are not, and where contacts
// settle, a second run with half the step tells how far off the simulation is; a third, with ten times its tolerance
// of contact, how much that matters. All three differences together are what the reference may be off.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plumbline/core/feature.hpp"
#include "plumbline/core/joints/joint_ranges.hpp"
#include "plumbline/core/kinetics/force_following.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "second_sources.hpp"

namespace plumbline {
namespace {

constexpr double kTolerance = SimulatorOptions{}.contact_tolerance;
// Moments at which a joint reaches its limit are found until the room left is 1e-12; what that makes of the motion
// after it, in shares of its extent.
constexpr double kLimitTolerance = 1e-11;
// A simulation that is not surer than this says nothing about a reference.
constexpr double kConclusive = 1e-3;

bool has_ranges(const Scenario& scenario) {
  return std::any_of(scenario.joints.begin(), scenario.joints.end(),
                     [](const Joint& joint) { return joint.range.has_value(); });
}

// A joint's limit is a plastic stop.
Trajectory within_ranges(const Scenario& scenario, double dt) {
  const ArticulatedBody body = articulated_body(scenario);
  const WrenchField wrenches = [&](double t, std::span<const BodyState> states, std::span<Wrench> w) {
    evaluate_forces(scenario, t, states, w);
  };
  const auto stepper = make_stepper(Integrator::kRungeKutta4);
  std::vector<BodyState> states;
  for (const Body& b : scenario.bodies) states.push_back(b.initial);
  Trajectory trajectory(dt, states.size());
  std::copy(states.begin(), states.end(), trajectory.append().begin());
  const std::size_t steps = scenario.step_count(dt);
  for (std::size_t k = 0; k < steps; ++k) {
    advance_within_ranges(body, *stepper, trajectory.time(k), dt, states, {}, wrenches);
    std::copy(states.begin(), states.end(), trajectory.append().begin());
  }
  return trajectory;
}

// A pile costs the square of its bodies; a motion of a few is looked at closely.
double step_for(const Scenario& scenario) {
  const auto moving =
      std::count_if(scenario.bodies.begin(), scenario.bodies.end(), [](const Body& body) { return !body.fixed; });
  const double steps = std::clamp(1600.0 / static_cast<double>(moving * moving), 40.0, 800.0);
  return compared_until(scenario) / steps;
}

std::vector<BodyState> at(const Trajectory& trajectory, std::size_t sample) {
  std::vector<BodyState> states;
  for (std::size_t b = 0; b < trajectory.bodies(); ++b) states.push_back(trajectory.at(sample, b));
  return states;
}

// The largest difference of two runs, the second of which has `ratio` samples for each of the first.
Differences apart(const Scenario& scenario, const Trajectory& coarse, const Trajectory& fine, std::size_t ratio) {
  Differences result;
  for (std::size_t k = 0; k < coarse.samples() && k * ratio < fine.samples(); ++k) {
    result = larger(result, differences(scenario, at(coarse, k), at(fine, k * ratio)));
  }
  return result;
}

// An impact next to a sample comes before it in one motion and after it in the other: velocities jump there.
bool jumps(const Scenario& scenario, const Reference& reference, double t, const Extent& extent) {
  const double near = 1e-6 * compared_until(scenario);
  const auto before = states_of(scenario, reference, std::max(0.0, t - near)),
             after = states_of(scenario, reference, t + near);
  const Differences d = differences(scenario, before, after);
  return d.velocity > 1e-3 * extent.speed || d.spin > 1e-3 * extent.spin;
}

// Samples of the coarse run that lie next to a jump are left out of all three comparisons.
Trajectory without(const Trajectory& trajectory, const std::vector<bool>& out, std::size_t ratio) {
  Trajectory kept(trajectory.dt(), trajectory.bodies());
  for (std::size_t k = 0; k * ratio < trajectory.samples() && k < out.size(); ++k) {
    if (out[k]) continue;
    const auto states = at(trajectory, k * ratio);
    std::copy(states.begin(), states.end(), kept.append().begin());
  }
  return kept;
}

}  // namespace

std::optional<std::string> why_not_simulated(const Scenario& scenario) {
  FeatureSet can = simulator_features();
  if (!scenario.contact) can.insert(Feature::kJointRange);
  const FeatureSet missing = needs(scenario).without(can);
  if (!missing.empty()) return "the core's simulator has no " + missing.describe();
  return std::nullopt;
}

Trajectory simulated(const Scenario& scenario, double dt, double contact_tolerance) {
  if (has_ranges(scenario)) return within_ranges(scenario, dt);
  SimulatorOptions options;
  options.contact_tolerance = contact_tolerance;
  options.max_events_per_step = 10'000;
  return simulate(scenario, {Integrator::kVelocityVerlet, ImpactRule::kExactTime}, dt, options);
}

void check_simulation(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result) {
  if (const auto why = why_not_simulated(scenario)) {
    result.left_out.push_back("simulation: " + *why);
    return;
  }
  try {
    Scenario shortened = scenario;
    shortened.duration = compared_until(scenario);
    const double dt = step_for(scenario);
    Trajectory coarse = simulated(shortened, dt, kTolerance), fine = simulated(shortened, dt / 2, kTolerance),
               loose = simulated(shortened, dt / 2, 10 * kTolerance);
    std::vector<bool> out;
    std::vector<double> times;
    for (std::size_t k = 0; k < coarse.samples(); ++k) {
      out.push_back(jumps(scenario, reference, coarse.time(k), claim.extent));
      if (!out.back()) times.push_back(coarse.time(k));
    }
    coarse = without(coarse, out, 1);
    fine = without(fine, out, 2);
    loose = without(loose, out, 2);

    const Differences steps = apart(scenario, coarse, fine, 1), tolerances = apart(scenario, fine, loose, 1);
    const double limits = has_ranges(scenario) ? kLimitTolerance : 0;
    const auto allowed = [limits](double step, double tolerance, double claimed, double extent) {
      return 2 * step + 2 * tolerance + claimed + limits * extent;
    };
    const Differences bound{allowed(steps.place, tolerances.place, claim.place, claim.extent.place),
                            allowed(steps.velocity, tolerances.velocity, claim.velocity, claim.extent.speed),
                            allowed(steps.attitude, tolerances.attitude, claim.attitude, 1),
                            allowed(steps.spin, tolerances.spin, claim.spin, claim.extent.spin)};
    Worst worst;
    for (std::size_t k = 0; k < times.size() && k < fine.samples(); ++k) {
      worst.offer(differences(scenario, at(fine, k), states_of(scenario, reference, times[k])), bound, claim.extent,
                  " against the core's simulation at t = " + shortest(times[k]));
    }
    const Extent& e = claim.extent;
    const double unsure =
        std::max({bound.place / e.place, bound.velocity / e.speed, bound.attitude, bound.spin / e.spin});
    if (!(unsure <= kConclusive)) {
      result.left_out.push_back("simulation: the core's own runs differ by " + shortest(unsure));
      return;
    }
    result.rows.push_back({"simulation", worst.what, worst.figure, worst.bound, true, {}});
  } catch (const std::exception& e) {
    result.left_out.push_back(std::string("simulation: ") + e.what());
  }
}

}  // namespace plumbline
