#include "plumbline/core/constraints/assembly.hpp"

#include <stdexcept>

#include "plumbline/core/constraints/keep_out.hpp"

namespace plumbline {

std::size_t Assembly::add_particle(double mass, const Vec3& position_W, const Vec3& velocity_W) {
  if (!(mass > 0)) throw std::invalid_argument("a particle needs a mass > 0; infinite holds it in place");
  p_W.push_back(position_W);
  v_W.push_back(velocity_W);
  inverse_masses.push_back(1 / mass);
  return p_W.size() - 1;
}

void Assembly::keep_particles_out_of(const Obstacle& obstacle) {
  for (std::size_t i = 0; i < p_W.size(); ++i) {
    if (inverse_masses[i] > 0) constraints.add(ParticleKeepOut(i, obstacle));
  }
}

}  // namespace plumbline
