#include "plumbline/core/kinetics/jointed_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include "plumbline/core/joints/constrained_motion.hpp"
#include "plumbline/core/joints/joint_projection.hpp"
#include "plumbline/core/kinetics/force_following.hpp"

namespace plumbline {

JointedMotion::JointedMotion(const Scenario& scenario, Integrator integrator)
    : scenario_(scenario), body_(articulated_body(scenario)), stepper_(make_stepper(integrator)) {
  require_valid(body_);
}

void JointedMotion::step(double dt, std::span<const Wrench> wrenches, std::span<BodyState> states) {
  const AccelerationField field = [&](double, std::span<const BodyState> at, std::span<Acceleration> accelerations) {
    const auto solved = constrained_accelerations(body_, at, wrenches).accelerations;
    std::copy(solved.begin(), solved.end(), accelerations.begin());
  };
  stepper_->step(field, 0, dt, states);
  back_onto_joints(scenario_, body_, states);
}

void back_onto_joints(const Scenario& scenario, const ArticulatedBody& body, std::span<BodyState> states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (scenario.bodies[i].fixed) states[i] = scenario.bodies[i].initial;
  }
  constexpr double kTolerance = 1e-13;  // some roundings of numbers of the order of one
  const Projection projection = project_positions(body, states, kTolerance);
  // Newton's method is done in a few sweeps or not at all; the lengths of the scenario say what rounding leaves.
  if (!(projection.error <= 1e-9 * std::max(1.0, scenario.scales.length))) {
    throw std::runtime_error("the joints are " + shortest(projection.error) +
                             " apart after a step and cannot be closed; take a smaller dt");
  }
  project_velocities(body, states);
}

}  // namespace plumbline
