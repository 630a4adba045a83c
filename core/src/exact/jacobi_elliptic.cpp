#include "plumbline/core/exact/jacobi_elliptic.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plumbline/core/exact/elliptic_integral.hpp"

namespace plumbline {
namespace {

// Below this m the functions are circular to the last bit.
constexpr double kCircular = 1e-17;
// Each transformation takes the root of 1 - m and then squares m: even from the smallest 1 - m, 1e-308, 15 suffice.
constexpr std::size_t kMaxDepth = 20;

// Within the half period |u| <= K.
JacobiElliptic descend(double u, EllipticModulus modulus) {
  struct Level {
    double k1, one_less_k1;
    double complement;  // 1 - m above
  };
  std::array<Level, kMaxDepth> levels{};
  std::size_t depth = 0;
  while (modulus.m > kCircular && depth < kMaxDepth) {
    const double root = std::sqrt(modulus.complement), sum = 1 + root;
    // k1 = (1 - k')/(1 + k') = m/(1 + k')^2, without the difference.
    const double k1 = modulus.m / (sum * sum);
    levels[depth++] = {k1, 2 * root / sum, modulus.complement};
    u *= 0.5 * sum;
    modulus = {k1 * k1, 4 * root / (sum * sum)};
  }
  double sn = std::sin(u), cn = std::cos(u), dn = 1;
  while (depth > 0) {
    const Level level = levels[--depth];
    const double scale = 1 / (1 + level.k1 * sn * sn);
    // dn = (1 - k1 sn^2)/(1 + k1 sn^2), where 1 - k1 sn^2 = cn^2 + (1 - k1) sn^2 has no difference.
    const double falling = cn * cn + level.one_less_k1 * sn * sn;
    cn *= dn * scale;
    sn *= (1 + level.k1) * scale;
    dn = falling * scale;
    // Every level doubles the relative error of cn and dn, while that of sn shrinks: start from sn as long as it can.
    if (2 * sn * sn < 1) {
      cn = std::sqrt((1 - sn) * (1 + sn));
      dn = std::sqrt(cn * cn + level.complement * sn * sn);
    }
  }
  return {sn, cn, dn, 0};
}

}  // namespace

EllipticModulus modulus_of(double m) {
  if (!(m >= 0 && m <= 1)) throw std::invalid_argument("the parameter m = k^2 must lie in [0, 1]");
  return {m, 1 - m};
}

EllipticModulus modulus_of_complement(double complement) {
  if (!(complement >= 0 && complement <= 1)) throw std::invalid_argument("the complement 1 - m must lie in [0, 1]");
  return {1 - complement, complement};
}

double JacobiElliptic::amplitude() const {
  const double sign = std::fmod(half_turns, 2) == 0 ? 1 : -1;
  return half_turns * std::numbers::pi + std::atan2(sign * sn, sign * cn);
}

JacobiElliptic jacobi_elliptic(double u, const EllipticModulus& modulus) {
  if (modulus.complement == 0) {
    const double sech = 1 / std::cosh(u);
    return {std::tanh(u), sech, sech, 0};
  }
  const double half_period = 2 * complete_elliptic_k(modulus);
  const double half_turns = std::nearbyint(u / half_period);
  JacobiElliptic j = descend(u - half_turns * half_period, modulus);
  j.half_turns = half_turns;
  if (std::fmod(half_turns, 2) != 0) {
    j.sn = -j.sn;
    j.cn = -j.cn;
  }
  return j;
}

}  // namespace plumbline
