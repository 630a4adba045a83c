// The least change of all velocities that gives the joints what they lack: the one solve behind accelerations, impulses
// and restored positions (course slide 36: "minimal motion", here for rigid bodies).
//
//   find the x with J x = b for which x^T M x is least, M = diag(m, m, m, I) of every body
//
// Lagrange's condition says M x = J^T lambda: the change is that of forces (or impulses, or pushes) lambda that act
// through the joints, equal and opposite on the two bodies of each. That is Gauss's principle of least constraint (J.
// reine angew. Math. 4 (1829) 232): the true acceleration is the closest to the free one that the joints allow.
//
// How it is solved. With M = L L^T and Y = L^-1 J^T the problem is Y^T z = b, |z| least, x = L^-T z: the pseudo-inverse
// of Y^T, from a QR decomposition with column pivoting that finds the rank (Golub, Van Loan, Matrix Computations, 4th
// ed. 2013, section 5.5). The textbook's Schur complement J M^-1 J^T would square the condition number, and joints that
// say the same thing twice (a door on two hinges, any planar loop in space) would make it singular. Here such rows
// share the load: of all lambda with the same effect the shortest is taken, rows counted at unit length. The motion
// does not depend on that choice, a single reaction of a redundant joint does.
//
// Cost: about rows^2 x 6 bodies. Readable and robust up to some tens of bodies; a tree is faster in reduced_tree.hpp.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plumbline/core/joints/joint_equations.hpp"

namespace plumbline {

struct Twist {
  Vec3 linear_W = Vec3::Zero();   // [m/s], of the centre of mass
  Vec3 angular_W = Vec3::Zero();  // [rad/s]
};

struct LeastChange {
  std::vector<Twist> change;    // x, one per body
  Eigen::VectorXd multipliers;  // lambda, one per row
  Eigen::Index rank = 0;        // how many of the rows are independent
  // Largest |J x - b| of a row at unit length: 0 but for rounding, unless redundant rows contradict each other.
  double residual = 0;
};

// Rows whose independent part is below this fraction count as repeated: far above rounding and above the drift of a
// good integrator, far below the geometry of any mechanism.
inline constexpr double kRankTolerance = 1e-9;

// `wanted` has one number per row; throws std::invalid_argument when it has not. NaN in, NaN out.
LeastChange least_change(const ArticulatedBody& body, std::span<const BodyState> states, std::span<const JointRow> rows,
                         const Eigen::VectorXd& wanted);

// What a force and a torque about the centre of mass make of the body: f/m and I_W^-1 tau.
Twist answer(const BodyInertia& body, const Quat& q_WB, const Vec3& force_W, const Vec3& torque_W);

// J x: the rate of that row under those changes.
double rate(const JointRow& row, std::span<const Twist> twists);

}  // namespace plumbline
