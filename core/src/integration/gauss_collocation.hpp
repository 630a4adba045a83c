// Integration by collocation at Gauss points, in extended precision, for references.
//
// Over each step the derivative of the state is a polynomial of degree 11 that agrees with the field at the twelve
// Gauss points of the step. The end of a step is then right to order 24, and the polynomial itself to order 13
// everywhere: it is the dense output, so that samples cost nothing and do not shorten steps. Source: Hairer, Lubich,
// Wanner, Geometric Numerical Integration, 2nd ed. 2006, sections II.1.4 and VIII.6 (their solution by fixed points).
//
// The stages are solved by iteration, velocities before places, each from the newest: the error falls by (h omega)^2
// / 50 or so each time, and the polynomial of the step before is the first guess. So the field must not be stiff: the
// step is bounded by what the iteration stands, about h |lambda| < 5.
//
// Step size. The derivative is expanded in Legendre polynomials; how its last coefficients fall tells what the
// first one left out would be. Steps are such that it is worth kTolerance of the scales. After each step places and
// velocities are put back onto the joints.
#pragma once

#include <vector>

#include "extended_motion.hpp"

namespace plumbline::extended {

class GaussCollocation {
 public:
  static constexpr int kStages = 12;

  // From the state (x, u) at t = 0. The motion is referred to. Steps end at `stop`, beyond which forces need not be
  // defined; later times can be asked for all the same.
  GaussCollocation(Motion& motion, Column x, Column u, Real stop);

  // The state at that time >= 0; what has been integrated is kept, so that times may come in any order. Throws
  // std::runtime_error with the time reached when the motion is singular, stiff beyond reason or not finite there.
  void read(Real t, Column& x, Column& u);

  std::size_t evaluations() const { return evaluations_; }
  std::size_t steps() const { return steps_; }

 private:
  using Stages = Eigen::Matrix<Real, Eigen::Dynamic, kStages>;
  struct Step {
    Real t, h;
    Column x, u;    // at its beginning
    Stages dx, du;  // coefficients of the derivatives in Legendre polynomials
  };
  struct Attempt {
    bool converged = false;
    int iterations = 0;
    Real error = 0;  // over kTolerance
  };

  void advance();
  Attempt attempt(Real h);
  void guess(Real h);
  Real truncation(Real h) const;
  void evaluate(const Step& step, Real t, Column& x, Column& u) const;
  void set_scales();

  Motion& motion_;
  Real stop_, h_ = 0;
  Real noise_;  // rounding of the field, relative
  Real t_ = 0;
  Column x_, u_, start_x_, start_u_;
  Column x_scale_, u_scale_;
  Stages x_stage_, u_stage_, dx_, du_, dx_coefficients_, du_coefficients_;
  Column newest_, newest_rate_;
  std::vector<Step> kept_;
  std::size_t evaluations_ = 0, steps_ = 0;
};

}  // namespace plumbline::extended
