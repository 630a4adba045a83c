#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "independent_check.hpp"
#include "plumbline/core/exact/carlson.hpp"
#include "plumbline/core/exact/elliptic_integral.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
using std::numbers::pi;

EllipticModulus any_modulus(std::mt19937_64& bits, int k) {
  // A third in the middle, a third close to 0, a third close to 1.
  const double x = uniform(bits), small = std::pow(10, -14 * x);
  return k % 3 == 0 ? modulus_of(x) : k % 3 == 1 ? modulus_of(small) : modulus_of_complement(small);
}

TEST(Elliptic, FunctionsSatisfyTheirIdentities) {
  std::mt19937_64 bits(1);
  for (int k = 0; k < 3000; ++k) {
    const EllipticModulus m = any_modulus(bits, k);
    const JacobiElliptic j = jacobi_elliptic(40 * uniform(bits) - 20, m);
    EXPECT_NEAR(j.sn * j.sn + j.cn * j.cn, 1, 20 * kEps);
    EXPECT_NEAR(j.dn * j.dn, j.cn * j.cn + m.complement * j.sn * j.sn, 20 * kEps * j.dn * j.dn + 1e-30);
  }
}

TEST(Elliptic, FunctionsAreTheDerivativesOfEachOther) {
  std::mt19937_64 bits(2);
  for (int k = 0; k < 300; ++k) {
    const EllipticModulus m = any_modulus(bits, k);
    const double u = 6 * uniform(bits) - 3;
    const auto f = [&](double x) {
      const JacobiElliptic j = jacobi_elliptic(x, m);
      return Vec3(j.sn, j.cn, j.dn);
    };
    const Vec3 v = f(u);
    const Vec3 slope(v(1) * v(2), -v(0) * v(2), -m.m * v(0) * v(1));
    // h = 0.02: the ninth derivatives stay below 9! (poles at distance > 1.5 from the real axis scale them further
    // down), so truncation < 0.02^8 9!/630 = 1e-11; rounding 10 eps/h = 1e-13.
    EXPECT_LT((derivative(f, u, 0.02) - slope).norm(), 1e-11);
  }
}

TEST(Elliptic, AmplitudeInvertsTheFirstIntegral) {
  std::mt19937_64 bits(3);
  for (int k = 0; k < 3000; ++k) {
    const EllipticModulus m = any_modulus(bits, k);
    const double u = 60 * uniform(bits) - 30;
    const double phi = jacobi_elliptic(u, m).amplitude();
    // The angle is rounded by eps |phi|, which dF/dphi = 1/dn magnifies.
    const double dn = jacobi_elliptic(u, m).dn;
    EXPECT_NEAR(elliptic_f(phi, m), u, 8 * kEps * (std::abs(u) + std::abs(phi) / dn + 1));
  }
}

TEST(Elliptic, HyperbolicAtTheSeparatrixAndCircularAtZero) {
  const JacobiElliptic hyperbolic = jacobi_elliptic(1.25, modulus_of(1));
  EXPECT_DOUBLE_EQ(hyperbolic.sn, std::tanh(1.25));
  EXPECT_DOUBLE_EQ(hyperbolic.dn, 1 / std::cosh(1.25));
  EXPECT_NEAR(jacobi_elliptic(1.25, modulus_of_complement(1e-18)).sn, std::tanh(1.25), 2 * kEps);
  EXPECT_DOUBLE_EQ(jacobi_elliptic(1.25, modulus_of(0)).sn, std::sin(1.25));
  EXPECT_TRUE(std::isinf(complete_elliptic_k(modulus_of(1))));
}

TEST(Elliptic, IntegralsMatchPublishedNumbers) {
  // Abramowitz and Stegun, tables 17.1 and 17.2, and the lemniscate constant, K(1/2) = Gamma(1/4)^2/(4 sqrt(pi)).
  EXPECT_NEAR(complete_elliptic_k(modulus_of(0.5)), 1.85407467730137, 1e-14);
  EXPECT_NEAR(complete_elliptic_e(modulus_of(0.5)), 1.35064388104768, 1e-14);
  EXPECT_NEAR(complete_elliptic_k(modulus_of(0.5)), std::pow(std::tgamma(0.25), 2) / (4 * std::sqrt(pi)), 1e-14);
  // Carlson 1995, section 3: values of the symmetric integrals.
  EXPECT_NEAR(carlson_rf(1, 2, 0), 1.3110287771461, 1e-13);
  EXPECT_NEAR(carlson_rf(2, 3, 4), 0.58408284167715, 1e-14);
  EXPECT_NEAR(carlson_rc(0, 0.25), pi, 8 * kEps);
  EXPECT_NEAR(carlson_rj(0, 1, 2, 3), 0.77688623778582, 1e-14);
  EXPECT_NEAR(carlson_rj(2, 3, 4, 5), 0.14297579667157, 1e-14);
  EXPECT_NEAR(carlson_rd(0, 2, 1), 1.7972103521034, 1e-13);
}

