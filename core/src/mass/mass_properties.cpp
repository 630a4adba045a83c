#include "plumbline/core/mass/mass_properties.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace plumbline {
namespace {

// m (|r|^2 1 - r r^T): the inertia of a point mass at r.
Mat3 point_inertia(double mass, const Vec3& r) {
  return mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
}

}  // namespace

MassProperties placed(const MassProperties& part, const Quat& q_AF, const Vec3& p_AF) {
  const Mat3 r_AF = q_AF.toRotationMatrix();
  return {part.mass, r_AF * part.com + p_AF, r_AF * part.inertia_com * r_AF.transpose()};
}

MassProperties compound(std::span<const MassProperties> parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.mass += part.mass;
    sum.com += part.mass * part.com;
  }
  if (!(sum.mass > 0)) throw std::invalid_argument("the parts of a compound leave no mass: check its holes");
  sum.com /= sum.mass;
  for (const MassProperties& part : parts) sum.inertia_com += inertia_about(part, sum.com);
  require_physical(sum);
  return sum;
}

MassProperties hole(const MassProperties& part) { return {-part.mass, part.com, -part.inertia_com}; }

Mat3 inertia_about(const MassProperties& part, const Vec3& q) {
  return part.inertia_com + point_inertia(part.mass, part.com - q);
}

void require_physical(const MassProperties& part) {
  if (!(part.mass > 0 && std::isfinite(part.mass) && part.com.allFinite() && part.inertia_com.allFinite())) {
    throw std::invalid_argument("a body needs a finite mass > 0, centre of mass and inertia tensor");
  }
  // Thin plates and rods lie on the edge of what is physical; the rounding of a sum may put them beyond by this much.
  const double rounding = 1e-12 * part.inertia_com.norm();
  if (!((part.inertia_com - part.inertia_com.transpose()).norm() <= rounding)) {
    throw std::invalid_argument("an inertia tensor is symmetric; this one is not");
  }
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(part.inertia_com, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments(0) >= -rounding && moments(2) - moments(1) - moments(0) <= rounding)) {
    throw std::invalid_argument(
        "no distribution of mass has these principal moments: one is negative or larger than the sum of the others; "
        "check units, and the holes of a compound");
  }
}

}  // namespace plumbline
