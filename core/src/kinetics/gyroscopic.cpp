#include "plumbline/core/kinetics/gyroscopic.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace plumbline {
namespace {

// q v q^-1. Dividing by |q|^2 matters: a unit quaternion is unit to one rounding only, always the same one, and turning
// a vector into the body and back at every step would scale it by that much each time.
Vec3 rotated(const Quat& q, const Vec3& v) {
  const Vec3 across = q.vec().cross(v);
  return v + 2 / q.squaredNorm() * (q.w() * across + q.vec().cross(across));
}

Vec3 inverse_of(const Vec3& inertia_B) {
  return inertia_B.unaryExpr([](double moment) { return moment == 0 ? 0.0 : 1 / moment; });
}

// One Newton step from w for f(w') = I (w' - w) + h w' x I w' = 0: f(w) = h w x I w, f'(w) = I + h ([w] I - [I w]).
Vec3 newton_step(const Vec3& inertia_B, const Vec3& w_B, double h) {
  Mat3 inertia = inertia_B.asDiagonal();
  for (int axis = 0; axis < 3; ++axis) {
    if (inertia_B[axis] == 0) return w_B;  // a body that does not turn about some axis has no gyroscopic motion
  }
  const Vec3 l_B = inertia_B.cwiseProduct(w_B);
  const Mat3 slope = inertia + h * (cross_matrix(w_B) * inertia - cross_matrix(l_B));
  return w_B - slope.partialPivLu().solve(h * w_B.cross(l_B));
}

// With the triangle inequality of moments, |dw/dt| <= |w|^2, whose majorant y' = y^2 has the Taylor terms (|w| t)^k
// |w|. So within |w| t <= 1/4 the terms fall like 4^-k, and 28 of them reach 2^-56.
constexpr std::size_t kTerms = 28;
constexpr double kLongestTurn = 0.25;  // |w| t of one piece [rad]

struct Turn {
  Quat q_WB;
  Vec3 w_B;
};

Turn turned(const Vec3& inertia_B, const Vec3& inverse_B, const Turn& start, double t) {
  std::array<Vec3, kTerms + 1> w;
  std::array<Eigen::Vector4d, kTerms + 1> q;  // x y z w, as Eigen stores it
  w[0] = start.w_B;
  q[0] = start.q_WB.coeffs();
  Turn end{start.q_WB, start.w_B};
  double power = 1;
  for (std::size_t k = 0; k < kTerms; ++k) {
    Vec3 dw = Vec3::Zero();
    Eigen::Vector4d dq = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i <= k; ++i) {
      const Vec3& w_i = w[i];
      dw += inertia_B.cwiseProduct(w[k - i]).cross(w_i);
      // dq/dt = q (0, w_B) / 2
      const Vec3 vector = q[k - i].head<3>();
      dq.head<3>() += 0.5 * (q[k - i].w() * w_i + vector.cross(w_i));
      dq.w() -= 0.5 * vector.dot(w_i);
    }
    const double divisor = static_cast<double>(k + 1);
    w[k + 1] = inverse_B.cwiseProduct(dw) / divisor;
    q[k + 1] = dq / divisor;
    power *= t;
    end.w_B += power * w[k + 1];
    end.q_WB.coeffs() += power * q[k + 1];
  }
  end.q_WB.normalize();
  return end;
}

}  // namespace

std::string_view name(GyroscopicTerm term) {
  switch (term) {
    case GyroscopicTerm::kExplicit:
      return "explicit gyroscopic term";
    case GyroscopicTerm::kNone:
      return "no gyroscopic term";
    case GyroscopicTerm::kImplicit:
      return "implicit gyroscopic term";
    case GyroscopicTerm::kExact:
      return "exact free rotation";
  }
  return "unknown gyroscopic term";
}

Vec3 gyroscopic_step(GyroscopicTerm term, const Vec3& inertia_B, const Vec3& w_B, double h) {
  switch (term) {
    case GyroscopicTerm::kNone:
      return w_B;
    case GyroscopicTerm::kExplicit:
      return w_B - h * inverse_of(inertia_B).cwiseProduct(w_B.cross(inertia_B.cwiseProduct(w_B)));
    case GyroscopicTerm::kImplicit:
      return newton_step(inertia_B, w_B, h);
    case GyroscopicTerm::kExact: {
      BodyState state;
      state.w_WB = w_B;
      turn_freely(inertia_B, h, state);
      return state.q_WB.conjugate() * state.w_WB;
    }
  }
  return w_B;
}

void turn_freely(const Vec3& inertia_B, double h, BodyState& state) {
  const Vec3 inverse_B = inverse_of(inertia_B);
  Turn turn{state.q_WB, rotated(state.q_WB.conjugate(), state.w_WB)};
  const Vec3 l_W = rotated(state.q_WB, inertia_B.cwiseProduct(turn.w_B));
  const double pieces = std::ceil(std::abs(h) * state.w_WB.norm() / kLongestTurn);
  if (!(pieces < 1e9)) {  // also NaN: there is no attitude to report
    state.q_WB.coeffs().setConstant(std::nan(""));
    return;
  }
  for (double k = 0; k < pieces; ++k) turn = turned(inertia_B, inverse_B, turn, h / pieces);
  // Nothing acts on the body: its angular momentum is the one it had, to the last bit that the attitude allows.
  if ((inertia_B.array() > 0).all()) turn.w_B = inverse_B.cwiseProduct(rotated(turn.q_WB.conjugate(), l_W));
  state.q_WB = turn.q_WB;
  state.w_WB = rotated(turn.q_WB, turn.w_B);
}

}  // namespace plumbline
