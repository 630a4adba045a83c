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

}  // namespace plumbline
