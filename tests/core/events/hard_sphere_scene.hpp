// Gases to start from, and the slow gas that the fast one must agree with.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "plumbline/core/events/hard_sphere_gas.hpp"

namespace plumbline::gas {

struct Scene {
  std::vector<Vec3> positions, velocities;
  double diameter = 1;
  Vec3 box = Vec3::Zero();
};

// Normal numbers from the raw bits of the generator, since the distributions of the standard differ between libraries.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : bits_(seed) {}
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }
  double operator()() {  // Box and Muller
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 bits_;
};

// nx x ny x nz cells of a face-centred lattice, four spheres each, at that number density (times the diameter cubed),
// with Maxwell's velocities: no total momentum, mean square 3.
inline Scene lattice_gas(int nx, int ny, int nz, double density, std::uint64_t seed) {
  Scene scene;
  Normal normal(seed);
  const double edge = std::cbrt(4 / density);
  scene.box = edge * Vec3(nx, ny, nz);
  const Vec3 places[] = {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)};
  Vec3 mean = Vec3::Zero();
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      for (int z = 0; z < nz; ++z) {
        for (const Vec3& place : places) {
          scene.positions.push_back(edge * (Vec3(x, y, z) + place));
          const double a = normal(), b = normal(), c = normal();
          scene.velocities.emplace_back(a, b, c);
          mean += scene.velocities.back();
        }
      }
    }
  }
  const double n = static_cast<double>(scene.positions.size());
  double squares = 0;
  for (Vec3& v : scene.velocities) squares += (v -= mean / n).squaredNorm();
  for (Vec3& v : scene.velocities) v *= std::sqrt(3 * n / squares);
  return scene;
}

// How far may two codes be apart? Collisions amplify every difference, by a factor that depends on the gas: so a second
// gas of the same code runs beside the first, disturbed by 1e-13 diameters, some hundred roundings. Whatever becomes of
// that is far more than what rounding alone makes, and still far less than what a wrong collision would.
inline constexpr double kDisturbance = 1e-13;
inline constexpr double kClockRounding =
    1e-14;  // of times of some seconds, before any collision has amplified anything

inline Scene disturbed(Scene scene) {
  Normal random(99);
  for (Vec3& p : scene.positions) {
    for (double& x : p) x += kDisturbance * (random.uniform() < 0.5 ? -1 : 1);
  }
  return scene;
}

// The simple motion simulator of course slide 24 as it stands there: all pairs, the earliest time, all spheres moved.
class BruteForceGas {
 public:
  explicit BruteForceGas(const Scene& scene)
      : p_(scene.positions), v_(scene.velocities), diameter_(scene.diameter), box_(scene.box) {}

  Vec3 way_around(const Vec3& r) const {
    return r - box_.cwiseProduct(r.cwiseQuotient(box_).unaryExpr([](double s) { return std::round(s); }));
  }

  HardSphereCollision collide_next() {
    double first = std::numeric_limits<double>::infinity();
    std::size_t a = 0, b = 0;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      for (std::size_t j = i + 1; j < p_.size(); ++j) {
        const double wait = meeting(i, j);
        if (wait < first) {
          first = wait;
          a = i;
          b = j;
        }
      }
    }
    for (std::size_t i = 0; i < p_.size(); ++i) p_[i] += v_[i] * first;
    now_ += first;
    const Vec3 n = way_around(p_[b] - p_[a]).normalized();
    const Vec3 exchanged = n.dot(v_[b] - v_[a]) * n;
    v_[a] += exchanged;
    v_[b] -= exchanged;
    return {now_, a, b};
  }

  const std::vector<Vec3>& positions() const { return p_; }
  const std::vector<Vec3>& velocities() const { return v_; }

 private:
  // The nearest image only: whoever is further than half an edge away collides with others, or comes nearer, before.
  double meeting(std::size_t i, std::size_t j) const {
    const Vec3 r = way_around(p_[j] - p_[i]), v = v_[j] - v_[i];
    const double rv = r.dot(v), gap = r.squaredNorm() - diameter_ * diameter_;
    const double radicand = rv * rv - v.squaredNorm() * gap;
    if (!(rv < 0) || radicand < 0) return std::numeric_limits<double>::infinity();
    return std::max(gap, 0.0) / (std::sqrt(radicand) - rv);
  }

  std::vector<Vec3> p_, v_;
  double diameter_;
  Vec3 box_;
  double now_ = 0;
};

}  // namespace plumbline::gas
