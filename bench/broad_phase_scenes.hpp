// The scenes of the broad-phase benchmark: n boxes each, of a density that lets a box meet about two others.
//
// All corners are multiples of 2^-12 m, and below 2^12 m: single precision holds them, so that a peer that computes in
// float sees the same boxes and must find the same pairs.
#pragma once

#include <cmath>
#include <random>
#include <string_view>
#include <vector>

#include "plumbline/core/broad_phase/bounding_volume.hpp"

namespace plumbline {

class SceneDice {
 public:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  Vec3 in_cube(double edge) { return edge * Vec3(unit(), unit(), unit()); }

 private:
  std::mt19937_64 engine_{17};
};

inline double on_raster(double value) { return 0x1p-12 * std::floor(0x1p12 * value); }

inline Aabb box_at(const Vec3& corner, double edge) {
  const Vec3 min(on_raster(corner.x()), on_raster(corner.y()), on_raster(corner.z()));
  return {min, min.array() + on_raster(edge)};
}

// Cubes of 1 m, one to 2 m^3.
inline std::vector<Aabb> uniform_scene(std::size_t n) {
  SceneDice dice;
  std::vector<Aabb> boxes;
  const double edge = std::cbrt(2.0 * static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) boxes.push_back(box_at(dice.in_cube(edge), 1));
  return boxes;
}

// Heaps of 50 of the same cubes, of the same density within; the heaps fill a thousandth of the space.
inline std::vector<Aabb> clustered_scene(std::size_t n) {
  SceneDice dice;
  std::vector<Aabb> boxes;
  const double edge = std::cbrt(2000.0 * static_cast<double>(n)), heap = std::cbrt(2.0 * 50);
  Vec3 corner = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 50 == 0) corner = dice.in_cube(edge);
    boxes.push_back(box_at(corner + dice.in_cube(heap), 1));
  }
  return boxes;
}

// Cubes of 0.1 m to 10 m, the number of those larger than s falling like s^-3: every factor 2 of size fills the same
// share of the space.
inline std::vector<Aabb> uneven_scene(std::size_t n) {
  SceneDice dice;
  std::vector<Aabb> boxes;
  const double edge = std::cbrt(0.04 * static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const double size = 0.1 / std::cbrt(1e-6 + (1 - 1e-6) * dice.unit());
    boxes.push_back(box_at(dice.in_cube(edge), size));
  }
  return boxes;
}

// A pile that is wide and flat: four layers of cubes of 1 m that lie on each other, shifted by up to 0.2 m.
inline std::vector<Aabb> planar_scene(std::size_t n) {
  SceneDice dice;
  std::vector<Aabb> boxes;
  const auto row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n) / 4)));
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 at(static_cast<double>(i % row), static_cast<double>(i / row % row), static_cast<double>(i / row / row));
    boxes.push_back(box_at(1.1 * at.cwiseProduct(Vec3(1, 1, 0.9)) + dice.in_cube(0.2), 1));
  }
  return boxes;
}

struct BroadPhaseScene {
  std::string_view name;
  std::vector<Aabb> (*make)(std::size_t n);
};

inline constexpr BroadPhaseScene kBroadPhaseScenes[] = {{"uniform", uniform_scene},
                                                        {"clustered", clustered_scene},
                                                        {"uneven", uneven_scene},
                                                        {"planar pile", planar_scene}};

}  // namespace plumbline
