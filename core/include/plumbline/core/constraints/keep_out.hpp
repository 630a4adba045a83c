// Particles and links that must stay out of an obstacle (course slide 32; slide 35, example 3).
#pragma once

#include "plumbline/core/constraints/constraint.hpp"
#include "plumbline/core/constraints/obstacle.hpp"

namespace plumbline {

// q: signed distance of the particle from the obstacle, violated when negative [m]. Minimal motion: along the shortest
// way out.
class ParticleKeepOut : public Constraint {
 public:
  // Throws std::invalid_argument for an obstacle without size (radius, edges, normal must be > 0).
  ParticleKeepOut(std::size_t particle, const Obstacle& obstacle);
  double quantity(std::span<const Vec3> p_W) const override;
  PerParticle gradient(std::span<const Vec3> p_W) const override;

 private:
  Obstacle obstacle_;
};

// q: signed distance of the straight link between two particles, violated when negative [m]. With the point a (1 - s) +
// b s deepest, the gradient is (1 - s) n at a and s n at b. The minimal motion clears the link but may stretch it: that
// is for the link's own constraint in the list. Motions that keep the length stand in link_escape.hpp.
class LinkKeepOut : public Constraint {
 public:
  LinkKeepOut(std::size_t a, std::size_t b, const Obstacle& obstacle);
  double quantity(std::span<const Vec3> p_W) const override;
  PerParticle gradient(std::span<const Vec3> p_W) const override;

 private:
  Obstacle obstacle_;
};

}  // namespace plumbline
