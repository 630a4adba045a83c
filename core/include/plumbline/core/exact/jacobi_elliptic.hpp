// Jacobi's elliptic functions sn, cn, dn and amplitude am for real arguments: the motions of pendulums and tops.
//
//   u = F(am|m),  sn = sin am,  cn = cos am,  dn = sqrt(1 - m sn^2)
//   sn' = cn dn,  cn' = -sn dn,  dn' = -m sn cn
//
// Method: descending Landen transformation (Abramowitz and Stegun 16.12; DLMF 22.7.i), which lowers m until the
// functions are circular, written with the complement 1 - m so that no step subtracts. For m = 1 they are hyperbolic.
// Range: 0 <= m <= 1 and every finite u. Error: a few 1e-16 (1 + |u|) absolute; dn also keeps its relative digits.
#pragma once

namespace plumbline {

// The parameter m = k^2 and its complement, which is where the digits are when m is close to 1.
struct EllipticModulus {
  double m = 0;           // k^2
  double complement = 1;  // 1 - k^2
};

// Throws std::invalid_argument unless 0 <= m <= 1.
EllipticModulus modulus_of(double m);
EllipticModulus modulus_of_complement(double complement);

struct JacobiElliptic {
  double sn = 0, cn = 1, dn = 1;
  // Completed half periods 2K, rounded to nearest: am = half_turns pi + atan(sn/cn).
  double half_turns = 0;
  double amplitude() const;  // am(u|m) [rad], growing without jumps
};

JacobiElliptic jacobi_elliptic(double u, const EllipticModulus& modulus);

}  // namespace plumbline
