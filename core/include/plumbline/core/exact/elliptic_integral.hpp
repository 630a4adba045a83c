// Legendre's elliptic integrals of the first, second and third kind, complete and incomplete, real arguments.
//
//   F(phi|m)   = int_0^phi dx / sqrt(1 - m sin^2 x)                          K(m)   = F(pi/2|m)
//   E(phi|m)   = int_0^phi sqrt(1 - m sin^2 x) dx                            E(m)   = E(pi/2|m)
//   Pi(n;phi|m) = int_0^phi dx / ((1 - n sin^2 x) sqrt(1 - m sin^2 x))        Pi(n|m) = Pi(n;pi/2|m)
//
// Method: K by the arithmetic-geometric mean, K = pi/(2 agm(1, k')) (DLMF 19.8.5), the others by Carlson's integrals
// (DLMF 19.25.i). Range: 0 <= m <= 1, n < 1, every finite phi (for m = 1 only |phi| < pi/2, beyond which F is
// infinite). Relative error a few 1e-16. The standard library has them too (std::ellint_1 and so on), but only with
// k and n themselves, so that its digits end where m or n come close to 1; here both carry their complements.
#pragma once

#include "plumbline/core/exact/jacobi_elliptic.hpp"

namespace plumbline {

// n with 1 - n. Throws std::invalid_argument unless n < 1.
struct EllipticCharacteristic {
  double n = 0;
  double complement = 1;
};
EllipticCharacteristic characteristic_of(double n);

double complete_elliptic_k(const EllipticModulus& modulus);  // infinite for m = 1
double complete_elliptic_e(const EllipticModulus& modulus);
double complete_elliptic_pi(const EllipticCharacteristic& characteristic, const EllipticModulus& modulus);

double elliptic_f(double phi, const EllipticModulus& modulus);
double elliptic_e(double phi, const EllipticModulus& modulus);
double elliptic_pi(const EllipticCharacteristic& characteristic, double phi, const EllipticModulus& modulus);

// Pi at the amplitude of `j` (a value of jacobi_elliptic for the same modulus): no angle is needed, and none rounded.
double elliptic_pi(const EllipticCharacteristic& characteristic, const JacobiElliptic& j,
                   const EllipticModulus& modulus);

}  // namespace plumbline
