#include "plumbline/core/kinetics/jointed_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include "plumbline/core/joints/constrained_motion.hpp"
#include "plumbline/core/joints/joint_projection.hpp"
#include "plumbline/core/joints/joint_ranges.hpp"
#include "plumbline/core/kinetics/force_following.hpp"

namespace plumbline {

JointedMotion::JointedMotion(const Scenario& scenario, Integrator integrator)
    : scenario_(scenario), body_(articulated_body(scenario)), stepper_(make_stepper(integrator)) {
  require_valid(body_);
}

void JointedMotion::step(double dt, std::span<const Wrench> wrenches, std::span<BodyState> states) {
  const WrenchField held = [&](double, std::span<const BodyState>, std::span<Wrench> applied) {
    std::copy(wrenches.begin(), wrenches.end(), applied.begin());
  };
  step_jointed(scenario_, body_, *stepper_, 0, dt, held, states);
}

void step_jointed(const Scenario& scenario, const ArticulatedBody& body, Stepper& stepper, double t, double dt,
                  const WrenchField& wrenches, std::span<BodyState> states) {
  const bool ranges =
      std::any_of(body.joints.begin(), body.joints.end(), [](const Joint& j) { return j.range.has_value(); });
  if (!ranges) {
    std::vector<Wrench> applied(states.size());
    const AccelerationField field = [&](double now, std::span<const BodyState> at, std::span<Acceleration> result) {
      wrenches(now, at, applied);
      const auto solved = constrained_accelerations(body, at, applied).accelerations;
      std::copy(solved.begin(), solved.end(), result.begin());
    };
    stepper.step(field, t, dt, states);
    back_onto_joints(scenario, body, states);
    return;
  }
  std::vector<BodyState> moved(states.begin(), states.end());
  advance_within_ranges(body, stepper, t, dt, moved, {.restitution = 0}, wrenches,
                        [&](std::span<BodyState> at, std::span<const std::size_t> held_ranges) {
                          back_onto_joints(scenario, body, at, held_ranges);
                        });
  std::copy(moved.begin(), moved.end(), states.begin());
}

void back_onto_joints(const Scenario& scenario, const ArticulatedBody& body, std::span<BodyState> states,
                      std::span<const std::size_t> held_ranges) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (scenario.bodies[i].fixed) states[i] = scenario.bodies[i].initial;
  }
  constexpr double kTolerance = 1e-13;  // some roundings of numbers of the order of one
  const Projection projection = project_positions_held(body, states, held_ranges, kTolerance);
  // Newton's method is done in a few sweeps or not at all; the lengths of the scenario say what rounding leaves.
  if (!(projection.error <= 1e-9 * std::max(1.0, scenario.scales.length))) {
    throw std::runtime_error("the joints are " + shortest(projection.error) +
                             " apart after a step and cannot be closed; take a smaller dt");
  }
  project_velocities(body, states, held_ranges);
}

}  // namespace plumbline
