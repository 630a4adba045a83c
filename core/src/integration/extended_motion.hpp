// A scenario's equations of smooth motion in extended precision, for references.
//
// Newton's law in W and Euler's in body axes, I w' = tau - w x I w; springs and joints anew (extended_joints.hpp).
// Force laws and drives are stated in double precision and evaluated there, at the rounded state: what they add is the
// same rounding for every method of integration, about 1e-16 of the force.
//
// A state is two columns over the moving bodies: places x, 7 numbers a body (centre of mass in W, attitude w x y z,
// a plain vector of four numbers as in body_equations.hpp), and velocities u, 6 a body (in W; angular in body axes).
#pragma once

#include "extended_joints.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline::extended {

using Slice = Eigen::Ref<const Column>;

class Motion {
 public:
  // Throws std::invalid_argument for a scenario with contact or ranges of joints: it is not smooth.
  explicit Motion(const Scenario& scenario);

  Eigen::Index moving() const { return static_cast<Eigen::Index>(bodies_.size()); }
  const Scenario& scenario() const { return scenario_; }
  // Whether force laws or drives add the rounding of double precision.
  bool evaluates_in_double() const { return !scenario_.forces.empty() || !scenario_.drives.empty(); }

  // The scenario's initial state, with its roundings put back onto the joints.
  void start(Column& x, Column& u);
  // dx/dt, du/dt
  void rates(const Slice& x, const Slice& u, Eigen::Ref<Column> dx) const;
  void accelerations(Real t, const Slice& x, const Slice& u, Eigen::Ref<Column> du);
  // Attitudes unit, places and velocities on the joints, by the least change. Throws std::runtime_error when the joints
  // cannot be closed.
  void project(Column& x, Column& u);
  // Moves each body by 6 numbers: in W, and a small rotation in body axes.
  void displace(Column& x, const Column& displacement) const;
  // The larger of |p - p'| over the length scale and the angle between attitudes [rad], over all bodies; NaN sticks.
  Real distance(const Slice& x, const Slice& other) const;
  // Of all bodies of the scenario.
  void read(const Slice& x, const Slice& u, std::span<BodyState> states) const;

 private:
  void place(const Slice& x, const Slice& u);
  void apply_forces(Real t);
  void apply(const Spring& spring);
  void apply(std::size_t joint, Real effort, const Condition& on);
  std::size_t moving_index(std::size_t body) const { return body == kWorld ? kWorld : index_[body]; }

  Scenario scenario_;
  std::vector<std::size_t> bodies_;  // the moving ones
  std::vector<std::size_t> index_;   // of each body among these, or kWorld
  std::vector<Vector3> inertia_;
  std::vector<Placed> placed_;
  std::vector<Vector3> force_, torque_;  // in W; in body axes
  std::vector<BodyState> rounded_;
  JointSystem joints_;
  Column free_, step_;
};

}  // namespace plumbline::extended
