// Random particles, and what the laws of momentum say about them: for the tests of the constraints.
#pragma once

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "plumbline/core/constraints/constraint.hpp"

namespace plumbline::particles {

inline constexpr double kEps = 2.220446049250313e-16;

// The same numbers on every platform: std's distributions differ between libraries.
class Random {
 public:
  explicit Random(unsigned long long seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

// sum m d: how far a motion carries the centre of mass, times the mass.
inline Vec3 shift(const PerParticle& d_W, std::span<const double> inverse_masses) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < inverse_masses.size(); ++i) sum += d_W[i] / inverse_masses[i];
  return sum;
}

// sum m p x d: its net rotation.
inline Vec3 turn(std::span<const Vec3> p_W, const PerParticle& d_W, std::span<const double> inverse_masses) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < inverse_masses.size(); ++i) sum += p_W[i].cross(d_W[i]) / inverse_masses[i];
  return sum;
}

// sum m |d|^2; a held particle must not have moved.
inline double cost(const PerParticle& d_W, std::span<const double> inverse_masses) {
  double sum = 0;
  for (std::size_t i = 0; i < inverse_masses.size(); ++i) {
    sum += inverse_masses[i] > 0 ? d_W[i].squaredNorm() / inverse_masses[i]
                                 : (d_W[i].norm() == 0 ? 0 : std::numeric_limits<double>::infinity());
  }
  return sum;
}

inline std::vector<Vec3> moved(std::span<const Vec3> p_W, const PerParticle& d_W) {
  std::vector<Vec3> result(p_W.begin(), p_W.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += d_W[i];
  return result;
}

// Order with which errors fall when the step is halved: the slope of their logarithms, first to last.
inline double observed_order(std::span<const double> errors) {
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

// A measured number for RecordProperty (see it with --gtest_output=xml).
inline std::string measured(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3e", value);
  return text;
}

}  // namespace plumbline::particles
