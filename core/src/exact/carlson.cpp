#include "plumbline/core/exact/carlson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The series that end each function drop terms of the sixth (R_C: eighth) power of the spread. A quarter of the
// spread goes with every duplication; below these bounds what is dropped is under 1e-17.
constexpr double kSpread6 = 1e-3;
constexpr double kSpread8 = 5e-3;

bool in_range(double x, double y, double z) {
  const int zeros = (x == 0 ? 1 : 0) + (y == 0 ? 1 : 0) + (z == 0 ? 1 : 0);
  return x >= 0 && y >= 0 && z >= 0 && zeros <= 1 && std::isfinite(x + y + z);
}

}  // namespace

double carlson_rc(double x, double y) {
  if (!(x >= 0 && y > 0 && std::isfinite(x + y))) return kNaN;
  double mean = (x + 2 * y) / 3;
  while (!(std::abs(y - mean) < kSpread8 * mean)) {
    const double shift = 2 * std::sqrt(x) * std::sqrt(y) + y;
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    mean = (x + 2 * y) / 3;
  }
  const double s = (y - mean) / mean;
  const double series =
      1 + s * s * (3.0 / 10 + s * (1.0 / 7 + s * (3.0 / 8 + s * (9.0 / 22 + s * (159.0 / 208 + s * 9.0 / 8)))));
  return series / std::sqrt(mean);
}

double carlson_rf(double x, double y, double z) {
  if (!in_range(x, y, z)) return kNaN;
  double mean = (x + y + z) / 3;
  while (!(std::max({std::abs(x - mean), std::abs(y - mean), std::abs(z - mean)}) < kSpread6 * mean)) {
    const double a = std::sqrt(x), b = std::sqrt(y), c = std::sqrt(z);
    const double shift = a * b + b * c + c * a;
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
    mean = (x + y + z) / 3;
  }
  const double dx = 1 - x / mean, dy = 1 - y / mean, dz = -dx - dy;
  const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(mean);
}

double carlson_rd(double x, double y, double z) { return carlson_rj(x, y, z, z); }

double carlson_rj(double x, double y, double z, double p) {
  if (!(in_range(x, y, z) && p > 0 && std::isfinite(p))) return kNaN;
  double power = 1;  // 4^-k after k duplications
  double sum = 0;
  double mean = (x + y + z + 2 * p) / 5;
  while (
      !(std::max({std::abs(x - mean), std::abs(y - mean), std::abs(z - mean), std::abs(p - mean)}) < kSpread6 * mean)) {
    const double a = std::sqrt(x), b = std::sqrt(y), c = std::sqrt(z), q = std::sqrt(p);
    const double d = (q + a) * (q + b) * (q + c);
    const double shift = a * b + b * c + c * a;
    // Carlson's 1 + e with e = (q - a)(q - b)(q - c)/d, which would cancel for e near -1.
    sum += power / d * carlson_rc(1, 2 * q * (p + shift) / d);
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
    p = 0.25 * (p + shift);
    mean = (x + y + z + 2 * p) / 5;
    power /= 4;
  }
  const double dx = 1 - x / mean, dy = 1 - y / mean, dz = 1 - z / mean, dp = -0.5 * (dx + dy + dz);
  const double e2 = dx * dy + dx * dz + dy * dz - 3 * dp * dp;
  const double e3 = dx * dy * dz + 2 * e2 * dp + 4 * dp * dp * dp;
  const double e4 = (2 * dx * dy * dz + e2 * dp + 3 * dp * dp * dp) * dp;
  const double e5 = dx * dy * dz * dp * dp;
  const double series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26;
  return power * series / (mean * std::sqrt(mean)) + 6 * sum;
}

}  // namespace plumbline
