#include "plumbline/core/constraints/verlet_relaxation.hpp"

#include <algorithm>
#include <stdexcept>

namespace plumbline {

VerletRelaxation::VerletRelaxation(Assembly assembly, double dt, const VerletOptions& options)
    : assembly_(std::move(assembly)), dt_(dt), options_(options) {
  if (!(dt > 0)) throw std::invalid_argument("Verlet with relaxation needs dt > 0");
  if (!(options.drag >= 0 && options.drag * dt <= 1))
    throw std::invalid_argument("Verlet with relaxation needs 0 <= drag dt <= 1: more would turn velocities round");
  if (assembly_.v_W.size() != assembly_.p_W.size())
    throw std::invalid_argument("an assembly needs one velocity per position");
  RelaxationOptions none = options.relaxation;
  none.sweeps = std::min(none.sweeps, 0);
  relax(assembly_.constraints, assembly_.inverse_masses, assembly_.p_W, none);  // for its checks only: moves nothing
  for (std::size_t i = 0; i < assembly_.p_W.size(); ++i)
    previous_W_.push_back(assembly_.p_W[i] - dt * assembly_.v_W[i] + 0.5 * dt * dt * options_.gravity_W);
}

RelaxationReport VerletRelaxation::step() {
  const std::vector<Vec3> none(assembly_.p_W.size(), Vec3::Zero());
  return step(none);
}

RelaxationReport VerletRelaxation::step(std::span<const Vec3> forces_W) {
  const std::size_t count = assembly_.p_W.size();
  if (forces_W.size() != count) throw std::invalid_argument("a step needs one force per particle, or none at all");
  std::vector<Vec3> next(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& p = assembly_.p_W[i];
    const double w = assembly_.inverse_masses[i];
    const Vec3 a = options_.gravity_W + w * forces_W[i];
    next[i] = w == 0 ? p : Vec3(p + (1 - options_.drag * dt_) * (p - previous_W_[i]) + dt_ * dt_ * a);
  }
  const std::span<const Vec3> start = options_.pull == Pull::kStart ? assembly_.p_W : std::span<const Vec3>();
  const RelaxationReport report =
      relax(assembly_.constraints, assembly_.inverse_masses, next, options_.relaxation, start);
  previous_W_ = std::move(assembly_.p_W);
  assembly_.p_W = std::move(next);
  ++steps_;
  return report;
}

}  // namespace plumbline
