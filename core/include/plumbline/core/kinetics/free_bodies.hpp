// Many rigid bodies in free flight at once: the fast path of the smooth half of the simulator.
//
// The same scheme as Simulator's semi-implicit Euler with the explicit gyroscopic term, for bodies that feel gravity
// and nothing else, and the same result to rounding. Three things make it fast:
//
// - one array per number instead of one record per body, so that a vector unit advances 2, 4 or 8 bodies at once;
// - the angular velocity kept in the body frame, where Euler's equation needs no rotation: w' = w + h c (w x w), with
//   c_1 = (I_2 - I_3)/I_1 and so on, and q <- q exp(w' h), which is exp(w'_W h) q;
// - neither root nor division nor sine: the rotation of a small angle is a power series in its square, and a quaternion
//   whose squared length n is 1 but for rounding is normalised by the factor (3 - n)/2.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "plumbline/core/body.hpp"

namespace plumbline {

class FreeBodies {
 public:
  // Throws std::invalid_argument for a body that is fixed or lacks a mass or a positive moment of inertia.
  FreeBodies(std::span<const Body> bodies, const Vec3& gravity_W);

  std::size_t size() const { return size_; }
  // Advances all bodies by `steps` steps of dt > 0 [s]. Several steps at once are faster than as many calls: bodies do
  // not know each other, so a few hundred of them go through all steps while they are in the nearest cache.
  void step(double dt, std::size_t steps = 1);
  // Throws std::invalid_argument unless there is room for exactly size() states.
  void read(std::span<BodyState> states) const;

 private:
  // Rows of the table of numbers: position, attitude (x y z w), velocity, angular velocity in B, gyroscopic
  // coefficients.
  enum Row : std::size_t { kP = 0, kQ = 3, kV = 7, kW = 10, kC = 13, kRows = 16 };
  std::array<double*, kRows> rows();

  Vec3 gravity_W_;
  std::size_t size_ = 0;
  std::size_t stride_ = 0;      // numbers of a row, a multiple of a cache line
  std::vector<double> values_;  // row after row
};

}  // namespace plumbline
