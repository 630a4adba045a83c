#include "plumbline/core/events/hard_sphere_state.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace plumbline {
namespace {

// Standard library distributions differ between platforms; the raw bits of the generator do not.
class NormalSource {
 public:
  explicit NormalSource(std::uint64_t seed) : engine_(seed) {}

  // Two independent normal deviates at a time (Box and Muller, Ann. Math. Stat. 29, 610 (1958)).
  std::array<double, 2> pair() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform())), angle = 2 * std::numbers::pi * uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

 private:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // [0, 1)

  std::mt19937_64 engine_;
};

}  // namespace

HardSphereState hard_sphere_crystal(int cells, double density, std::uint64_t seed) {
  if (cells < 2) throw std::invalid_argument("a hard-sphere crystal needs at least 2 cells along each axis");
  if (!(density > 0 && density < std::numbers::sqrt2)) {
    throw std::invalid_argument("the density of a hard-sphere crystal must lie between 0 and sqrt 2, where it is full");
  }
  HardSphereState state;
  const double edge = std::cbrt(4 / density);  // of a cubic cell, which holds four spheres
  state.box_length = edge * cells;
  const std::array<Vec3, 4> basis = {Vec3(1, 1, 1), Vec3(1, 3, 3), Vec3(3, 1, 3), Vec3(3, 3, 1)};
  for (int x = 0; x < cells; ++x) {
    for (int y = 0; y < cells; ++y) {
      for (int z = 0; z < cells; ++z) {
        for (const Vec3& b : basis) state.positions.push_back(edge * (Vec3(x, y, z) + 0.25 * b));
      }
    }
  }
  NormalSource normal(seed);
  Vec3 mean = Vec3::Zero();
  for (std::size_t k = 0; k < state.positions.size(); ++k) {
    const auto first = normal.pair(), second = normal.pair();
    state.velocities.emplace_back(first[0], first[1], second[0]);
    mean += state.velocities.back();
  }
  const auto n = static_cast<double>(state.positions.size());
  mean /= n;
  double squares = 0;
  for (Vec3& v : state.velocities) {
    v -= mean;
    squares += v.squaredNorm();
  }
  const double scale = std::sqrt(3 * (n - 1) / squares);
  for (Vec3& v : state.velocities) v *= scale;
  return state;
}

}  // namespace plumbline
