#include "plumbline/core/state.hpp"

namespace plumbline {

bool is_finite(const BodyState& state) {
  return state.p_WB.allFinite() && state.q_WB.coeffs().allFinite() && state.v_WB.allFinite() && state.w_WB.allFinite();
}

}  // namespace plumbline
