// The motion of bodies as one first-order system y' = f(t, y), for solvers that know vectors only.
//
// y holds 13 numbers a body, in the order of BodyState: p, q (x y z w), v, w.
//
//   p' = v,   q' = 1/2 (0, w) q,   v' = a,   w' = alpha
//
// Here the attitude is a plain vector of four numbers. Its equation keeps |q| exactly, so a solver of high order at a
// tight tolerance leaves the unit sphere by its own error only; the field is always shown q/|q|, and so is who reads
// the states. At coarse steps this would not do: there the integrators behind Stepper turn on the group (attitude.hpp).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plumbline/core/integration/stepper.hpp"

namespace plumbline {

class BodyEquations {
 public:
  // The field is referred to, not copied.
  BodyEquations(const AccelerationField& field, std::size_t bodies);

  // Right-hand side of that system; y and dy have 13 components a body.
  void operator()(double t, const Eigen::VectorXd& y, Eigen::VectorXd& dy) const;

  static Eigen::VectorXd pack(std::span<const BodyState> states);
  // Attitudes come out as unit quaternions.
  static void unpack(const Eigen::VectorXd& y, std::span<BodyState> states);

 private:
  const AccelerationField& field_;
  mutable std::vector<BodyState> states_;
  mutable std::vector<Acceleration> a_;
};

}  // namespace plumbline
