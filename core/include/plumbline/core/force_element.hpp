// Force elements: springs, dampers and motors, as plain values (course slide 33 uses stiff ones as penalties).
//
// A spring pulls two points together along the line between them. On the coordinate q of a hinge (angle) or slider
// (travel), as joints/joint_equations.hpp defines it, act springs, dampers and motors:
//
//   Spring        force on B's point: -(k (l - l0) + c dl/dt) n,  n from A's point to B's, l its length
//   JointSpring   torque about the hinge or force along the slider, on B: -(k (q - q0) + c dq/dt)
//   JointDrive    torque or force on B, a stated function of t, q and dq/dt
//
// and the opposite on A. They are part of the stated problem: an engine that has them computes them within its step
// (features kSpring, kJointSpring), any other is handed their value at the beginning of each step as forces.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "plumbline/core/joints/joint.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

struct Spring {
  std::string name;
  std::size_t a = kWorld, b = 0;  // b is never the world
  Vec3 on_a = Vec3::Zero();       // the points, in body axes from the centre of mass; in W for the world [m]
  Vec3 on_b = Vec3::Zero();
  double stiffness = 0;  // k >= 0 [N/m]
  double damping = 0;    // c >= 0 [N s/m]
  double length = 0;     // l0 >= 0, at which it does not pull [m]; 0: the force is -k times the vector
};

struct JointSpring {
  std::size_t joint = 0;  // place in Scenario::joints, a hinge or slider
  double stiffness = 0;   // k >= 0 [N m/rad] or [N/m]
  double damping = 0;     // c >= 0 [N m s/rad] or [N s/m]
  double rest = 0;        // q0 [rad] or [m]
};

struct JointDrive {
  std::size_t joint = 0;                                          // a hinge or slider
  std::function<double(double t, double q, double rate)> effort;  // [N m] or [N]
  std::string text;                                               // as written, for people
};

// Added to the wrenches of the bodies that it ties; one entry per body in both spans. Where the two points of a spring
// meet it has no direction and does not damp.
void add_wrenches(const Spring& spring, std::span<const BodyState> states, std::span<Wrench> wrenches);
void add_wrenches(const Joint& joint, double effort, std::span<const BodyState> states, std::span<Wrench> wrenches);

// -(k (q - q0) + c dq/dt) in those states.
double effort_of(const JointSpring& spring, const Joint& joint, std::span<const BodyState> states);

// What a spring has stored [J].
double stored_energy(const Spring& spring, std::span<const BodyState> states);
double stored_energy(const JointSpring& spring, const Joint& joint, std::span<const BodyState> states);

}  // namespace plumbline
