#include "plumbline/core/response/smooth_impact.hpp"

#include <cmath>
#include <stdexcept>

namespace plumbline {
namespace {

// How fast a body's point gives way along n per unit impulse: 1/m + (r x n) . I^-1 (r x n) [1/kg].
double mobility(const Inertness& body, const Vec3& r, const Vec3& n) {
  const Vec3 lever = r.cross(n);
  return body.inverse_mass + lever.dot(body.inverse_inertia_W * lever);
}

void receive(BodyState& state, const Inertness& body, const Vec3& point_W, const Vec3& impulse_W) {
  state.v_WB += body.inverse_mass * impulse_W;
  state.w_WB += body.inverse_inertia_W * (point_W - state.p_WB).cross(impulse_W);
}

}  // namespace

double effective_mass(const Contact& c, std::span<const Inertness> inertness, std::span<const BodyState> states) {
  return 1 / (mobility(inertness[c.body_a], c.point_W - states[c.body_a].p_WB, c.normal_W) +
              mobility(inertness[c.body_b], c.point_W - states[c.body_b].p_WB, c.normal_W));
}

double apply_smooth_impact(const Contact& c, double restitution, std::span<const Inertness> inertness,
                           std::span<BodyState> states) {
  if (!(restitution >= 0 && restitution <= 1)) throw std::invalid_argument("restitution must lie in [0, 1]");
  const double mass = effective_mass(c, inertness, states);
  if (std::isinf(mass)) throw std::invalid_argument("an impact of two bodies that never move; let one of them move");
  const double approach = approach_speed(c, states);
  if (approach <= 0) return 0;
  const double j = (1 + restitution) * mass * approach;
  receive(states[c.body_a], inertness[c.body_a], c.point_W, j * c.normal_W);
  receive(states[c.body_b], inertness[c.body_b], c.point_W, -j * c.normal_W);
  return j;
}

}  // namespace plumbline
