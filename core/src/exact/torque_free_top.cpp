#include "plumbline/core/exact/torque_free_top.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace plumbline {
namespace {

void require_body(const Vec3& inertia, const BodyState& initial) {
  const double largest = inertia.maxCoeff(), sum = inertia.sum();
  // A thin plate has I3 = I1 + I2 exactly; rounding may put it a few bits beyond.
  if (!(inertia.minCoeff() > 0 && std::isfinite(sum) && 2 * largest <= sum * (1 + 1e-12))) {
    throw std::invalid_argument(
        "principal moments must be positive and none larger than the sum of the other two: no body has such");
  }
  if (!is_finite(initial)) throw std::invalid_argument("the initial state holds a number that is not finite");
  if (!(std::abs(initial.q_WB.norm() - 1) < 1e-9)) {
    throw std::invalid_argument("the initial attitude is not a unit quaternion: normalise it");
  }
}

// Axis k of the frame P is axis order[k] of the body. P is right-handed: an odd order turns its second axis round.
Mat3 frame_of(const std::array<int, 3>& order) {
  Mat3 r_BP;
  for (int k = 0; k < 3; ++k) r_BP.col(k) = Vec3::Unit(order[static_cast<std::size_t>(k)]);
  if (r_BP.determinant() < 0) r_BP.col(1) = -r_BP.col(1);
  return r_BP;
}

Vec3 permuted(const Vec3& v, const std::array<int, 3>& order) { return {v[order[0]], v[order[1]], v[order[2]]}; }

// Body axes in the order 1, 2, 3 of the header, for moments sorted so that I[low] <= I[mid] <= I[high].
std::array<int, 3> order_of_axes(const Vec3& inertia, const Vec3& w_B) {
  int low = 0, mid = 1, high = 2;
  if (inertia[low] > inertia[mid]) std::swap(low, mid);
  if (inertia[mid] > inertia[high]) std::swap(mid, high);
  if (inertia[low] > inertia[mid]) std::swap(low, mid);
  // L^2 - 2 E I2 without the part of w2, which drops out.
  const double about_high = inertia[high] * (inertia[high] - inertia[mid]) * w_B[high] * w_B[high];
  const double about_low = inertia[low] * (inertia[mid] - inertia[low]) * w_B[low] * w_B[low];
  if (about_high >= about_low) return {low, mid, high};
  return {high, mid, low};
}

}  // namespace

TorqueFreeTop::TorqueFreeTop(const Vec3& inertia, const BodyState& initial) : initial_(initial) {
  require_body(inertia, initial);
  initial_.q_WB.normalize();
  const Vec3 w_B = initial_.q_WB.conjugate() * initial_.w_WB;
  const std::array<int, 3> order = order_of_axes(inertia, w_B);
  const Mat3 r_BP = frame_of(order);
  q_BP_ = Quat(r_BP);
  inertia_P_ = permuted(inertia, order);
  const Vec3 w = r_BP.transpose() * w_B;  // only names and signs: zeros stay zeros
  momentum_ = inertia_P_.cwiseProduct(w).norm();

  const double i1 = inertia_P_.x(), i2 = inertia_P_.y(), i3 = inertia_P_.z();
  const double d21 = std::abs(i2 - i1), d32 = std::abs(i3 - i2), d31 = std::abs(i3 - i1);
  if (d32 * w.y() * w.z() == 0 && d31 * w.z() * w.x() == 0 && d21 * w.x() * w.y() == 0) return;  // steady spin

  // From the two invariants, with the terms that share a sign.
  const double a1 = std::hypot(w.x(), std::sqrt(i2 * d32 / (i1 * d31)) * w.y());
  const double a2 = std::hypot(w.y(), std::sqrt(i1 * d31 / (i2 * d32)) * w.x());
  const double a3 = std::hypot(w.z(), std::sqrt(i2 * d21 / (i3 * d31)) * w.y());
  const double sign3 = w.z() < 0 ? -1 : 1;
  const double sign2 = i3 > i1 ? sign3 : -sign3;  // of I2 dw2/dt = (I3 - I1) w3 w1 where w1 > 0
  amplitude_ = Vec3(a1, sign2 * a2, sign3 * a3);
  lambda_ = a3 * std::sqrt(d31 * d32 / (i1 * i2));

  // 1 - m is what is left of L^2 - 2 E I2 when w1 = 0.
  const double whole = i3 * d32 * a3 * a3;
  modulus_.m = i1 * d21 * a1 * a1 / whole;
  modulus_.complement = std::max(0.0, (i3 * d32 * w.z() * w.z() - i1 * d21 * w.x() * w.x()) / whole);

  const double n = -i3 * d21 / (i1 * d32);
  characteristic_ = {n, 1 - n};
  const double phi0 = std::atan2(w.y() / amplitude_.y(), w.x() / a1);
  u0_ = elliptic_f(phi0, modulus_);
  pi0_ = elliptic_pi(characteristic_, jacobi_elliptic(u0_, modulus_), modulus_);
  q_WL_ = initial_.q_WB * q_BP_ * attitude_of_momentum(w).conjugate();
}

// The attitude of P seen from a frame with z along L, turned about z by no angle psi yet.
Quat TorqueFreeTop::attitude_of_momentum(const Vec3& w_P) const {
  const Vec3 momentum = inertia_P_.cwiseProduct(w_P);
  const double theta = std::atan2(std::hypot(momentum.x(), momentum.y()), momentum.z());
  const double phi = std::atan2(momentum.x(), momentum.y());
  const double s = std::sin(0.5 * theta), c = std::cos(0.5 * theta);
  const double sp = std::sin(0.5 * phi), cp = std::cos(0.5 * phi);
  return Quat(c * cp, s * cp, -s * sp, c * sp);  // R_x(theta) R_z(phi)
}

BodyState TorqueFreeTop::at(double t) const {
  BodyState state = initial_;
  state.p_WB += initial_.v_WB * t;
  if (lambda_ == 0) {
    state.q_WB = rotation_by(initial_.w_WB * t) * initial_.q_WB;
    return state;
  }
  const JacobiElliptic j = jacobi_elliptic(u0_ + lambda_ * t, modulus_);
  const Vec3 w_P = amplitude_.cwiseProduct(Vec3(j.cn, j.sn, j.dn));
  const double grown = (elliptic_pi(characteristic_, j, modulus_) - pi0_) / lambda_;
  const double psi = momentum_ * (t / inertia_P_.z() + (1 / inertia_P_.x() - 1 / inertia_P_.z()) * grown);
  const Quat q_WP = q_WL_ * rotation_by(Vec3(0, 0, psi)) * attitude_of_momentum(w_P);
  state.q_WB = (q_WP * q_BP_.conjugate()).normalized();
  state.w_WB = q_WP * w_P;
  return state;
}

double TorqueFreeTop::half_period() const {
  if (lambda_ == 0) return std::numeric_limits<double>::infinity();
  return 2 * complete_elliptic_k(modulus_) / lambda_;
}

}  // namespace plumbline
