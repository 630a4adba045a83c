#include "plumbline/core/collision/polynomial_roots.hpp"

#include <cmath>
#include <limits>

namespace plumbline {
namespace {

struct Value {
  double value, uncertainty;
  bool may_be_zero() const { return std::abs(value) <= uncertainty; }
};

Value evaluate(std::span<const double> c, double t) {
  double value = 0, size = 0;
  for (std::size_t k = c.size(); k-- > 0;) {
    value = value * t + c[k];
    size = size * std::abs(t) + std::abs(c[k]);
  }
  return {value, 8 * static_cast<double>(c.size() - 1) * std::numeric_limits<double>::epsilon() * size};
}

double halve(std::span<const double> c, double low, double high) {
  const bool falls = evaluate(c, low).value > 0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) return low;
    ((evaluate(c, middle).value > 0) == falls ? low : high) = middle;
  }
}

}  // namespace

std::vector<double> polynomial_roots(std::span<const double> coefficients, double low, double high) {
  if (coefficients.size() < 2 || !(low <= high)) return {};
  std::vector<double> derivative;
  for (std::size_t k = 1; k < coefficients.size(); ++k) derivative.push_back(static_cast<double>(k) * coefficients[k]);
  std::vector<double> knots = polynomial_roots(derivative, low, high);
  knots.insert(knots.begin(), low);
  knots.push_back(high);

  std::vector<double> roots;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const Value here = evaluate(coefficients, knots[k]);
    if (here.may_be_zero()) roots.push_back(knots[k]);
    if (k + 1 == knots.size()) break;
    const Value next = evaluate(coefficients, knots[k + 1]);
    if (here.value * next.value < 0) roots.push_back(halve(coefficients, knots[k], knots[k + 1]));
  }
  return roots;
}

}  // namespace plumbline
