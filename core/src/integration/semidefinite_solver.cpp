#include "semidefinite_solver.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline::extended {
namespace {

constexpr Real kVanishing = 1e-13L;

}  // namespace

SemidefiniteSolver::SemidefiniteSolver(std::vector<Eigen::Index> first) : first_(std::move(first)) {
  Eigen::Index used = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    offset_.push_back(used - first_[i]);
    used += static_cast<Eigen::Index>(i) - first_[i] + 1;
  }
  values_ = Column::Zero(used);
  inverse_diagonal_ = Column::Zero(static_cast<Eigen::Index>(first_.size()));
}

void SemidefiniteSolver::clear() { values_.setZero(); }

void SemidefiniteSolver::factor() {
  for (Eigen::Index i = 0; i < inverse_diagonal_.size(); ++i) {
    const Eigen::Index first = first_[static_cast<std::size_t>(i)];
    Real* const mine = row(i);
    Real pivot = mine[i];
    for (Eigen::Index j = first; j < i; ++j) {
      const Real* const other = row(j);
      Real sum = mine[j];
      for (Eigen::Index k = std::max(first, first_[static_cast<std::size_t>(j)]); k < j; ++k) sum -= mine[k] * other[k];
      mine[j] = sum * inverse_diagonal_[j];
      pivot -= mine[j] * mine[j];
    }
    // NaN is not left out: it must show.
    inverse_diagonal_[i] = pivot <= kVanishing * mine[i] ? 0 : 1 / std::sqrt(pivot);
  }
}

void SemidefiniteSolver::solve(Column& b) const {
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const Real* const mine = row(i);
    Real sum = b[i];
    for (Eigen::Index j = first_[static_cast<std::size_t>(i)]; j < i; ++j) sum -= mine[j] * b[j];
    b[i] = sum * inverse_diagonal_[i];
  }
  for (Eigen::Index i = b.size(); i-- > 0;) {
    const Real* const mine = row(i);
    b[i] *= inverse_diagonal_[i];
    for (Eigen::Index j = first_[static_cast<std::size_t>(i)]; j < i; ++j) b[j] -= mine[j] * b[i];
  }
}

}  // namespace plumbline::extended
