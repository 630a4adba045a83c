// Articulated bodies in reduced coordinates: only what can move is a number, so no joint can ever come apart.
//
//   M(q) q'' + c(q, q') = tau      q: angles of hinges [rad] and travels of sliders [m], from the world outwards
//
// This is the exact reference for trees: integrated by Dormand-Prince at 1e-14 (integration/dormand_prince.hpp) there
// is no drift, no projection and no redundant equation.
//
// Algorithms (Featherstone, Rigid Body Dynamics Algorithms, 2008, sections 2, 5.3, 6.2, 7.1): with velocities as pairs
// (w, velocity of the body's point at the origin of W) and forces as pairs (torque about that origin, force), every
// joint moves all that hangs on it by S_k q_k', and
//
//   recursive Newton-Euler   V = V_parent + S q',  A = A_parent + S q'' + V x S q';  F = I A + V x* I V; tau = S . F
//   composite rigid bodies   M_jk = S_j . I_k S_k with I_k the inertia of joint k and all beyond it, j an ancestor of k
//
// All pairs refer to one point, the origin of W, so that inertias simply add. The price: far away from it digits are
// lost, as (distance/size)^2 2^-53; keep the mechanism near the origin.
//
// Range of validity: trees of hinge, slider and fixed joints; joint k has b = k and a < k or the world. A ball joint is
// three hinges with two bodies of mass 0 between them, apart from the attitude where first and third axis line up (a
// gimbal lock); a free body is three sliders and such a ball. Bodies of mass 0 and point masses are allowed as long as
// every joint moves some inertia.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plumbline/core/integration/stepper.hpp"
#include "plumbline/core/joints/joint.hpp"

namespace plumbline {

class ReducedTree {
 public:
  using Vector = Eigen::VectorXd;

  // Throws std::invalid_argument, with the way out, when the joints are no such tree. Ranges are not read.
  explicit ReducedTree(const ArticulatedBody& body);

  Eigen::Index freedoms() const { return freedoms_; }
  // Place of joint k in q; -1 for a fixed one.
  Eigen::Index coordinate(std::size_t joint) const { return coordinate_.at(joint); }

  Eigen::MatrixXd mass_matrix(const Vector& q) const;
  // The tau that makes the tree accelerate by qdd, gravity included: M qdd + c. With qdd = 0 it is the bias c.
  Vector inverse_dynamics(const Vector& q, const Vector& qd, const Vector& qdd) const;
  // q''. Throws std::runtime_error where M is singular: some joint moves no inertia.
  Vector accelerations(const Vector& q, const Vector& qd, const Vector& tau) const;
  Vector accelerations(const Vector& q, const Vector& qd) const {
    return accelerations(q, qd, Vector::Zero(freedoms_));
  }

  // y' = f(t, y) with y = (q, q') and no joint forces, for DormandPrince<Eigen::VectorXd>.
  void operator()(double t, const Vector& y, Vector& dy) const;

  std::vector<BodyState> states(const Vector& q, const Vector& qd) const;
  std::vector<Acceleration> body_accelerations(const Vector& q, const Vector& qd, const Vector& qdd) const;
  double energy(const Vector& q, const Vector& qd) const;  // kinetic + potential [J]

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  // A body where q and q' put it.
  struct Placed {
    Mat3 R;    // R_WB
    Vec3 p_W;  // centre of mass
    Vec6 S;    // what the joint adds to V at q' = 1; zero when fixed
    Vec6 V;    // (w, velocity at the origin)
    Vec6 A;    // (dw/dt, acceleration field at the origin)
  };
  std::vector<Placed> place(const Vector& q, const Vector& qd, const Vector& qdd, const Vec3& base_acceleration) const;
  Mat6 inertia_at_origin(std::size_t body, const Placed& placed) const;

  ArticulatedBody body_;
  std::vector<Eigen::Index> coordinate_;
  Eigen::Index freedoms_ = 0;
};

}  // namespace plumbline
