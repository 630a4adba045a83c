// What closed forms are checked against: derivatives of their values, an integration in long double, random numbers.
#pragma once

#include <cstdint>
#include <random>
#include <utility>

#include "plumbline/core/state.hpp"

namespace plumbline {

// Central difference of eighth order: truncation h^8 f^(9)/630, rounding about eps |f|/h.
template <class F>
auto derivative(const F& f, double t, double h) {
  const auto pair = [&](int k) { return (f(t + k * h) - f(t - k * h)).eval(); };
  return (((4.0 / 5) * pair(1) - (1.0 / 5) * pair(2) + (4.0 / 105) * pair(3) - (1.0 / 280) * pair(4)) / h).eval();
}

// Uniform in [0, 1) from the raw bits: the same numbers with every standard library.
inline double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1p-53; }

inline Vec3 uniform_vector(std::mt19937_64& bits) {
  const double x = uniform(bits), y = uniform(bits), z = uniform(bits);
  return 2 * Vec3(x, y, z) - Vec3::Ones();
}

inline Quat uniform_attitude(std::mt19937_64& bits) {
  const Vec3 v = uniform_vector(bits);
  return rotation_by(3 * v);
}

// Classical Runge-Kutta in long double (64 bits of mantissa) for I dw/dt = arm x F - w x I w in body axes, F constant
// in W, and dq/dt = q w/2. With w h = 2e-4 its error over 50 rad is about 50 (w h)^4/120 < 1e-15.
struct LongDoubleTop {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using Turn = Eigen::Matrix<long double, 4, 1>;  // x y z w

  Vector inertia, arm, force_W;
  Turn q;
  Vector w;

  LongDoubleTop(const Vec3& inertia_B, const Vec3& arm_B, const Vec3& f_W, const BodyState& start)
      : inertia(inertia_B.cast<long double>()),
        arm(arm_B.cast<long double>()),
        force_W(f_W.cast<long double>()),
        q(start.q_WB.coeffs().cast<long double>()) {
    w = turn(q).conjugate() * start.w_WB.cast<long double>();
  }

  void run(double duration, int steps) {
    const long double h = static_cast<long double>(duration) / steps;
    for (int k = 0; k < steps; ++k) {
      const auto [a, A] = rates(q, w);
      const auto [b, B] = rates(q + h / 2 * a, w + h / 2 * A);
      const auto [c, C] = rates(q + h / 2 * b, w + h / 2 * B);
      const auto [d, D] = rates(q + h * c, w + h * C);
      q += h / 6 * (a + 2 * b + 2 * c + d);
      w += h / 6 * (A + 2 * B + 2 * C + D);
    }
  }

  Quat attitude() const { return turn(q).cast<double>(); }
  Vec3 w_W() const { return (turn(q) * w).cast<double>(); }

 private:
  static Eigen::Quaternion<long double, Eigen::DontAlign> turn(const Turn& x) {
    return Eigen::Quaternion<long double, Eigen::DontAlign>(x(3), x(0), x(1), x(2)).normalized();
  }
  std::pair<Turn, Vector> rates(const Turn& at, const Vector& rate) const {
    const Vector torque = arm.cross(turn(at).conjugate() * force_W);
    const Eigen::Quaternion<long double, Eigen::DontAlign> half(0, rate.x() / 2, rate.y() / 2, rate.z() / 2);
    const Eigen::Quaternion<long double, Eigen::DontAlign> here(at(3), at(0), at(1), at(2));
    const Vector momentum = inertia.cwiseProduct(rate);
    return {(here * half).coeffs(), (torque - rate.cross(momentum)).cwiseQuotient(inertia)};
  }
};

}  // namespace plumbline