TEST(Elliptic, IntegralsAgreeWithTheStandardLibrary) {
  std::mt19937_64 bits(4);
  for (int k = 0; k < 500; ++k) {
    const double m = 0.98 * uniform(bits), phi = 3 * uniform(bits) - 1.5, n = 1.9 * uniform(bits) - 1;
    const double modulus = std::sqrt(m);
    // The library's own error: its ellint_2 is 2e-13 off the 25-digit value below.
    const auto tolerance = [](double value) { return 1e-12 * std::abs(value); };
    const double f = std::ellint_1(modulus, phi), e = std::ellint_2(modulus, phi), p = std::ellint_3(modulus, n, phi);
    EXPECT_NEAR(elliptic_f(phi, modulus_of(m)), f, tolerance(f));
    EXPECT_NEAR(elliptic_e(phi, modulus_of(m)), e, tolerance(e));
    EXPECT_NEAR(elliptic_pi(characteristic_of(n), phi, modulus_of(m)), p, tolerance(p));
  }
  // 25 digits of an independent multiprecision program.
  EXPECT_NEAR(elliptic_e(1.2, modulus_of(0.97)), 0.94295431182679804, 4 * kEps);
  EXPECT_NEAR(elliptic_e(1.5, modulus_of(0.9)), 1.0822199401249235, 8 * kEps);
}

TEST(Elliptic, LegendresRelationHolds) {
  // E K' + E' K - K K' = pi/2 for every m.
  std::mt19937_64 bits(5);
  for (int k = 0; k < 300; ++k) {
    const EllipticModulus m = modulus_of(0.001 + 0.998 * uniform(bits)), other{m.complement, m.m};
    const double K = complete_elliptic_k(m), E = complete_elliptic_e(m);
    const double K2 = complete_elliptic_k(other), E2 = complete_elliptic_e(other);
    EXPECT_NEAR(E * K2 + E2 * K - K * K2, pi / 2, 16 * kEps * (E * K2 + E2 * K + K * K2));
  }
}

TEST(Elliptic, ThirdIntegralKeepsItsDigitsForLargeNegativeCharacteristic) {
  // For m = 0: atan(sqrt(1 - n) tan phi)/sqrt(1 - n).
  for (const double n : {-1e-3, -1.0, -1e4, -1e12, -1e30}) {
    const double root = std::sqrt(1 - n), exact = std::atan(root * std::tan(1.2)) / root;
    EXPECT_NEAR(elliptic_pi(characteristic_of(n), 1.2, modulus_of(0)), exact, 16 * kEps * exact) << n;
    EXPECT_NEAR(complete_elliptic_pi(characteristic_of(n), modulus_of(0)), pi / 2 / root, 16 * kEps / root) << n;
  }
  // 25 digits of an independent multiprecision program.
  EXPECT_NEAR(elliptic_pi(characteristic_of(-1e9), 1.2, modulus_of(0.9)), 4.9673357547316306e-5, 1e-19);
}

TEST(Elliptic, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(modulus_of(1.5), std::invalid_argument);
  EXPECT_THROW(modulus_of(std::nan("")), std::invalid_argument);
  EXPECT_THROW(modulus_of_complement(-1e-9), std::invalid_argument);
  EXPECT_THROW(characteristic_of(1), std::invalid_argument);
  EXPECT_TRUE(std::isnan(carlson_rf(-1, 1, 2)));
  EXPECT_TRUE(std::isnan(carlson_rf(0, 0, 1)));
  EXPECT_TRUE(std::isnan(carlson_rj(1, 2, std::nan(""), 1)));
  EXPECT_TRUE(std::isnan(carlson_rj(1, 2, 3, 0)));
  EXPECT_TRUE(std::isnan(carlson_rc(1, 0)));
}

}  // namespace
}  // namespace plumbline
