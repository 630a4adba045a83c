#include "plumbline/core/constraints/chain.hpp"

#include <limits>
#include <stdexcept>

#include "plumbline/core/constraints/link_constraint.hpp"

namespace plumbline {

Assembly make_chain(std::span<const Vec3> p_W, double mass, bool last_held) {
  if (p_W.size() < 2) throw std::invalid_argument("a chain needs at least two positions");
  constexpr double kHeld = std::numeric_limits<double>::infinity();
  Assembly chain;
  for (std::size_t i = 0; i < p_W.size(); ++i) {
    const bool held = i == 0 || (last_held && i + 1 == p_W.size());
    chain.add_particle(held ? kHeld : mass, p_W[i]);
    if (i > 0) chain.constraints.add(LinkConstraint(i - 1, i, (p_W[i] - p_W[i - 1]).norm()));
  }
  return chain;
}

std::vector<Vec3> row_of_points(const Vec3& first_W, const Vec3& last_W, std::size_t links) {
  std::vector<Vec3> result;
  for (std::size_t k = 0; k <= links; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(links);
    result.push_back((1 - s) * first_W + s * last_W);
  }
  return result;
}

}  // namespace plumbline
