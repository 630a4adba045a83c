#include "plumbline/core/constraints/relaxation.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "plumbline/core/metric.hpp"

namespace plumbline {

namespace {

// The positions or masses of a constraint's own particles.
template <class T>
std::array<T, kMostParticles> own(const Constraint& constraint, std::span<const T> all) {
  std::array<T, kMostParticles> result{};
  std::size_t k = 0;
  for (const std::size_t i : constraint.particles()) result[k++] = all[i];
  return result;
}

void check(const ConstraintList& constraints, std::span<const double> inverse_masses, std::size_t positions,
           const RelaxationOptions& options) {
  if (inverse_masses.size() != positions)
    throw std::invalid_argument("relaxation needs one inverse mass per position; 0 holds a particle in place");
  for (const double w : inverse_masses) {
    if (!(w >= 0)) throw std::invalid_argument("an inverse mass must be >= 0; 0 holds a particle in place");
  }
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    for (const std::size_t i : constraints[k].particles()) {
      if (i >= positions)
        throw std::invalid_argument("constraint " + std::to_string(k) + " names particle " + std::to_string(i) +
                                    ", but there are " + std::to_string(positions));
    }
  }
  if (options.sweeps < 0) throw std::invalid_argument("relaxation needs sweeps >= 0");
  if (!(options.tolerance >= 0)) throw std::invalid_argument("relaxation needs a tolerance >= 0");
  if (!(options.factor > 0 && options.factor < 2))
    throw std::invalid_argument("relaxation needs a factor between 0 and 2; beyond them it diverges");
}

}  // namespace

double largest_violation(const ConstraintList& constraints, std::span<const Vec3> p_W) {
  double largest = 0;
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    const auto p = own(constraints[k], p_W);
    const std::span<const Vec3> here(p.data(), constraints[k].particles().size());
    largest = max_or_nan(largest, std::abs(constraints[k].violation(here)));
  }
  return largest;
}

RelaxationReport relax(const ConstraintList& constraints, std::span<const double> inverse_masses, std::span<Vec3> p_W,
                       const RelaxationOptions& options, std::span<const Vec3> start_W) {
  check(constraints, inverse_masses, p_W.size(), options);
  if (!start_W.empty() && start_W.size() != p_W.size())
    throw std::invalid_argument("relaxation needs as many start positions as positions, or none");
  RelaxationReport report;
  report.multipliers.assign(constraints.size(), 0.0);
  report.residuals.push_back(largest_violation(constraints, p_W));
  std::vector<Vec3> next;  // Jacobi gathers its motions here
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    // NaN goes on: no number of sweeps brings it within the tolerance.
    if (report.residuals.back() <= options.tolerance) break;
    const bool at_once = options.order == SweepOrder::kJacobi;
    if (at_once) next.assign(p_W.begin(), p_W.end());
    for (std::size_t k = 0; k < constraints.size(); ++k) {
      const Constraint& constraint = constraints[k];
      const std::size_t count = constraint.particles().size();
      const auto p = own<Vec3>(constraint, p_W);
      const auto w = own(constraint, inverse_masses);
      const std::span<const Vec3> here(p.data(), count);
      const std::span<const double> masses(w.data(), count);
      if (constraint.violation(here) == 0) continue;
      MinimalMotion motion;
      if (!start_W.empty()) {
        const auto start = own(constraint, start_W);
        motion = motion_along(constraint, constraint.gradient({start.data(), count}), here, masses);
      }
      if (motion.multiplier == 0) motion = constraint.minimal_motion(here, masses);
      report.multipliers[k] += options.factor * motion.multiplier;
      for (std::size_t j = 0; j < count; ++j) {
        Vec3& target = at_once ? next[constraint.particles()[j]] : p_W[constraint.particles()[j]];
        target += options.factor * motion.d_W[j];
      }
    }
    if (at_once) std::copy(next.begin(), next.end(), p_W.begin());
    report.residuals.push_back(largest_violation(constraints, p_W));
  }
  report.within_tolerance = report.residuals.back() <= options.tolerance;
  return report;
}

}  // namespace plumbline
