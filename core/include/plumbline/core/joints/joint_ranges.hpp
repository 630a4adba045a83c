// Joints with a range: an elbow that does not bend backwards (course slides 32, 33 and 35), by the zero-tolerance
// policy of slide 33: the step is cut at the moment when a limit is reached, the impact happens there, and motion goes
// on.
//
// The impact. Joint impulses and those of the limits act at once on all bodies. With r_i the rate of a reached
// coordinate, counted inwards, and u_i = -r_i > 0 its approach:
//
//   J_i >= 0,   r_i >= e u_i,   J_i (r_i - e u_i) = 0           (a limit pushes and never pulls)
//
// which is the law of contacts, with a joint angle in the place of a distance. Kinetic energy never grows for one limit
// at a time; several at once follow Newton's law, each by its own e.
//
// Rest. A rebound slower than rest_speed is none: the Zeno rule for a limb that lies on its limit. A coordinate that
// rests on its limit is held like a joint while the limit has to push, which is asked at the start of each step.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "plumbline/core/joints/constrained_motion.hpp"

namespace plumbline {

struct RangeRule {
  double restitution = 0;    // e in [0, 1]
  double rest_speed = 1e-6;  // [rad/s] or [m/s]
};

// A limit of joint `joint`: the lower one pushes the coordinate up (sense +1), the upper one down (-1).
struct RangeLimit {
  std::size_t joint = 0;
  double sense = 1;
};

// Room [rad] or [m] between a coordinate and its limit, negative beyond it; rate at which it grows.
double room(const ArticulatedBody& body, const RangeLimit& limit, std::span<const BodyState> states);
double room_rate(const ArticulatedBody& body, const RangeLimit& limit, std::span<const BodyState> states);

// Every limit that the body has; the lower one of a ball joint's swing, 0, is none.
std::vector<RangeLimit> range_limits(const ArticulatedBody& body);

// The impact at all limits with room <= touch that are approached. Returns the impulses [N m s] or [N s] that the
// limits gave, one per entry of range_limits(). Throws std::invalid_argument for e outside of [0, 1].
std::vector<double> resolve_range_impacts(const ArticulatedBody& body, std::span<BodyState> states,
                                          const RangeRule& rule, double touch = 1e-9);

// What puts bodies back onto their joints, and the coordinates of the joints `held` onto the limit that they rest on,
// after an integrator has gone ahead: it cannot follow a turning axis exactly.
using Closing = std::function<void(std::span<BodyState> states, std::span<const std::size_t> held)>;

// One step of dt > 0 [s] that stops at each limit on its way. States must satisfy joints and ranges. Moments of impact
// are found on the stepper's own path, until the room left is below 1e-12; a coordinate that leaves and re-enters its
// range within one step is not seen. `close` is called after every try of a step, before its room is measured. Only for
// steppers that need no previous step (not position Verlet), since steps are tried and cut. Returns the number of
// impacts. Throws std::runtime_error after 100 in one step, and std::invalid_argument as Stepper does.
int advance_within_ranges(const ArticulatedBody& body, Stepper& stepper, double t, double dt,
                          std::vector<BodyState>& states, const RangeRule& rule = {}, const WrenchField& wrenches = {},
                          const Closing& close = {});

}  // namespace plumbline
