#include "plumbline/core/constraints/first_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumbline {

namespace {

double value(std::span<const double> c, double t) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * t + c[k];
  return sum;
}

std::vector<double> derivative(std::span<const double> c) {
  std::vector<double> result;
  for (std::size_t k = 1; k < c.size(); ++k) result.push_back(static_cast<double>(k) * c[k]);
  return result;
}

// The zero in [low, high], at whose ends the values have different signs and between which p is monotone.
double zero_between(std::span<const double> c, std::span<const double> slope, double low, double high) {
  const bool falls = value(c, low) > 0;
  double t = 0.5 * (low + high);
  for (int k = 0; k < 200; ++k) {
    const double f = value(c, t);
    if (f == 0) return t;
    ((f > 0) == falls ? low : high) = t;
    const double newton = t - f / value(slope, t);
    const double next = newton > low && newton < high && k % 4 != 3 ? newton : 0.5 * (low + high);
    if (next == t || next <= low || next >= high || std::abs(next - t) <= 1e-16 * std::abs(t)) return next;
    t = next;
  }
  return t;
}

// All changes of sign in (0, t_end), in order.
std::vector<double> zeros(std::span<const double> c, double t_end) {
  if (c.size() < 2) return {};
  const std::vector<double> slope = derivative(c);
  std::vector<double> ends = zeros(slope, t_end);
  ends.push_back(t_end);
  std::vector<double> result;
  double low = 0, at_low = value(c, 0);
  for (const double high : ends) {
    const double at_high = value(c, high);
    if ((at_low > 0 && at_high < 0) || (at_low < 0 && at_high > 0))
      result.push_back(zero_between(c, slope, low, high));
    else if (at_high == 0 && at_low != 0 && high < t_end)
      result.push_back(high);
    low = high;
    at_low = at_high;
  }
  return result;
}

}  // namespace

std::optional<double> first_crossing(std::span<const double> coefficients, double t_end) {
  const std::vector<double> slope = derivative(coefficients);
  std::vector<double> turns = zeros(slope, t_end);
  turns.push_back(t_end);
  double low = 0, at_low = value(coefficients, 0);
  for (const double high : turns) {
    const double at_high = value(coefficients, high);
    if (at_low > 0 && at_high < 0) return zero_between(coefficients, slope, low, high);
    if (at_low > 0 && at_high == 0 && high == t_end) return high;
    // A turn that happens to be a zero is not passed: it counts from the value before it.
    if (at_high != 0) at_low = at_high;
    if (at_high != 0 || at_low <= 0) low = high;
  }
  return std::nullopt;
}

double zeros_bound(std::span<const double> coefficients) {
  std::size_t degree = coefficients.size();
  while (degree > 0 && coefficients[degree - 1] == 0) --degree;
  if (degree < 2) return 0;
  double largest = 0;
  for (std::size_t k = 0; k + 1 < degree; ++k)
    largest = std::max(largest, std::abs(coefficients[k] / coefficients[degree - 1]));
  return 1 + largest;
}

}  // namespace plumbline
