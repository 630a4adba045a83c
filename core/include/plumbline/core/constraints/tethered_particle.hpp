// A particle on a massless string, every event at its exact time (course slide 33, zero-tolerance policy).
//
// Slack, the particle flies along a parabola until the string goes taut (constraint_events.hpp). There the speed along
// the string is turned round with restitution e; with e = 0, a string that does not stretch, it is lost.
//
// Taut, with r the position from the anchor, |r| = l, the equation of motion and the tension T are
//
//   r'' = g - lambda r,    lambda = T/(m l) = (v^2 + g.r)/l^2 = (v0^2 - 2 g.r0 + 3 g.r)/l^2
//
// (the last form by conservation of energy: it contains no velocity). The string goes slack when lambda falls through
// 0. The equation is quadratic in r, so the Taylor coefficients of r(t) follow from each other by one sum, and those of
// lambda(t) come for free; the motion is continued by Taylor steps of order 24, to rounding. Any direction of motion:
// the plane pendulum, the spherical and the conical one. A pendulum that goes slack at the velocity v flies for
// t = -4 v.g/g^2 before its string is taut again, because the quartic of that flight has a triple zero at its start.
//
// Rule for strings that bounce (0 < e < 1): a rebound slower than 1e-7 sqrt(g l + v^2) along the string counts as none,
// so infinitely many bounces end; the energy so lost is below 1e-14 of the total.
//
// Times and positions: rounding grows with the number of swings, about 1e-14 relative after ten; a string that goes
// taut at a grazing angle is known less well (constraint_events.hpp). Source: Whittaker, Analytical Dynamics, par. 44
// and 55; for Taylor steps Hairer, Norsett, Wanner, Solving ODEs I, I.8.
#pragma once

#include <vector>

#include "plumbline/core/constraints/constraint_events.hpp"

namespace plumbline {

struct Tether {
  Vec3 anchor_W = Vec3::Zero();
  double length = 1;       // [m]
  double restitution = 0;  // 0..1
};

struct TetherEvent {
  enum class Kind { kTaut, kBounce, kSlack };  // kBounce: taut for an instant
  Kind kind;
  double time;  // [s]
};

class TetheredParticle {
 public:
  // Throws std::invalid_argument for a length <= 0, a restitution outside 0..1 and a start beyond the string's length.
  // A start at its length within 1e-12 counts as taut; a speed outwards is then an event at time 0.
  TetheredParticle(const Tether& tether, const Vec3& gravity_W, const Vec3& p_W, const Vec3& v_W);

  // Moves on to that time [s], through all events before it. Throws std::invalid_argument when it lies in the past, and
  // std::runtime_error after 100000 events.
  void advance_to(double time);

  double time() const { return time_; }  // [s]
  const Vec3& position() const { return now_.p_W; }
  const Vec3& velocity() const { return now_.v_W; }
  bool is_taut() const { return taut_; }
  // T/m [N/kg]; 0 when slack.
  double tension_per_mass() const;
  const std::vector<TetherEvent>& events() const { return events_; }

 private:
  void fly_until(double time);
  void swing_until(double time);
  void go_taut();
  double tautness() const;  // lambda [1/s^2]
  double rounding() const;  // of lambda [1/s^2]
  bool pulls() const;

  Tether tether_;
  Flight now_;  // its acceleration is gravity
  double time_ = 0;
  bool taut_ = false;
  int zeros_at_start_ = 0;  // of the quartic of the present flight, at the time when it began
  std::vector<TetherEvent> events_;
};

}  // namespace plumbline
