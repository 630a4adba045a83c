#include "plumbline/core/mass/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline {

PrincipalAxes principal_axes(const Mat3& inertia) {
  require_physical({1, Vec3::Zero(), inertia});
  if (inertia.isDiagonal(0)) return {inertia.diagonal(), Quat::Identity()};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);

  // Of the six ways to name the axes, the one whose rotation is closest to none.
  std::array<int, 3> order{0, 1, 2}, best = order;
  double closest = -1;
  do {
    double alignment = 0;
    for (int k = 0; k < 3; ++k) alignment += std::abs(solver.eigenvectors()(k, order[static_cast<std::size_t>(k)]));
    if (alignment > closest) {
      closest = alignment;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));

  PrincipalAxes result;
  Mat3 r_FB;
  for (int k = 0; k < 3; ++k) {
    const int from = best[static_cast<std::size_t>(k)];
    // Rounding may leave the moment of a rod about itself a little under 0.
    result.moments(k) = std::max(0.0, solver.eigenvalues()(from));
    const Vec3 axis = solver.eigenvectors().col(from);
    r_FB.col(k) = axis(k) < 0 ? Vec3(-axis) : axis;
  }
  if (r_FB.determinant() < 0) {
    int least = 0;
    r_FB.diagonal().minCoeff(&least);
    r_FB.col(least) = -r_FB.col(least);
  }
  result.q_FB = Quat(r_FB).normalized();
  return result;
}

void give_mass(Body& body, const MassProperties& properties, const Quat& q_WF, const Vec3& p_WF) {
  require_physical(properties);
  const PrincipalAxes axes = principal_axes(properties.inertia_com);
  body.mass = properties.mass;
  body.inertia = axes.moments;
  body.initial.p_WB = p_WF + q_WF * properties.com;
  body.initial.q_WB = (q_WF * axes.q_FB).normalized();
}

}  // namespace plumbline
