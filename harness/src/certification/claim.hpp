// What a reference claims of itself, in SI units: how far each kind of number may be off.
#pragma once

#include <string>
#include <vector>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// Up to the end of the duration, or to the time from which chaos forbids a comparison.
double compared_until(const Scenario& scenario);

std::vector<BodyState> states_of(const Scenario& scenario, const Reference& reference, double t);

// Largest sizes that the motion reaches, never below the scenario's scales.
struct Extent {
  double place = 0;     // [m]
  double speed = 0;     // [m/s]
  double spin = 0;      // [rad/s]
  double momentum = 0;  // sum of m |v| over the bodies [kg m/s]
};
Extent extent_of(const Scenario& scenario, const Reference& reference, double until);

// A reference states how far its places are off, relative to the length scale. The same share is granted to velocities
// and angular velocities, of the largest that occur, and to attitudes in radian; and 64 roundings of the largest
// numbers that such an evaluation handles.
struct Claim {
  Extent extent;
  double place = 0;     // [m]
  double velocity = 0;  // [m/s]
  double attitude = 0;  // [rad]
  double spin = 0;      // [rad/s]
};
Claim claim_of(const Scenario& scenario, const Reference& reference, double until);

// The largest difference of two states in each kind of number, over the bodies that move. NaN sticks.
struct Differences {
  double place = 0, velocity = 0, attitude = 0, spin = 0;
};
Differences differences(const Scenario& scenario, const std::vector<BodyState>& a, const std::vector<BodyState>& b);
Differences larger(const Differences& a, const Differences& b);

// Found differences and what they may be: keeps the kind that is nearest to its bound.
struct Worst {
  double figure = 0, bound = 0;  // relative to a scale
  std::string what;
  double ratio = -1;
  void offer(double difference, double allowed, double scale, const std::string& text);
  // All four kinds, in units of the scenario's length, speed, radian, and inverse time.
  void offer(const Differences& found, const Differences& allowed, const Extent& extent, const std::string& text);
};

}  // namespace plumbline
