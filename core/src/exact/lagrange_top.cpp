#include "plumbline/core/exact/lagrange_top.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plumbline/core/exact/nutation_roots.hpp"

namespace plumbline {
namespace {

void require_top(const TopBody& top, const BodyState& initial) {
  const double product = top.mass * top.arm_B.norm() * top.inertia_axial * top.inertia_transverse * top.gravity;
  const double least = std::min({top.mass, top.inertia_axial, top.inertia_transverse, top.gravity});
  if (!(least > 0 && product > 0 && std::isfinite(product))) {
    throw std::invalid_argument(
        "mass, arm, both moments of inertia and gravity of a heavy top must be finite and > 0; without gravity or arm "
        "it is a TorqueFreeTop");
  }
  if (!is_finite(initial)) throw std::invalid_argument("the initial state holds a number that is not finite");
  if (!(std::abs(initial.q_WB.norm() - 1) < 1e-9)) {
    throw std::invalid_argument("the initial attitude is not a unit quaternion: normalise it");
  }
}

// dq/dt = w q/2
Quat half_times(const Vec3& w, const Quat& q) { return Quat(0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z()) * q; }

}  // namespace

double transverse_inertia_at_pivot(const TopBody& top) {
  return top.inertia_transverse + top.mass * top.arm_B.squaredNorm();
}

LagrangeTop::LagrangeTop(const TopBody& top, const BodyState& initial) {
  require_top(top, initial);
  const Quat q_WB = initial.q_WB.normalized();
  pivot_W_ = initial.p_WB - q_WB * top.arm_B;
  arm_ = top.arm_B.norm();
  q_BP_ = Quat::FromTwoVectors(Vec3::UnitZ(), top.arm_B);
  q_WP0_ = q_WB * q_BP_;

  const Vec3 w_P = q_WP0_.conjugate() * initial.w_WB;
  w3_ = w_P.z();
  // 1 - u, 1 + u and the vertical's part across the axis from the quaternion: no digits are lost near the vertical.
  const double qw = q_WP0_.w(), qx = q_WP0_.x(), qy = q_WP0_.y(), qz = q_WP0_.z();
  const double fall = 2 * (qx * qx + qy * qy), rise = 2 * (qw * qw + qz * qz);
  const double zx = 2 * (qx * qz - qw * qy), zy = 2 * (qy * qz + qw * qx);
  const double across_square = w_P.x() * w_P.x() + w_P.y() * w_P.y();
  lowest_cosine_ = highest_cosine_ = 0.5 * (rise - fall);
  if (fall * rise == 0 && across_square == 0) return;  // stands or hangs still and spins

  const double i1 = transverse_inertia_at_pivot(top);
  const double a = top.inertia_axial * w3_ / i1;
  const double beta = 2 * top.mass * top.gravity * arm_ / i1;
  const double lift = w_P.x() * zx + w_P.y() * zy;    // b - a u
  const double u_rate = w_P.y() * zx - w_P.x() * zy;  // du/dt
  const NutationRoots roots = nutation_roots({fall, rise, across_square, lift, u_rate, a, beta});

  const double span = roots.beyond + roots.fall_lowest;  // u3 - u1
  lambda_ = 0.5 * std::sqrt(beta * span);
  modulus_ = {(roots.down + roots.up) / span, (roots.beyond + roots.fall_high) / span};
  v0_ = elliptic_f(std::atan2(std::copysign(std::sqrt(roots.down), u_rate), std::sqrt(roots.up)), modulus_);
  lowest_cosine_ = roots.rise_lowest - 1;
  highest_cosine_ = 1 - roots.fall_high;

  const double b_plus_a = lift + a * rise, b_minus_a = lift - a * fall;
  cos_half_.low = roots.rise_lowest;
  cos_half_.high = roots.rise_high;
  cos_half_.drift = 0.5 * (w3_ - a);
  cos_half_.pull = 0.5 * b_plus_a;
  if (cos_half_.low == 0) cos_half_.root = Klein::Root::kSignOfSn;
  sin_half_.low = roots.fall_lowest;
  sin_half_.high = roots.fall_high;
  sin_half_.drift = -0.5 * (w3_ - a);
  sin_half_.pull = 0.5 * b_minus_a;
  if (sin_half_.high == 0) sin_half_.root = Klein::Root::kSignOfCn;

  const Quat rate = half_times(initial.w_WB, q_WP0_);
  prepare(cos_half_, {{qw, qz}, {rate.w(), rate.z()}});
  prepare(sin_half_, {{qx, qy}, {rate.x(), rate.y()}});
}

void LagrangeTop::prepare(Klein& part, const Motion& initial) const {
  if (part.root == Klein::Root::kPositive) {
    part.characteristic = {(part.low - part.high) / part.low, part.high / part.low};
  }
  // Value and rate are turned by the same phase. Near a vertical the value is rounding, and the rate decides.
  const Motion start = motion(part, jacobi_elliptic(v0_, modulus_), 0);
  const Complex match =
      std::conj(start.value) * initial.value + std::conj(start.rate) * initial.rate / (lambda_ * lambda_);
  part.phase = match / std::abs(match);
}

LagrangeTop::Motion LagrangeTop::motion(const Klein& part, const JacobiElliptic& j, double t) const {
  double r, r_rate, angle = part.drift * t, angle_rate = part.drift;
  if (part.root == Klein::Root::kSignOfSn) {
    r = std::sqrt(0.5 * part.high) * j.sn;
    r_rate = std::sqrt(0.5 * part.high) * lambda_ * j.cn * j.dn;
  } else if (part.root == Klein::Root::kSignOfCn) {
    r = std::sqrt(0.5 * part.low) * j.cn;
    r_rate = -std::sqrt(0.5 * part.low) * lambda_ * j.sn * j.dn;
  } else {
    const double square = part.low * j.cn * j.cn + part.high * j.sn * j.sn;  // 1 +- u = 2 r^2
    r = std::sqrt(0.5 * square);
    r_rate = 0.5 * (part.high - part.low) * lambda_ * j.sn * j.cn * j.dn / r;
    if (part.pull != 0) {
      // The integral of pull/(1 +- u) over time.
      angle += part.pull / (part.low * lambda_) * elliptic_pi(part.characteristic, j, modulus_);
      angle_rate += part.pull / square;
    }
  }
  const Complex turned = part.phase * std::polar(1.0, angle);
  return {r * turned, Complex(r_rate, r * angle_rate) * turned};
}

BodyState LagrangeTop::at(double t) const {
  if (lambda_ == 0) {
    const Vec3 w_W = w3_ * (q_WP0_ * Vec3::UnitZ());
    return state(rotation_by(w_W * t) * q_WP0_, w_W);
  }
  const JacobiElliptic j = jacobi_elliptic(v0_ + lambda_ * t, modulus_);
  const Motion c = motion(cos_half_, j, t), s = motion(sin_half_, j, t);
  const Quat q_WP = Quat(c.value.real(), s.value.real(), s.value.imag(), c.value.imag()).normalized();
  const Quat rate(c.rate.real(), s.rate.real(), s.rate.imag(), c.rate.imag());
  return state(q_WP, 2 * (rate * q_WP.conjugate()).vec());  // dq/dt = w q/2
}

BodyState LagrangeTop::state(const Quat& q_WP, const Vec3& w_W) const {
  BodyState result;
  const Vec3 r_W = arm_ * (q_WP * Vec3::UnitZ());
  result.p_WB = pivot_W_ + r_W;
  result.q_WB = (q_WP * q_BP_.conjugate()).normalized();
  result.v_WB = w_W.cross(r_W);
  result.w_WB = w_W;
  return result;
}

double LagrangeTop::nutation_period() const {
  if (lambda_ == 0) return std::numeric_limits<double>::infinity();
  return 2 * complete_elliptic_k(modulus_) / lambda_;
}

}  // namespace plumbline
