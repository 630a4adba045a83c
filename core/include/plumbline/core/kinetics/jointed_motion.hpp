// Bodies that joints hold, moved forward by a scheme in maximal coordinates (course slides 32, 35 and 36).
//
// A step takes the accelerations that Newton, Euler and the joints demand together (joints/constrained_motion.hpp),
// goes through it with the scheme's integrator, and puts places and velocities back onto the joints
// (joints/joint_projection.hpp), so that no joint ever comes apart. Limits of joints are plastic stops, met at their
// exact time on the path of the integrator (joints/joint_ranges.hpp). The order is that of the integrator, except that
// velocity Verlet with held forces stays of second order only as long as nothing but gravity acts.
#pragma once

#include <memory>
#include <span>

#include "plumbline/core/integration/stepper.hpp"
#include "plumbline/core/joints/constrained_motion.hpp"
#include "plumbline/core/kinetics/scheme.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

class JointedMotion {
 public:
  // Throws std::invalid_argument where require_valid(ArticulatedBody) does.
  JointedMotion(const Scenario& scenario, Integrator integrator);
  // Advances by dt [s] under wrenches that are held over the step, one per body. Throws std::runtime_error when the
  // joints cannot be closed again: dt is far too large.
  void step(double dt, std::span<const Wrench> wrenches, std::span<BodyState> states);

 private:
  Scenario scenario_;
  ArticulatedBody body_;
  std::shared_ptr<Stepper> stepper_;
};

// One step of any integrator but position Verlet from time t [s]: joints closed, ranges kept. The wrenches are the
// applied ones besides gravity. Throws as JointedMotion::step does.
void step_jointed(const Scenario& scenario, const ArticulatedBody& body, Stepper& stepper, double t, double dt,
                  const WrenchField& wrenches, std::span<BodyState> states);

// The least motion that closes all joints in place and in velocity; fixed bodies go back to where they are stated, and
// the coordinates of the joints `held_ranges` onto their nearer limit. Throws std::runtime_error when that fails.
void back_onto_joints(const Scenario& scenario, const ArticulatedBody& body, std::span<BodyState> states,
                      std::span<const std::size_t> held_ranges = {});

}  // namespace plumbline
