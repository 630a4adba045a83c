// The gas of the benchmark behind one small door for each engine: their headers would quarrel in one source file.
#pragma once

#include <memory>
#include <span>

#include "plumbline/core/kinetics/sphere_stepper.hpp"

namespace plumbline::bench {

// Spheres in a box with elastic walls and without gravity. Walls are given to each engine in the form that suits its
// broad phase: boxes or segments along the sides, not planes without end that would touch every bounding box.
class GasWorld {
 public:
  virtual ~GasWorld() = default;
  virtual void step(double dt) = 0;
  virtual void read(std::span<SteppedSphere> spheres) const = 0;  // positions and velocities
};

// Three-dimensional.
std::unique_ptr<GasWorld> make_bullet_gas(const SphereBoxScene& scene);  // in single precision
std::unique_ptr<GasWorld> make_ode_gas(const SphereBoxScene& scene);
// Discs in the x-y plane.
std::unique_ptr<GasWorld> make_box2d_gas(const SphereBoxScene& scene);
std::unique_ptr<GasWorld> make_chipmunk_gas(const SphereBoxScene& scene);

// Half of a wall's thickness [m].
inline constexpr double kHalfWall = 1;

}  // namespace plumbline::bench
