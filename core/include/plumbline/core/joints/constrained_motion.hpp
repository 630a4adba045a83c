// Articulated bodies in maximal coordinates: every body keeps its 13 numbers, and the joints act by forces (course
// slides 32 and 35: constraints between bodies; forces travel through the constraints).
//
//   M a = f + J^T lambda        Newton and Euler, with the gyroscopic term in f
//   J a = -Jdot v               what the joints demand of accelerations
//
// Solved by least_change.hpp: a = a_free + the least change that makes J a = -Jdot v. Loops and redundant joints need
// nothing special. Source: Shabana, Dynamics of Multibody Systems, 4th ed. 2013, chapter 3 (augmented formulation).
//
// The joints are held at the level of accelerations only, so that what an integrator does wrong stays: the error of a
// joint grows like that of the positions. `joint_projection.hpp` puts it right, as a choice of the caller.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "plumbline/core/integration/stepper.hpp"
#include "plumbline/core/joints/least_change.hpp"

namespace plumbline {

// What a joint does to its body b; body a or the world gets the opposite, at the same point.
struct JointReaction {
  Vec3 f_W = Vec3::Zero();    // force [N]
  Vec3 tau_W = Vec3::Zero();  // torque about B's anchor [N m]
};

struct ConstrainedAccelerations {
  std::vector<Acceleration> accelerations;  // one per body
  std::vector<JointReaction> reactions;     // one per joint
  std::vector<double> range_forces;         // one per held range: > 0 drives the coordinate up [N] or [N m]
  Eigen::Index rank = 0;                    // independent rows: 6 bodies - rank is the number of degrees of freedom
};

// Accelerations and reactions in these states, which should satisfy the joints and their rates. `wrenches` are the
// applied ones besides gravity, one per body, or empty. `held_ranges` names joints whose coordinate is kept where it
// is, as one that leans on its limit. Throws std::invalid_argument when numbers of bodies differ.
ConstrainedAccelerations constrained_accelerations(const ArticulatedBody& body, std::span<const BodyState> states,
                                                   std::span<const Wrench> wrenches = {},
                                                   std::span<const std::size_t> held_ranges = {});

// Applied wrenches at time t [s], besides gravity.
using WrenchField = std::function<void(double t, std::span<const BodyState>, std::span<Wrench>)>;

// The same as a field for any Stepper and for integrate_reference(). Copies the body; throws as require_valid() does.
AccelerationField constrained_field(const ArticulatedBody& body, WrenchField wrenches = {},
                                    std::vector<std::size_t> held_ranges = {});

// An impulse [N s] on one body at a point of W: changes the velocities of all bodies that joints lead to. What the
// states lacked at their joints before stays as it is. Returns the impulses of the joints [N s], [N m s]. Throws
// std::invalid_argument when there is no such body.
std::vector<JointReaction> apply_impulse(const ArticulatedBody& body, std::span<BodyState> states, std::size_t on_body,
                                         const Vec3& point_W, const Vec3& impulse_W);

// The reactions that the multipliers of joint_rows(body, states) stand for.
std::vector<JointReaction> reactions(const ArticulatedBody& body, std::span<const BodyState> states,
                                     std::span<const JointRow> rows, const Eigen::VectorXd& multipliers);

}  // namespace plumbline
