#include "plumbline/core/integration/position_verlet.hpp"

#include "plumbline/core/integration/attitude.hpp"

namespace plumbline {
namespace {

bool same(const BodyState& a, const BodyState& b) {
  return a.p_WB == b.p_WB && a.q_WB.coeffs() == b.q_WB.coeffs() && a.v_WB == b.v_WB && a.w_WB == b.w_WB;
}

}  // namespace

void PositionVerlet::step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) {
  require_step(t, dt);
  if (!continues(dt, states)) start(field, t, dt, states);

  for (std::size_t i = 0; i < states.size(); ++i) {
    BodyState& s = states[i];
    Memory& m = memory_[i];
    const Vec3 p_next = 2 * s.p_WB - m.p_previous + dt * dt * a_[i].linear;
    m.turn_W += dt * dt * a_[i].angular;
    m.p_previous = s.p_WB;
    s.p_WB = p_next;
    s.q_WB = turned(s.q_WB, m.turn_W);
    // For forces that depend on velocities: right to dt^2, made better below.
    s.v_WB = (s.p_WB - m.p_previous) / dt + 0.5 * dt * a_[i].linear;
    s.w_WB = m.turn_W / dt + 0.5 * dt * a_[i].angular;
  }

  field(t + dt, states, a_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    BodyState& s = states[i];
    Memory& m = memory_[i];
    const Vec3 p_ahead = 2 * s.p_WB - m.p_previous + dt * dt * a_[i].linear;
    const Vec3 turn_ahead = m.turn_W + dt * dt * a_[i].angular;
    s.v_WB = (p_ahead - m.p_previous) / (2 * dt);
    s.w_WB = (turn_ahead + m.turn_W) / (2 * dt);
    m.current = s;
  }
}

bool PositionVerlet::continues(double dt, std::span<const BodyState> states) const {
  if (dt != dt_ || states.size() != memory_.size()) return false;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!same(states[i], memory_[i].current)) return false;
  }
  return true;
}

void PositionVerlet::start(const AccelerationField& field, double t, double dt, std::span<const BodyState> states) {
  dt_ = dt;
  memory_.resize(states.size());
  a_.resize(states.size());
  field(t, states, a_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    memory_[i] = {s.p_WB - dt * s.v_WB + 0.5 * dt * dt * a_[i].linear,  // s(-dt)
                  dt * s.w_WB - 0.5 * dt * dt * a_[i].angular, s};
  }
}

}  // namespace plumbline
