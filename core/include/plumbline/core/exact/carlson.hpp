// Carlson's symmetric elliptic integrals, from which Legendre's and the motions of tops follow.
//
//   R_F(x, y, z)    = 1/2 int_0^inf dt / sqrt((t + x)(t + y)(t + z))
//   R_C(x, y)       = R_F(x, y, y)
//   R_J(x, y, z, p) = 3/2 int_0^inf dt / ((t + p) sqrt((t + x)(t + y)(t + z)))
//   R_D(x, y, z)    = R_J(x, y, z, z)
//
// Method: Carlson's duplication theorem until the arguments are nearly equal, then a Taylor series in their differences
// (B. C. Carlson, Numerical computation of real or complex elliptic integrals, Numer. Algorithms 10 (1995) 13-26; DLMF
// 19.36.i). Every step adds numbers of one sign, so the relative error stays at a few 1e-16.
//
// Range: x, y, z >= 0 and at most one of them 0; z > 0 for R_D, y > 0 for R_C, p > 0 for R_J. Outside of it, and for
// NaN, the result is NaN.
#pragma once

namespace plumbline {

double carlson_rc(double x, double y);
double carlson_rf(double x, double y, double z);
double carlson_rd(double x, double y, double z);
double carlson_rj(double x, double y, double z, double p);

}  // namespace plumbline
