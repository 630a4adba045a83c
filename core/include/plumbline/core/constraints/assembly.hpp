// Particles and what holds them together: an articulated body (course slide 35, example 4), or several of them.
#pragma once

#include "plumbline/core/constraints/constraint.hpp"
#include "plumbline/core/constraints/obstacle.hpp"

namespace plumbline {

struct Assembly {
  std::vector<Vec3> p_W;               // [m]
  std::vector<Vec3> v_W;               // [m/s]
  std::vector<double> inverse_masses;  // [1/kg]; 0 holds a particle in place
  ConstraintList constraints;

  // Adds a particle and returns its number. mass > 0 [kg], infinite for a particle that is held in place; throws
  // std::invalid_argument for others.
  std::size_t add_particle(double mass, const Vec3& position_W, const Vec3& velocity_W = Vec3::Zero());

  // Keeps every particle that can move out of that obstacle.
  void keep_particles_out_of(const Obstacle& obstacle);
};

}  // namespace plumbline
