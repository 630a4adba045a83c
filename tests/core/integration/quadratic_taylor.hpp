// An independent solver of high precision: Taylor series in long double for systems whose right-hand sides are
// quadratic.
//
// Nearly every motion of the course is of that kind once sines are unknowns of their own: the coefficients then follow
// from products of power series, (y_a y_b)_n = sum_k (y_a)_k (y_b)_(n-k), and y_(n+1) = (y')_n/(n+1). It shares no
// formula with the integrators under test. With 64 bits (x86) its rounding is 2000 times finer than theirs.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <vector>

namespace plumbline::testing {

static_assert(std::numeric_limits<long double>::digits >= 64, "the reference needs more digits than double");

// y_out' += factor y_a y_b. A linear term names an unknown that is 1 and has no terms itself.
struct QuadraticTerm {
  std::size_t out;
  long double factor;
  std::size_t a, b;
};

class QuadraticTaylor {
 public:
  QuadraticTaylor(std::vector<QuadraticTerm> terms, std::vector<long double> y) : terms_(std::move(terms)), y_(y) {}

  // From the time reached to t, in equal steps of at most h.
  void advance_to(double t, double h) {
    const auto steps = static_cast<long>(std::ceil((t - t_) / h));
    const long double step =
        (static_cast<long double>(t) - static_cast<long double>(t_)) / static_cast<long double>(steps);
    for (long n = 0; n < steps; ++n) take(step);
    t_ = t;
  }
  double operator[](std::size_t i) const { return static_cast<double>(y_[i]); }
  long double exact(std::size_t i) const { return y_[i]; }

 private:
  static constexpr std::size_t kOrder = 30;

  void take(long double h) {
    std::vector<std::vector<long double>> c(y_.size(), std::vector<long double>(kOrder + 1, 0));
    for (std::size_t i = 0; i < y_.size(); ++i) c[i][0] = y_[i];
    for (std::size_t n = 0; n < kOrder; ++n) {
      for (const QuadraticTerm& term : terms_) {
        long double product = 0;
        for (std::size_t k = 0; k <= n; ++k) product += c[term.a][k] * c[term.b][n - k];
        c[term.out][n + 1] += term.factor * product;
      }
      for (auto& series : c) series[n + 1] /= static_cast<long double>(n + 1);
    }
    for (std::size_t i = 0; i < y_.size(); ++i) {
      long double sum = 0;
      for (std::size_t n = kOrder + 1; n-- > 0;) sum = sum * h + c[i][n];
      y_[i] = sum;
    }
  }

  std::vector<QuadraticTerm> terms_;
  std::vector<long double> y_;
  double t_ = 0;
};

}  // namespace plumbline::testing
