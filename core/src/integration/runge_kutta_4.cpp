#include "plumbline/core/integration/runge_kutta_4.hpp"

#include "plumbline/core/integration/attitude.hpp"

namespace plumbline {

void RungeKutta4::step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) {
  require_step(t, dt);
  const std::size_t bodies = states.size();
  stage_.resize(bodies);
  a_.resize(bodies);
  k_.assign(bodies, Rate{});
  sum_.assign(bodies, Rate{});

  constexpr double kNode[] = {0, 0.5, 0.5,
                              1};  // where in the step the stage stands: it goes there along the k before it
  constexpr double kWeight[] = {1, 2, 2, 1};
  for (std::size_t n = 0; n < 4; ++n) {
    const double h = kNode[n] * dt;
    for (std::size_t i = 0; i < bodies; ++i) {
      const BodyState& s = states[i];
      stage_[i] = {s.p_WB + h * k_[i].p, turned(s.q_WB, h * k_[i].phi), s.v_WB + h * k_[i].v, s.w_WB + h * k_[i].w};
    }
    field(t + h, stage_, a_);
    for (std::size_t i = 0; i < bodies; ++i) {
      const Vec3 phi = h * k_[i].phi;
      k_[i] = {stage_[i].v_WB, dexp_inverse(phi, stage_[i].w_WB), a_[i].linear, a_[i].angular};
      sum_[i].p += kWeight[n] * k_[i].p;
      sum_[i].phi += kWeight[n] * k_[i].phi;
      sum_[i].v += kWeight[n] * k_[i].v;
      sum_[i].w += kWeight[n] * k_[i].w;
    }
  }

  for (std::size_t i = 0; i < bodies; ++i) {
    BodyState& s = states[i];
    s.p_WB += dt / 6 * sum_[i].p;
    s.q_WB = turned(s.q_WB, dt / 6 * sum_[i].phi);
    s.v_WB += dt / 6 * sum_[i].v;
    s.w_WB += dt / 6 * sum_[i].w;
  }
}

}  // namespace plumbline
