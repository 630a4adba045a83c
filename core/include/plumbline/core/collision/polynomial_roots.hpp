// Real roots of a polynomial in an interval: for equations of impact of degree two and three.
#pragma once

#include <span>
#include <vector>

namespace plumbline {

// All t in [low, high] where c[0] + c[1] t + c[2] t^2 + ... = 0, in ascending order.
//
// Between two neighbouring roots of its derivative a polynomial is monotone: where its signs at them differ, halving
// finds the one root between them to the last bit. The roots of the derivative are found in the same way.
//
// A double root (the curve touches zero and turns back) is an extremum of value zero; rounding of the coefficients
// decides whether the computed curve gets there. So an extremum or end whose value cannot be told from zero, that is
// |f| <= 8 n eps sum |c_k t^k| with n the degree, counts as a root: no root is missed, some may be reported that are
// none, and one root may be reported more than once within its own uncertainty. Whoever asks checks. A constant zero
// reports both ends. NaN has no roots. Sturm (1829) counts the same roots; this is plainer at low degree.
std::vector<double> polynomial_roots(std::span<const double> coefficients, double low, double high);

}  // namespace plumbline
