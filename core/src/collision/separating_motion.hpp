// A separating axis on its way: for how long will the plane between two moving polyhedra certainly keep them apart?
#pragma once

#include <vector>

#include "plumbline/core/collision/time_of_impact.hpp"
#include "posed_polyhedron.hpp"

namespace plumbline {

// Two bodies at one instant. All positions are seen from A's centre.
struct MovingPair {
  PosedPolyhedron a, b;
  Vec3 w_A, w_B;                // angular velocities [rad/s]
  Vec3 velocity, acceleration;  // of B's centre relative to A's [m/s], [m/s^2]

  MovingPair(const ConvexPolyhedron& shape_a, const Motion& motion_a, const ConvexPolyhedron& shape_b,
             const Motion& motion_b);
  void move_to(double t);

 private:
  Quat attitude_a_, attitude_b_;
  Vec3 position_, velocity_;  // of B relative to A at the start
};

// A direction that turns with the bodies, from B to A, and how fast it may do so from now on.
struct TurningDirection {
  enum class Rides { kOnA, kOnB, kOnBoth };
  Rides rides;   // fixed to A, fixed to B, or the cross product of an edge of each
  Vec3 m;        // now [1]
  Vec3 m_rate;   // [1/s]
  double speed;  // bound of |m'| at all times [1/s]
  double bend;   // bound of |m''| at all times [1/s^2]
};

TurningDirection direction_of(const SeparatingAxis& axis, const MovingPair& pair);

// The same direction as it is now, but fixed to A from now on.
TurningDirection riding_on_a(const Vec3& normal, const MovingPair& pair);

// What the direction sees of the gap in the time s to come: the lowest corner of A over the highest of B, each on its
// way, less what they and the direction can bend towards each other:
//   gap(s) >= min_i (above_i + above_i' s) + min_j (below_j + below_j' s) - bend s^2/2,  0 <= s <= until.
class GapBound {
 public:
  GapBound(const MovingPair& pair, const TurningDirection& direction, double until);

  // The last time up to which the gap is certainly not below `floor` [m], which is not above the gap now.
  double time_above(double floor) const;

  // The rate at which the gap changes now [m/s], counting all corners within `tolerance` [m] of the lowest.
  double rate(double tolerance) const;

 private:
  struct Line {
    double value, slope;  // [m], [m/s]
  };
  static Line lowest(const std::vector<Line>& lines, double s);
  static double slope_of_lowest(const std::vector<Line>& lines, double tolerance);

  std::vector<Line> above_, below_;  // heights of A's corners, depths of B's
  double bend_;                      // [m/s^2]
  double until_;                     // [s]
};

}  // namespace plumbline
