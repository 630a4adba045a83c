#include "plumbline/core/constraints/penalty_springs.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace plumbline {

namespace {

std::array<Vec3, kMostParticles> gather(const Constraint& constraint, std::span<const Vec3> p_W) {
  std::array<Vec3, kMostParticles> result{};
  std::size_t k = 0;
  for (const std::size_t i : constraint.particles()) result[k++] = p_W[i];
  return result;
}

}  // namespace

AccelerationField penalty_field(ConstraintList constraints, std::vector<double> inverse_masses, const Vec3& gravity_W,
                                const PenaltySpring& spring) {
  if (!(spring.stiffness >= 0 && spring.damping >= 0))
    throw std::invalid_argument("a penalty spring needs stiffness >= 0 and damping >= 0");
  return [=](double, std::span<const BodyState> states, std::span<Acceleration> accelerations) {
    if (states.size() != inverse_masses.size() || accelerations.size() != inverse_masses.size())
      throw std::invalid_argument("penalty springs need one state and one acceleration per inverse mass");
    for (std::size_t i = 0; i < states.size(); ++i)
      accelerations[i] = {inverse_masses[i] == 0 ? Vec3(Vec3::Zero()) : gravity_W, Vec3::Zero()};
    for (std::size_t k = 0; k < constraints.size(); ++k) {
      const auto particles = constraints[k].particles();
      std::array<Vec3, kMostParticles> p{};
      for (std::size_t j = 0; j < particles.size(); ++j) p[j] = states[particles[j]].p_WB;
      const std::span<const Vec3> here(p.data(), particles.size());
      const double violation = constraints[k].violation(here);
      if (violation == 0) continue;
      const PerParticle gradient = constraints[k].gradient(here);
      double rate = 0;
      for (std::size_t j = 0; j < particles.size(); ++j) rate += gradient[j].dot(states[particles[j]].v_WB);
      const double pull = spring.stiffness * violation + spring.damping * rate;
      for (std::size_t j = 0; j < particles.size(); ++j)
        accelerations[particles[j]].linear -= pull * inverse_masses[particles[j]] * gradient[j];
    }
  };
}

double largest_penalty_frequency(const ConstraintList& constraints, std::span<const double> inverse_masses,
                                 std::span<const Vec3> p_W, const PenaltySpring& spring) {
  if (inverse_masses.size() != p_W.size())
    throw std::invalid_argument("penalty springs need one inverse mass per position");
  const auto rows = static_cast<Eigen::Index>(constraints.size());
  if (rows == 0) return 0;
  // S = sqrt(k) G W^1/2, with the eigenvalues of S S^T = k G W G^T.
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(rows, 3 * static_cast<Eigen::Index>(p_W.size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Constraint& constraint = constraints[static_cast<std::size_t>(row)];
    const auto particles = constraint.particles();
    const auto p = gather(constraint, p_W);
    const PerParticle gradient = constraint.gradient({p.data(), particles.size()});
    for (std::size_t j = 0; j < particles.size(); ++j) {
      const double weight = std::sqrt(spring.stiffness * inverse_masses[particles[j]]);
      s.block<1, 3>(row, 3 * static_cast<Eigen::Index>(particles[j])) = weight * gradient[j].transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(s * s.transpose(), Eigen::EigenvaluesOnly);
  return std::sqrt(eigen.eigenvalues().maxCoeff());
}

double largest_stable_step(double frequency, double damping_ratio) {
  if (!(frequency > 0 && damping_ratio >= 0))
    throw std::invalid_argument("a stable step needs a frequency > 0 and a damping ratio >= 0");
  // sqrt(1 + zeta^2) - zeta, written so that large zeta does not cancel.
  return 2 / (frequency * (std::sqrt(1 + damping_ratio * damping_ratio) + damping_ratio));
}

}  // namespace plumbline
