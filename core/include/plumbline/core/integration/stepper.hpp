// One interface for every integrator of the course (slides 26-30, 39-41), for particles and rigid bodies alike.
//
// The equations of motion come in as accelerations that may depend on time and on all states. A particle is a body
// whose attitude stays the identity and whose angular acceleration is zero: nothing else is needed to step one.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "plumbline/core/state.hpp"

namespace plumbline {

struct Acceleration {
  Vec3 linear = Vec3::Zero();   // of the centre of mass, in W [m/s^2]
  Vec3 angular = Vec3::Zero();  // dw/dt, in W [rad/s^2]
};

// Writes the accelerations of all bodies at time t [s] in these states; both spans hold one entry per body.
using AccelerationField =
    std::function<void(double t, std::span<const BodyState> states, std::span<Acceleration> accelerations)>;

// A step keeps attitudes on the group: each file says how (unit quaternions, q <- exp(phi) q).
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual std::string_view name() const = 0;  // "explicit Euler"
  // The power of dt with which the error over a fixed time falls (not that of one step, which is one higher).
  virtual int order() const = 0;
  // Advances all states from t by dt [s]; a negative dt goes back in time. Throws std::invalid_argument unless t and dt
  // are finite and dt is not zero.
  virtual void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) = 0;
  // Forgets what earlier steps left behind (position Verlet keeps its previous positions). Call it when states were
  // changed from outside, by an impact for example, or when dt changes.
  virtual void restart() {}
};

// What every step() asks first: throws std::invalid_argument unless t and dt are finite and dt is not zero.
void require_step(double t, double dt);

}  // namespace plumbline
