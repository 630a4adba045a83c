#include "plumbline/core/integration/body_equations.hpp"

namespace plumbline {

BodyEquations::BodyEquations(const AccelerationField& field, std::size_t bodies)
    : field_(field), states_(bodies), a_(bodies) {}

void BodyEquations::operator()(double t, const Eigen::VectorXd& y, Eigen::VectorXd& dy) const {
  unpack(y, states_);
  field_(t, states_, a_);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(13 * i);
    const Vec3& w = states_[i].w_WB;
    const Quat q(y.segment<4>(at + 3));
    dy.segment<3>(at) = states_[i].v_WB;
    dy.segment<4>(at + 3) = 0.5 * (Quat(0, w.x(), w.y(), w.z()) * q).coeffs();
    dy.segment<3>(at + 7) = a_[i].linear;
    dy.segment<3>(at + 10) = a_[i].angular;
  }
}

Eigen::VectorXd BodyEquations::pack(std::span<const BodyState> states) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(13 * states.size()));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    y.segment<13>(static_cast<Eigen::Index>(13 * i)) << s.p_WB, s.q_WB.coeffs(), s.v_WB, s.w_WB;
  }
  return y;
}

void BodyEquations::unpack(const Eigen::VectorXd& y, std::span<BodyState> states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(13 * i);
    BodyState& s = states[i];
    s.p_WB = y.segment<3>(at);
    s.q_WB.coeffs() = y.segment<4>(at + 3).normalized();
    s.v_WB = y.segment<3>(at + 7);
    s.w_WB = y.segment<3>(at + 10);
  }
}

}  // namespace plumbline
