// Joints in extended precision, and written from another starting point than joints/joint_equations.hpp, so that the
// two check each other. There, rows are built from cross products of relative velocities. Here every condition is a
// scalar product of two moving vectors,
//
//   C = a.b,   C' = a'.b + a.b',   C'' = a''.b + 2 a'.b' + a.b''
//
// with a, b axes of the frames, the fixed axes of W, or d, the way from A's anchor to B's:
//
//   ball      e_x.d = e_y.d = e_z.d = 0                        (e: axes of W)
//   hinge     those, x_A.z_B = y_A.z_B = 0
//   slider    x_A.d = y_A.d = 0, x_A.z_B = y_A.z_B = x_A.y_B = 0
//   fixed     e.d = 0, y_A.z_B = z_A.x_B = x_A.y_B = 0
//   distance  (d.d - L^2)/(2L) = 0
//
// Multipliers solve  J M^-1 J^T lambda = -(J a_free + bias)  in maximal coordinates, linear in W, angular in body axes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "plumbline/core/joints/joint.hpp"
#include "semidefinite_solver.hpp"

namespace plumbline::extended {

using Vector3 = Eigen::Matrix<Real, 3, 1>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Quaternion = Eigen::Quaternion<Real>;

// A body as it is now, and what it is.
struct Placed {
  Vector3 p = Vector3::Zero(), v = Vector3::Zero();      // [m], [m/s] in W
  Vector3 w_W = Vector3::Zero(), w_B = Vector3::Zero();  // [rad/s]
  Matrix3 R = Matrix3::Identity();                       // columns: body axes in W
  Real inverse_mass = 0;                                 // 0: the world
  Vector3 inverse_inertia = Vector3::Zero();             // principal
};

// One condition: C' = force . (v_B - v_A) + torque_A . w_A + torque_B . w_B, torques and w in the axes of their bodies.
struct Condition {
  Vector3 force, torque_A, torque_B;
  Real value = 0;  // C [m] or [1]
  Real bias = 0;   // C'' where neither body accelerates
};

class JointSystem {
 public:
  // `joints` name bodies by their place in the spans that all functions take, or kWorld.
  explicit JointSystem(const std::vector<Joint>& joints);

  bool empty() const { return joints_.empty(); }

  // a: 6 numbers a body, accelerations in W and angular ones in body axes, without joints; leaves with them.
  void accelerate(std::span<const Placed> bodies, Column& a);
  // The least displacement (6 a body, as velocities) that closes what is open to first order; returns the largest |C|.
  Real close_places(std::span<const Placed> bodies, Column& displacement);
  // The least change of velocities that makes J u = 0; returns the largest |J u|.
  Real close_velocities(std::span<const Placed> bodies, Column& change);

  // The angle of a hinge, in (-pi, pi], or the travel of a slider, as a condition on it.
  Condition coordinate(std::size_t joint, std::span<const Placed> bodies) const;
  static Real rate(const Condition& c, const Placed& A, const Placed& B);

 private:
  struct Frame {
    Vector3 anchor;
    Matrix3 axes;
  };
  struct Tie {
    JointKind kind;
    std::size_t a, b;
    Frame on_a, on_b;
    Real length;
    Eigen::Index first_row;
  };
  struct Meeting {  // of two joints at a body
    std::size_t joint, other, body;
    bool as_b, other_as_b;
  };
  struct Ends;

  Ends ends(const Tie& tie, std::span<const Placed> bodies) const;
  void write(const Tie& tie, std::span<const Placed> bodies);
  // From right_ to the multipliers, and from these to M^-1 J^T lambda, added to `change`.
  void factor(std::span<const Placed> bodies);
  void push(std::span<const Placed> bodies, Column& change);
  Real rate_of(const Tie& tie, Eigen::Index row, std::span<const Placed> bodies) const;

  std::vector<Tie> joints_;         // in the order of elimination
  std::vector<std::size_t> place_;  // of each joint of the scenario in it
  std::vector<Meeting> meetings_;
  std::vector<Condition> rows_;
  SemidefiniteSolver solver_;
  Column right_;
};

}  // namespace plumbline::extended
