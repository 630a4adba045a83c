#include "plumbline/core/joints/least_change.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The factor of one body's 6 x 6 block of M = L L^T: sqrt(m), and R C with I_B = C C^T since I_W = R C (R C)^T.
struct MassRoot {
  double root_mass;
  Mat3 R;
  Mat3 C;
  Vec3 inverse(const Vec3& torque_W) const {
    return C.triangularView<Eigen::Lower>().solve((R.transpose() * torque_W).eval());
  }
  Vec3 inverse_transposed(const Vec3& z) const { return R * C.transpose().triangularView<Eigen::Upper>().solve(z); }
};

std::vector<MassRoot> mass_roots(const ArticulatedBody& body, std::span<const BodyState> states) {
  std::vector<MassRoot> roots;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyInertia& part = body.bodies[i];
    roots.push_back({std::sqrt(part.mass), states[i].q_WB.toRotationMatrix(), part.inertia_B.llt().matrixL()});
  }
  return roots;
}

// Y^T: one row for each row of J.
MatrixXd weighted_rows(std::span<const JointRow> rows, const std::vector<MassRoot>& roots) {
  MatrixXd Yt = MatrixXd::Zero(static_cast<Index>(rows.size()), static_cast<Index>(6 * roots.size()));
  const auto put = [&](Index r, std::size_t body, const Vec3& force, const Vec3& torque) {
    if (body == kWorld) return;
    const Index c = static_cast<Index>(6 * body);
    Yt.block<1, 3>(r, c) += (force / roots[body].root_mass).transpose();
    Yt.block<1, 3>(r, c + 3) += roots[body].inverse(torque).transpose();
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    put(static_cast<Index>(k), rows[k].a, -rows[k].force_W, rows[k].torque_a_W);
    put(static_cast<Index>(k), rows[k].b, rows[k].force_W, rows[k].torque_b_W);
  }
  return Yt;
}

LeastChange nothing_changes(std::size_t bodies, Index rows, double value) {
  LeastChange none;
  none.change.assign(bodies, {Vec3::Constant(value), Vec3::Constant(value)});
  none.multipliers = VectorXd::Constant(rows, value);
  none.residual = value;
  return none;
}

}  // namespace

LeastChange least_change(const ArticulatedBody& body, std::span<const BodyState> states, std::span<const JointRow> rows,
                         const VectorXd& wanted) {
  const Index count = static_cast<Index>(rows.size());
  if (wanted.size() != count) throw std::invalid_argument("least_change needs one wanted rate per row");
  if (count == 0) return nothing_changes(states.size(), 0, 0);
  const std::vector<MassRoot> roots = mass_roots(body, states);
  MatrixXd Yt = weighted_rows(rows, roots);
  // Rows in metres and in radians become comparable at unit length. A row of zeros (two ends in the world) stays one.
  VectorXd length = Yt.rowwise().norm();
  for (Index r = 0; r < count; ++r) length[r] = length[r] == 0 ? 1 : length[r];
  Yt = length.cwiseInverse().asDiagonal() * Yt;
  const VectorXd b = wanted.cwiseQuotient(length);
  // A pivoted decomposition cannot tell what rank NaN has.
  if (!Yt.allFinite() || !b.allFinite()) {
    return nothing_changes(states.size(), count, std::numeric_limits<double>::quiet_NaN());
  }

  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
  decomposition.setThreshold(kRankTolerance);
  decomposition.compute(Yt);
  const VectorXd z = decomposition.solve(b);
  LeastChange result;
  result.rank = decomposition.rank();
  const VectorXd scaled = decomposition.transpose().solve(z);
  result.multipliers = scaled.cwiseQuotient(length);
  result.residual = (Yt * z - b).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Index c = static_cast<Index>(6 * i);
    result.change.push_back({z.segment<3>(c) / roots[i].root_mass, roots[i].inverse_transposed(z.segment<3>(c + 3))});
  }
  return result;
}

Twist answer(const BodyInertia& body, const Quat& q_WB, const Vec3& force_W, const Vec3& torque_W) {
  const Mat3 R = q_WB.toRotationMatrix();
  return {force_W / body.mass, R * body.inertia_B.llt().solve((R.transpose() * torque_W).eval())};
}

double rate(const JointRow& row, std::span<const Twist> twists) {
  const Twist A = row.a == kWorld ? Twist{} : twists[row.a];
  const Twist B = row.b == kWorld ? Twist{} : twists[row.b];
  return row.rate(A.linear_W, A.angular_W, B.linear_W, B.angular_W);
}

}  // namespace plumbline
