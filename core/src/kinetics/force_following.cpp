#include "plumbline/core/kinetics/force_following.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "plumbline/core/integration/stepper_table.hpp"
#include "plumbline/core/joints/constrained_motion.hpp"
#include "plumbline/core/kinetics/jointed_motion.hpp"
#include "plumbline/core/mass/newton_euler.hpp"
#include "plumbline/core/response/impulse.hpp"

namespace plumbline {

AccelerationField acceleration_field(const Scenario& scenario, GyroscopicTerm gyroscopic) {
  if (!scenario.joints.empty()) {
    return constrained_field(articulated_body(scenario),
                             [scenario](double t, std::span<const BodyState> states, std::span<Wrench> wrenches) {
                               evaluate_forces(scenario, t, states, wrenches);
                             });
  }
  return [scenario, gyroscopic, wrenches = std::vector<Wrench>(scenario.bodies.size())](
             double t, std::span<const BodyState> states, std::span<Acceleration> accelerations) mutable {
    evaluate_forces(scenario, t, states, wrenches);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Body& body = scenario.bodies[i];
      accelerations[i] = {};
      if (body.fixed) continue;
      const Quat& q_WB = states[i].q_WB;
      const Mat3 inverse_inertia_W = inertness_of(body, q_WB).inverse_inertia_W;
      accelerations[i].linear = scenario.gravity + wrenches[i].f_W / body.mass;
      accelerations[i].angular = gyroscopic == GyroscopicTerm::kNone
                                     ? Vec3(inverse_inertia_W * wrenches[i].tau_W)
                                     : angular_acceleration(inertia_in_world(body, q_WB), inverse_inertia_W,
                                                            states[i].w_WB, wrenches[i].tau_W);
    }
  };
}

std::unique_ptr<Stepper> make_stepper(Integrator integrator) { return make_stepper(name(integrator)); }

Trajectory follow_forces(const Scenario& scenario, const Scheme& scheme, double dt) {
  require_possible(scheme, scenario);
  Trajectory trajectory(dt, scenario.bodies.size());
  const std::size_t steps = scenario.step_count(dt);
  trajectory.reserve(steps + 1);
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) {
    require_mass(body);
    states.push_back(body.initial);
  }
  const auto record = [&] { std::copy(states.begin(), states.end(), trajectory.append().begin()); };
  record();
  const AccelerationField field = acceleration_field(scenario, scheme.gyroscopic);
  const std::unique_ptr<Stepper> stepper = make_stepper(scheme.integrator);
  const ArticulatedBody body = articulated_body(scenario);
  const WrenchField wrenches = [&](double t, std::span<const BodyState> at, std::span<Wrench> applied) {
    evaluate_forces(scenario, t, at, applied);
  };
  const double h = dt / scheme.substeps;
  for (std::size_t k = 0; k < steps; ++k) {
    for (int j = 0; j < scheme.substeps; ++j) {
      const double t = trajectory.time(k) + j * h;
      if (scenario.joints.empty()) {
        stepper->step(field, t, h, states);
      } else {
        step_jointed(scenario, body, *stepper, t, h, wrenches, states);
      }
    }
    record();
  }
  return trajectory;
}

}  // namespace plumbline
