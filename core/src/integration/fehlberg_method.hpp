// A second method for references: Boost.Odeint's Runge-Kutta-Fehlberg pair of order 7(8), in extended precision.
#pragma once

#include <vector>

#include "extended_motion.hpp"

namespace plumbline::extended {

class FehlbergMethod {
 public:
  // From the state (x, u) at t = 0. The motion is referred to.
  FehlbergMethod(Motion& motion, Column x, Column u);
  // Throws std::runtime_error with the time reached when steps underflow. Puts the state back onto the joints.
  void advance_to(Real t);
  const Column& x() const { return x_; }
  const Column& u() const { return u_; }

 private:
  Motion& motion_;
  Real t_ = 0, h_;
  Column x_, u_;
};

}  // namespace plumbline::extended
