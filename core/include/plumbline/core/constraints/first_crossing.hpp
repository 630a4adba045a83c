// When does a polynomial first become negative? What every event of constraint_events needs: a gap that closes, a
// tension that vanishes.
#pragma once

#include <optional>
#include <span>

namespace plumbline {

// The first t in (0, t_end] at which sum c_k t^k goes from positive to negative or reaches zero at t_end from above;
// nothing when it does not. A polynomial that starts at or below zero must first become positive. A double root, where
// it touches zero and turns back, does not count.
//
// Method: between the zeros of its derivative, found the same way one degree lower, the polynomial is monotone, and a
// change of sign there is closed in by Newton's method guarded by bisection. t is exact to (rounding of the
// polynomial's value)/(its slope there): a crossing at a grazing angle is known less well. NaN never crosses.
std::optional<double> first_crossing(std::span<const double> coefficients, double t_end);

// A bound on all real zeros of the polynomial, 1 + max |c_k/c_n| (Cauchy); 0 for a constant.
double zeros_bound(std::span<const double> coefficients);

}  // namespace plumbline
