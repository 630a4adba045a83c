// What a joint demands, in three levels: position, velocity, acceleration (course slides 32 and 36).
//
//   position       C = 0                          C in [m], or in [rad] for small angles (the sine of the angle)
//   velocity       dC/dt = J v = 0                J linear in the velocities of the two bodies
//   acceleration   d2C/dt2 = J a + Jdot v = 0     the bias Jdot v is what is left when both bodies have a = 0
//
// One row of J is also how the joint can push: a multiplier lambda on a row acts with J^T lambda. So a row is written
// as the force and the torques of lambda = 1, and read as the velocity it looks at:
//
//   dC/dt = force . (v_B - v_A) + torque_a . w_A + torque_b . w_B
//
// Action equals reaction because only v_B - v_A enters. Where the anchors meet the torques balance about every point,
// lever x force + torque_a + torque_b = 0, which keeps the angular momentum; with a gap of a ball's, hinge's or fixed
// joint's anchors the pair of forces turns the whole by force times gap. Source: Shabana, Dynamics of Multibody
// Systems, 4th ed. 2013, chapter 3; Baraff, Linear-time dynamics using Lagrange multipliers, SIGGRAPH 1996.
//
// Range of validity: C is meant for small errors. Axes that point in opposite directions also have C = 0.
#pragma once

#include <span>
#include <vector>

#include "plumbline/core/joints/joint.hpp"

namespace plumbline {

struct JointRow {
  std::size_t a = kWorld, b = 0;
  double error = 0;                // C [m] or [rad]
  Vec3 force_W = Vec3::Zero();     // on B at lambda = 1, its opposite on A
  Vec3 torque_a_W = Vec3::Zero();  // on A about its centre of mass
  Vec3 torque_b_W = Vec3::Zero();  // on B about its centre of mass
  double bias = 0;                 // Jdot v [m/s^2] or [rad/s^2]

  // dC/dt for any linear and angular velocities (or accelerations, impulses per inertia, ...).
  double rate(const Vec3& v_A, const Vec3& w_A, const Vec3& v_B, const Vec3& w_B) const {
    return force_W.dot(v_B - v_A) + torque_a_W.dot(w_A) + torque_b_W.dot(w_B);
  }
};

// dC/dt [m/s] or [rad/s] at the velocities of those states.
double rate(const JointRow& row, std::span<const BodyState> states);

// The two ends of a joint as they are in W: what all rows are made of.
struct PlacedJoint {
  PlacedJoint(const Joint& joint, std::span<const BodyState> states);
  std::size_t a, b;
  Vec3 w_A, w_B;        // angular velocities [rad/s]
  Vec3 r_A, r_B;        // from the centres of mass to the anchors [m]
  Mat3 axes_A, axes_B;  // columns: x, y, z of the frames
  Vec3 gap, gap_rate;   // from A's anchor to B's [m], and its rate [m/s]
};

// Added to `rows`, one function and one file a kind: three rows for a ball, five for hinge and slider, six for fixed,
// one for distance.
void append_ball(const PlacedJoint& joint, std::vector<JointRow>& rows);
void append_hinge(const PlacedJoint& joint, std::vector<JointRow>& rows);
void append_slider(const PlacedJoint& joint, std::vector<JointRow>& rows);
void append_fixed(const PlacedJoint& joint, std::vector<JointRow>& rows);
void append_distance(const PlacedJoint& joint, double length, std::vector<JointRow>& rows);

std::vector<JointRow> joint_rows(const Joint& joint, std::span<const BodyState> states);
// Those of all joints, one after the other.
std::vector<JointRow> joint_rows(const ArticulatedBody& body, std::span<const BodyState> states);
// Largest |C| of all joints; NaN sticks.
double joint_error(const ArticulatedBody& body, std::span<const BodyState> states);

// The coordinate that a range bounds, with its rate and bias as a row (error = the coordinate itself):
//   hinge    angle from x_A to x_B about z_A, in (-pi, pi]
//   slider   travel of B's anchor along z_A
//   ball     angle from z_A to z_B, in [0, pi]; at 0 its axis is undefined and the row is 0
// Rates are exact where the joint's own C is 0. Throws std::invalid_argument for a fixed joint and for a distance
// joint.
JointRow coordinate_row(const Joint& joint, std::span<const BodyState> states);

}  // namespace plumbline
