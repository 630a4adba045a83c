#include "plumbline/core/joints/joint_equations.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "joint_conditions.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

BodyState end_of(std::size_t body, std::span<const BodyState> states) {
  return body == kWorld ? BodyState{} : states[body];
}

// Angle from x_A to x_B about z_A. Where the z axes agree it changes with z_A . (w_B - w_A).
JointRow hinge_angle(const PlacedJoint& j) {
  const Vec3 x_A = j.axes_A.col(0), y_A = j.axes_A.col(1), z_A = j.axes_A.col(2), x_B = j.axes_B.col(0);
  const double angle = std::atan2(y_A.dot(x_B), x_A.dot(x_B));
  return {j.a, j.b, angle, Vec3::Zero(), -z_A, z_A, (j.w_B - j.w_A).dot(j.w_A.cross(z_A))};
}

// With c = z_A x z_B, |c| = sin and n = c/|c|: the angle changes with n . (w_B - w_A), and n' is c' without its part
// along n, over |c|.
JointRow swing_angle(const PlacedJoint& j) {
  const Vec3 z_A = j.axes_A.col(2), z_B = j.axes_B.col(2);
  const Vec3 c = z_A.cross(z_B);
  const double sine = c.norm();
  const double angle = std::atan2(sine, z_A.dot(z_B));
  if (sine == 0) return {j.a, j.b, angle, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0};
  const Vec3 n = c / sine;
  const Vec3 c_rate = j.w_A.cross(z_A).cross(z_B) + z_A.cross(j.w_B.cross(z_B));
  const Vec3 n_rate = (c_rate - n * n.dot(c_rate)) / sine;
  return {j.a, j.b, angle, Vec3::Zero(), -n, n, (j.w_B - j.w_A).dot(n_rate)};
}

void append(const Joint& joint, std::span<const BodyState> states, std::vector<JointRow>& rows) {
  const PlacedJoint placed(joint, states);
  switch (joint.kind) {
    case JointKind::kBall:
      return append_ball(placed, rows);
    case JointKind::kHinge:
      return append_hinge(placed, rows);
    case JointKind::kSlider:
      return append_slider(placed, rows);
    case JointKind::kFixed:
      return append_fixed(placed, rows);
    case JointKind::kDistance:
      return append_distance(placed, joint.length, rows);
  }
}

}  // namespace

PlacedJoint::PlacedJoint(const Joint& joint, std::span<const BodyState> states) : a(joint.a), b(joint.b) {
  const BodyState A = end_of(a, states), B = end_of(b, states);
  w_A = A.w_WB;
  w_B = B.w_WB;
  r_A = A.q_WB * joint.on_a.anchor;
  r_B = B.q_WB * joint.on_b.anchor;
  axes_A = (A.q_WB * joint.on_a.attitude).toRotationMatrix();
  axes_B = (B.q_WB * joint.on_b.attitude).toRotationMatrix();
  gap = B.p_WB + r_B - A.p_WB - r_A;
  gap_rate = B.v_WB + w_B.cross(r_B) - A.v_WB - w_A.cross(r_A);
}

double rate(const JointRow& row, std::span<const BodyState> states) {
  const BodyState A = end_of(row.a, states), B = end_of(row.b, states);
  return row.rate(A.v_WB, A.w_WB, B.v_WB, B.w_WB);
}

std::vector<JointRow> joint_rows(const Joint& joint, std::span<const BodyState> states) {
  std::vector<JointRow> rows;
  append(joint, states, rows);
  return rows;
}

std::vector<JointRow> joint_rows(const ArticulatedBody& body, std::span<const BodyState> states) {
  std::vector<JointRow> rows;
  for (const Joint& joint : body.joints) append(joint, states, rows);
  return rows;
}

double joint_error(const ArticulatedBody& body, std::span<const BodyState> states) {
  double largest = 0;
  for (const JointRow& row : joint_rows(body, states)) largest = max_or_nan(largest, std::abs(row.error));
  return largest;
}

JointRow coordinate_row(const Joint& joint, std::span<const BodyState> states) {
  const PlacedJoint placed(joint, states);
  switch (joint.kind) {
    case JointKind::kBall:
      return swing_angle(placed);
    case JointKind::kHinge:
      return hinge_angle(placed);
    case JointKind::kSlider:
      return travel_along(placed, placed.axes_A.col(2));
    case JointKind::kFixed:
    case JointKind::kDistance:
      break;
  }
  throw std::invalid_argument("a " + std::string(joint_name(joint.kind)) + " joint has no coordinate");
}

}  // namespace plumbline
