// Motions with an answer that no integrator under test has had a hand in.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/core/integration/stepper.hpp"
#include "quadratic_taylor.hpp"

namespace plumbline::testing {

struct KnownMotion {
  std::string name;
  AccelerationField field;
  BodyState initial;
  double duration;  // [s]
  BodyState final;  // at t = duration
};

// How far two states are apart: position, attitude [rad], velocities, as one number.
inline double distance(const BodyState& a, const BodyState& b) {
  const double angle = geodesic_angle(a.q_WB, b.q_WB);
  return std::sqrt((a.p_WB - b.p_WB).squaredNorm() + angle * angle + (a.v_WB - b.v_WB).squaredNorm() +
                   (a.w_WB - b.w_WB).squaredNorm());
}

inline BodyState run(Stepper& stepper, const AccelerationField& field, BodyState state, double dt, long steps) {
  for (long n = 0; n < steps; ++n) stepper.step(field, static_cast<double>(n) * dt, dt, {&state, 1});
  return state;
}

// x'' = -x
inline KnownMotion oscillator(double duration) {
  KnownMotion m{"oscillator", {}, {}, duration, {}};
  m.field = [](double, std::span<const BodyState> s, std::span<Acceleration> a) {
    a[0] = {Vec3(-s[0].p_WB.x(), 0, 0), Vec3::Zero()};
  };
  m.initial.p_WB = Vec3(1, 0, 0);
  m.initial.v_WB = Vec3(0.5, 0, 0);
  const double c = std::cos(duration), s = std::sin(duration);
  m.final.p_WB = Vec3(c + 0.5 * s, 0, 0);
  m.final.v_WB = Vec3(0.5 * c - s, 0, 0);
  return m;
}

// The ship of course slides 9-13, m v' = T - c v, with c/m = 1/4 per second.
inline KnownMotion ship(double duration) {
  const double m_ship = 1000, thrust = 5000, c = 250, v0 = 2;
  KnownMotion m{"drag", {}, {}, duration, {}};
  m.field = [=](double, std::span<const BodyState> s, std::span<Acceleration> a) {
    a[0] = {Vec3((thrust - c * s[0].v_WB.x()) / m_ship, 0, 0), Vec3::Zero()};
  };
  m.initial.v_WB = Vec3(v0, 0, 0);
  const double decay = std::exp(-c * duration / m_ship), top = thrust / c;
  m.final.v_WB = Vec3(top - (top - v0) * decay, 0, 0);
  m.final.p_WB = Vec3(top * duration + (top - v0) * (m_ship / c) * (decay - 1), 0, 0);
  return m;
}

// theta'' = -sin theta, theta in the x coordinate; sine and cosine are unknowns of the series.
inline KnownMotion pendulum(double duration) {
  KnownMotion m{"pendulum", {}, {}, duration, {}};
  m.field = [](double, std::span<const BodyState> s, std::span<Acceleration> a) {
    a[0] = {Vec3(-std::sin(s[0].p_WB.x()), 0, 0), Vec3::Zero()};
  };
  m.initial.p_WB = Vec3(1.2, 0, 0);
  m.initial.v_WB = Vec3(0.7, 0, 0);
  // theta, theta', sin, cos, 1
  QuadraticTaylor series(
      {{0, 1, 1, 4}, {1, -1, 2, 4}, {2, 1, 3, 1}, {3, -1, 2, 1}},
      {1.2, 0.7, std::sin(static_cast<long double>(1.2)), std::cos(static_cast<long double>(1.2)), 1});
  series.advance_to(duration, 0.1);
  m.final.p_WB = Vec3(series[0], 0, 0);
  m.final.v_WB = Vec3(series[1], 0, 0);
  return m;
}

// A rigid body about a fixed point O with principal moments I about O [kg m^2], its centre of mass at r_B [m]; m g [N]
// along -z. The series has w_B, the direction up in the body frame, and q, all by Euler's equations in the body frame:
//   I w' = I w x w - m g r x up,   up' = up x w,   q' = 1/2 q (0, w).
// A free body has r = 0.
class TopSeries {
 public:
  TopSeries(const Vec3& inertia, const Vec3& r_B, double weight, const Quat& q_WB, const Vec3& w_B)
      : r_B_(r_B), series_(terms(inertia, r_B, weight), start(q_WB, w_B)) {}
  void advance_to(double t, double h) { series_.advance_to(t, h); }
  Vec3 w_B() const { return Vec3(series_[0], series_[1], series_[2]); }
  Quat q_WB() const { return Quat(series_[6], series_[7], series_[8], series_[9]).normalized(); }
  BodyState state() const {
    BodyState s;
    s.q_WB = q_WB();
    s.w_WB = s.q_WB * w_B();
    s.p_WB = s.q_WB * r_B_;
    s.v_WB = s.w_WB.cross(s.p_WB);
    return s;
  }

