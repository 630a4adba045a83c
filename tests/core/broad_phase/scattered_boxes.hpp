// Random numbers, bodies and scenes of boxes for the tests of bounding volumes and broad phases.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "plumbline/core/broad_phase/bounding_volume.hpp"

namespace plumbline {

// The same numbers with every standard library: std::uniform_real_distribution would differ.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
  std::size_t below(std::size_t n) { return engine_() % n; }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Quat attitude() { return rotation_by(in(0, 3) * direction()); }
  BodyState state(double size) {
    BodyState s;
    s.p_WB = vector(size);
    s.q_WB = attitude();
    return s;
  }

 private:
  std::mt19937_64 engine_;
};

enum class Scatter {
  kUniform,
  kClustered,
  kUneven,
  kPlanar,
  kOnePoint,
  kLine,
  kDiagonal,
  kLattice,
  kHugeAndTiny,
  kFarAway,
  kSticks,
  kPoints,
  kNested,
  kSparse
};
inline constexpr int kScatters = 14;

// n boxes of that kind. Their density lets each meet a few others where the kind leaves a choice.
inline std::vector<Aabb> scattered_boxes(Scatter kind, std::size_t n, Dice& dice) {
  std::vector<Aabb> boxes;
  const double side = std::cbrt(static_cast<double>(n));
  const Vec3 slope = dice.direction();
  const Vec3 far = 1e9 * dice.direction();
  const double step = std::ldexp(1.0, static_cast<int>(dice.below(9)) - 4);  // a power of two: the lattice is exact
  std::vector<Vec3> clusters;
  for (std::size_t k = 0; k <= n / 20; ++k) clusters.push_back(dice.vector(40 * side));
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<double>(i);
    Vec3 at = dice.vector(0.6 * side), size(1, 1, 1);
    switch (kind) {
      case Scatter::kUniform:
        break;
      case Scatter::kClustered:
        at = clusters[dice.below(clusters.size())] + dice.vector(1.5);
        break;
      case Scatter::kUneven:
        size = Vec3::Constant(std::exp(dice.in(-4, 2)));
        break;
      case Scatter::kPlanar:
        at[static_cast<Eigen::Index>(dice.below(3))] = 0;
        break;
      case Scatter::kOnePoint:
        at.setZero();
        if (step > 1) size.setZero();  // in every other scene
        break;
      case Scatter::kLine:
        at = {0, 0.7 * k, 0};
        break;
      case Scatter::kDiagonal:
        at = 0.7 * k * slope + dice.vector(0.2);
        break;
      case Scatter::kLattice:  // neighbours share a face, an edge or a corner: all of them touch
        at = step * Vec3(std::fmod(k, 5), std::fmod(std::floor(k / 5), 5), std::floor(k / 25));
        size = Vec3::Constant(step);
        break;
      case Scatter::kHugeAndTiny:
        size = Vec3::Constant(std::pow(10, dice.in(-12, 12)));
        at = dice.vector(std::pow(10, dice.in(-12, 12)));
        break;
      case Scatter::kFarAway:
        at += far;
        break;
      case Scatter::kSticks:
        size = Vec3::Constant(0.05);
        size[static_cast<Eigen::Index>(dice.below(3))] = 2 * side;
        break;
      case Scatter::kPoints:  // without size, on a coarse lattice, so that some coincide
        at = at.array().round();
        size.setZero();
        break;
      case Scatter::kNested:
        size = Vec3::Constant(k + 1);
        at = dice.vector(0.1);
        break;
      case Scatter::kSparse:
        at *= 1e6;
        break;
    }
    boxes.push_back({at, at + size});
  }
  return boxes;
}

}  // namespace plumbline
