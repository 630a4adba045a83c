#include "plumbline/core/constraints/keep_out.hpp"

#include <limits>
#include <stdexcept>

namespace plumbline {

namespace {

constexpr double kFarthest = std::numeric_limits<double>::infinity();

struct HasSize {
  bool operator()(const Sphere& sphere) const { return sphere.radius > 0; }
  bool operator()(const Box& box) const { return box.size.minCoeff() > 0; }
  bool operator()(const HalfSpace& half_space) const { return half_space.normal.norm() > 0; }
  bool operator()(const Cylinder&) const {
    throw std::invalid_argument("an obstacle is a sphere, a box or a half-space; a cylinder is none of them");
  }
};

const Obstacle& checked(const Obstacle& obstacle) {
  if (!std::visit(HasSize{}, obstacle.shape))
    throw std::invalid_argument("an obstacle needs a radius, edges or a normal greater than zero");
  return obstacle;
}

}  // namespace

ParticleKeepOut::ParticleKeepOut(std::size_t particle, const Obstacle& obstacle)
    : Constraint({particle}, 0, kFarthest), obstacle_(checked(obstacle)) {}

double ParticleKeepOut::quantity(std::span<const Vec3> p_W) const { return gap_to_point(obstacle_, p_W[0]).distance; }

PerParticle ParticleKeepOut::gradient(std::span<const Vec3> p_W) const {
  return {gap_to_point(obstacle_, p_W[0]).normal_W, Vec3::Zero(), Vec3::Zero()};
}

LinkKeepOut::LinkKeepOut(std::size_t a, std::size_t b, const Obstacle& obstacle)
    : Constraint({a, b}, 0, kFarthest), obstacle_(checked(obstacle)) {}

double LinkKeepOut::quantity(std::span<const Vec3> p_W) const {
  return gap_to_link(obstacle_, p_W[0], p_W[1]).distance;
}

PerParticle LinkKeepOut::gradient(std::span<const Vec3> p_W) const {
  const LinkGap gap = gap_to_link(obstacle_, p_W[0], p_W[1]);
  return {(1 - gap.s) * gap.normal_W, gap.s * gap.normal_W, Vec3::Zero()};
}

}  // namespace plumbline
