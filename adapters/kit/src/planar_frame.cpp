#include "plumbline/adapters/planar_frame.hpp"

#include <cmath>

namespace plumbline {

PlanarState in_plane(const BodyState& s) {
  return {s.p_WB.x(), s.p_WB.z(), -2 * std::atan2(s.q_WB.y(), s.q_WB.w()), s.v_WB.x(), s.v_WB.z(), -s.w_WB.y()};
}

BodyState in_space(const PlanarState& s) {
  BodyState state;
  state.p_WB = {s.x, 0, s.z};
  state.q_WB = Quat(std::cos(-s.angle / 2), 0, std::sin(-s.angle / 2), 0);
  state.v_WB = {s.vx, 0, s.vz};
  state.w_WB = {0, -s.w, 0};
  return state;
}

BodyState in_space(const PlanarState& s, const BodyState& initial) {
  BodyState state = in_space(s);
  state.p_WB.y() = initial.p_WB.y();
  // Of a plain turn about y nothing is left over, and no rounding shall say otherwise.
  if (initial.q_WB.x() == 0 && initial.q_WB.z() == 0) return state;
  const Quat turned = in_space(in_plane(initial)).q_WB;
  state.q_WB = state.q_WB * (turned.conjugate() * initial.q_WB);
  return state;
}

double planar_inertia(const Body& body) {
  const Quat& q = body.initial.q_WB;
  if (q.x() == 0 && q.z() == 0) return body.inertia.y();
  return inertia_in_world(body, q)(1, 1);
}

}  // namespace plumbline
