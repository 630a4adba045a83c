#include "symbols.hpp"

#include <algorithm>

#include "expression.hpp"

namespace plumbline {

bool is_reserved(std::string_view name) {
  const auto holds = [&](const auto& list) { return std::find(list.begin(), list.end(), name) != list.end(); };
  return name == "pi" || holds(kForceSymbols) || holds(kGateSymbols) || holds(kGateConstants) ||
         holds(function_names());
}

std::array<double, kComponentCount> components_of(const BodyState& s) {
  return {s.p_WB.x(), s.p_WB.y(), s.p_WB.z(), s.q_WB.w(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z(),
          s.v_WB.x(), s.v_WB.y(), s.v_WB.z(), s.w_WB.x(), s.w_WB.y(), s.w_WB.z()};
}

BodyState state_of(const std::array<double, kComponentCount>& c) {
  BodyState s;
  s.p_WB = {c[0], c[1], c[2]};
  s.q_WB = Quat(c[3], c[4], c[5], c[6]);
  s.q_WB.coeffs() /= s.q_WB.norm();  // not normalized(): that would hide a zero or NaN attitude
  s.v_WB = {c[7], c[8], c[9]};
  s.w_WB = {c[10], c[11], c[12]};
  return s;
}

}  // namespace plumbline
