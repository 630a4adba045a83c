#include "plumbline/core/integration/velocity_verlet.hpp"

#include "plumbline/core/integration/attitude.hpp"

namespace plumbline {

void VelocityVerlet::step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) {
  require_step(t, dt);
  a_.resize(states.size());
  a_end_.resize(states.size());
  field(t, states, a_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    BodyState& s = states[i];
    s.p_WB += dt * (s.v_WB + 0.5 * dt * a_[i].linear);
    s.q_WB = turned(s.q_WB, dt * (s.w_WB + 0.5 * dt * a_[i].angular));
    s.v_WB += dt * a_[i].linear;  // the predictor
    s.w_WB += dt * a_[i].angular;
  }
  field(t + dt, states, a_end_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].v_WB += 0.5 * dt * (a_end_[i].linear - a_[i].linear);
    states[i].w_WB += 0.5 * dt * (a_end_[i].angular - a_[i].angular);
  }
}

}  // namespace plumbline
