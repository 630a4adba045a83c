#include "plumbline/core/exact/elliptic_integral.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "plumbline/core/exact/carlson.hpp"

namespace plumbline {
namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// phi = half_turns pi + an angle in [-pi/2, pi/2], given by its sine and cosine.
struct Amplitude {
  double half_turns, s, c;
};

Amplitude amplitude_of(double phi) {
  const double half_turns = std::nearbyint(phi / pi);
  const double sign = std::fmod(half_turns, 2) == 0 ? 1 : -1;
  return {half_turns, sign * std::sin(phi), sign * std::cos(phi)};
}

// 1 - m s^2 without the subtraction.
double delta_square(const Amplitude& a, const EllipticModulus& modulus) {
  return a.c * a.c + modulus.complement * a.s * a.s;
}

// 2 K, 2 E or 2 Pi for every half turn; nothing for none, where the complete integral may be infinite.
double turns(const Amplitude& a, double complete) { return a.half_turns == 0 ? 0 : 2 * a.half_turns * complete; }

double first_kind(const Amplitude& a, const EllipticModulus& modulus) {
  return a.s * carlson_rf(a.c * a.c, delta_square(a, modulus), 1);
}

// For n > 0 both terms are positive. For n < 0 they would cancel, badly for large |n|; the change of characteristic
// n -> w = (m - n)/(1 - n), in (m, 1), leads to a sum of positive terms (DLMF 19.7.9).
double third_kind(const EllipticCharacteristic& x, const Amplitude& a, const EllipticModulus& modulus) {
  const double s2 = a.s * a.s, c2 = a.c * a.c, d2 = delta_square(a, modulus);
  if (x.n >= 0) {
    return first_kind(a, modulus) + x.n / 3 * a.s * s2 * carlson_rj(c2, d2, 1, c2 + x.complement * s2);
  }
  const EllipticCharacteristic w{(modulus.m - x.n) / x.complement, modulus.complement / x.complement};
  const double share = modulus.complement * -x.n / x.complement;  // w - m
  const double other = share > 0 ? share * third_kind(w, a, modulus) : 0;
  const double circular = carlson_rc(d2, (c2 + x.complement * s2) * (c2 + w.complement * s2));
  return (modulus.m * first_kind(a, modulus) + other - x.n * w.n * a.s * a.c * circular) / (modulus.m - x.n);
}

}  // namespace

EllipticCharacteristic characteristic_of(double n) {
  if (!(n < 1)) throw std::invalid_argument("the characteristic n of Pi must be < 1: at 1 the integral is infinite");
  return {n, 1 - n};
}

double complete_elliptic_k(const EllipticModulus& modulus) {
  if (modulus.complement == 0) return kInfinity;
  double a = 1, b = std::sqrt(modulus.complement);
  // Quadratic convergence: from this distance one more mean agrees to the last bit.
  while (!(std::abs(a - b) <= 1e-8 * a) && !std::isnan(b)) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return pi / (a + b);
}

double complete_elliptic_e(const EllipticModulus& modulus) {
  if (modulus.complement == 0) return 1;
  // Terms of one sign: E = (1 - m)(K + m/3 R_D(0, 1, 1 - m)), DLMF 19.25.1.
  const double m1 = modulus.complement;
  return m1 * (carlson_rf(0, m1, 1) + modulus.m / 3 * carlson_rd(0, 1, m1));
}

double complete_elliptic_pi(const EllipticCharacteristic& characteristic, const EllipticModulus& modulus) {
  if (modulus.complement == 0) return kInfinity;
  return third_kind(characteristic, {0, 1, 0}, modulus);
}

double elliptic_f(double phi, const EllipticModulus& modulus) {
  const Amplitude a = amplitude_of(phi);
  return turns(a, complete_elliptic_k(modulus)) + first_kind(a, modulus);
}

double elliptic_e(double phi, const EllipticModulus& modulus) {
  const Amplitude a = amplitude_of(phi);
  const double d2 = delta_square(a, modulus);
  const double part =
      a.s * carlson_rf(a.c * a.c, d2, 1) - modulus.m / 3 * a.s * a.s * a.s * carlson_rd(a.c * a.c, d2, 1);
  return turns(a, complete_elliptic_e(modulus)) + part;
}

double elliptic_pi(const EllipticCharacteristic& characteristic, double phi, const EllipticModulus& modulus) {
  const Amplitude a = amplitude_of(phi);
  return turns(a, complete_elliptic_pi(characteristic, modulus)) + third_kind(characteristic, a, modulus);
}

double elliptic_pi(const EllipticCharacteristic& characteristic, const JacobiElliptic& j,
                   const EllipticModulus& modulus) {
  const double sign = std::fmod(j.half_turns, 2) == 0 ? 1 : -1;
  const Amplitude a{j.half_turns, sign * j.sn, sign * j.cn};
  return turns(a, complete_elliptic_pi(characteristic, modulus)) + third_kind(characteristic, a, modulus);
}

}  // namespace plumbline