 private:
  static std::vector<QuadraticTerm> terms(const Vec3& inertia, const Vec3& r, double weight) {
    std::vector<QuadraticTerm> list;
    const std::size_t one = 10;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const auto at = [](std::size_t n) { return static_cast<Eigen::Index>(n); };
      const long double I = inertia[at(i)], Ij = inertia[at(j)], Ik = inertia[at(k)];
      list.push_back({i, (Ij - Ik) / I, j, k});
      list.push_back({i, -static_cast<long double>(weight * r[at(j)]) / I, 3 + k, one});
      list.push_back({i, static_cast<long double>(weight * r[at(k)]) / I, 3 + j, one});
      list.push_back({3 + i, 1, 3 + j, k});
      list.push_back({3 + i, -1, 3 + k, j});
      list.push_back({6, -0.5L, 7 + i, i});
      list.push_back({7 + i, 0.5L, 6, i});
      list.push_back({7 + i, 0.5L, 7 + j, k});
      list.push_back({7 + i, -0.5L, 7 + k, j});
    }
    return list;
  }
  static std::vector<long double> start(const Quat& q, const Vec3& w) {
    const Vec3 up = q.conjugate() * Vec3::UnitZ();
    return {w.x(), w.y(), w.z(), up.x(), up.y(), up.z(), q.w(), q.x(), q.y(), q.z(), 1};
  }

  Vec3 r_B_;
  QuadraticTaylor series_;
};

// The same body as an engine sees it: accelerations in W. Its position follows from the attitude, and its linear
// acceleration is that of a point at r: alpha x r + w x (w x r).
inline AccelerationField top_field(const Vec3& inertia, const Vec3& r_B, double weight) {
  return [=](double, std::span<const BodyState> s, std::span<Acceleration> a) {
    const Quat& q = s[0].q_WB;
    const Vec3 w_B = q.conjugate() * s[0].w_WB;
    const Vec3 torque_B = r_B.cross(q.conjugate() * Vec3(0, 0, -weight));
    const Vec3 Iw = inertia.cwiseProduct(w_B);
    const Vec3 alpha = q * (torque_B - w_B.cross(Iw)).cwiseQuotient(inertia);
    const Vec3 r = q * r_B;
    a[0] = {alpha.cross(r) + s[0].w_WB.cross(s[0].w_WB.cross(r)), alpha};
  };
}

inline BodyState top_state(const Vec3& r_B, const Quat& q_WB, const Vec3& w_B) {
  BodyState s;
  s.q_WB = q_WB;
  s.w_WB = q_WB * w_B;
  s.p_WB = q_WB * r_B;
  s.v_WB = s.w_WB.cross(s.p_WB);
  return s;
}

// A free box of 10 kg and 0.1 x 0.4 x 0.9 m.
inline Vec3 box_inertia() { return 10.0 / 12 * Vec3(0.16 + 0.81, 0.01 + 0.81, 0.01 + 0.16); }

inline KnownMotion tumbling_box(double duration) {
  KnownMotion m{"tumbling box", top_field(box_inertia(), Vec3::Zero(), 0), {}, duration, {}};
  const Quat q = rotation_by(Vec3(0.4, -0.3, 0.8));
  const Vec3 w_B(1.1, 2, -0.6);
  m.initial = top_state(Vec3::Zero(), q, w_B);
  TopSeries series(box_inertia(), Vec3::Zero(), 0, q, w_B);
  series.advance_to(duration, 0.05);
  m.final = series.state();
  return m;
}

}  // namespace plumbline::testing
