// Random numbers, solids and motions for the tests of impacts: the same on every platform.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "plumbline/core/collision/convex_polyhedron.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {

class SceneRandom {
 public:
  explicit SceneRandom(std::uint64_t seed) : engine_(seed) {}

  // 53 bits, as many as a double of [0, 1) has.
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int below(int count) { return static_cast<int>(in(0, count)); }
  Vec3 vector(double size) {
    const double x = in(-size, size), y = in(-size, size);
    return {x, y, in(-size, size)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Quat attitude() { return rotation_by(3 * vector(1)); }

  // A box, a tetrahedron or the hull of some more points, between a quarter of a metre and two metres across.
  ConvexPolyhedron solid() {
    const int kind = below(3);
    if (kind == 0) {
      const double x = in(0.2, 1), y = in(0.2, 1);
      return box_polyhedron(Vec3(x, y, in(0.2, 1)));
    }
    std::vector<Vec3> points;
    for (int k = kind == 1 ? 4 : 5 + below(5); k > 0; --k) points.push_back(in(0.3, 1) * direction());
    return convex_hull(points);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace plumbline
