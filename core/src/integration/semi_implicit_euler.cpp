#include "plumbline/core/integration/semi_implicit_euler.hpp"

#include "plumbline/core/integration/attitude.hpp"

namespace plumbline {

void SemiImplicitEuler::step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) {
  require_step(t, dt);
  a_.resize(states.size());
  field(t, states, a_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    BodyState& s = states[i];
    s.v_WB += dt * a_[i].linear;
    s.w_WB += dt * a_[i].angular;
    s.p_WB += dt * s.v_WB;
    s.q_WB = turned(s.q_WB, dt * s.w_WB);
  }
}

}  // namespace plumbline
