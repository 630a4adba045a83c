// A x = b in extended precision for symmetric positive semidefinite A, by Cholesky's factors within the envelope.
//
// A row whose pivot vanishes depends on the rows before it: it is left out, which solves a system without
// contradictions all the same (x there is 0). So redundant joints cost nothing but their row. What is left out: pivots
// below 1e-13 of the diagonal. Rounding leaves some 1e-18 where 0 is meant; of joints that are about to become
// dependent it sees the square of the angle that is left, here 3e-7 rad.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumbline::extended {

using Real = long double;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

class SemidefiniteSolver {
 public:
  SemidefiniteSolver() = default;
  // first[i] <= i: the first column of row i that is not zero; it stays so in the factor.
  explicit SemidefiniteSolver(std::vector<Eigen::Index> first);

  void clear();
  Real& at(Eigen::Index row, Eigen::Index column) { return values_[offset_[static_cast<std::size_t>(row)] + column]; }
  void factor();
  void solve(Column& b) const;

 private:
  Real* row(Eigen::Index i) { return values_.data() + offset_[static_cast<std::size_t>(i)]; }
  const Real* row(Eigen::Index i) const { return values_.data() + offset_[static_cast<std::size_t>(i)]; }

  std::vector<Eigen::Index> first_, offset_;  // offset: of column 0, which may lie before the row
  Column values_, inverse_diagonal_;          // 0 where the row is left out
};

}  // namespace plumbline::extended
