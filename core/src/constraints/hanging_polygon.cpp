#include "plumbline/core/constraints/hanging_polygon.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace plumbline {

namespace {

using Vec2 = Eigen::Vector2d;

// sum l_k T_k - H X - S_0 Z with its derivatives in (H, S_0).
struct Potential {
  double value = 0;
  Vec2 slope = Vec2::Zero();
  Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
};

Potential potential(const Vec2& pull, const Vec2& end, std::span<const double> lengths, std::span<const double> below) {
  Potential result{-pull.dot(end), -end, Eigen::Matrix2d::Zero()};
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const Vec2 force(pull.x(), pull.y() + below[k]);
    const double tension = force.norm();
    const Vec2 across(-force.y() / tension, force.x() / tension);
    result.value += lengths[k] * tension;
    result.slope += lengths[k] * force / tension;
    result.curvature += lengths[k] / tension * across * across.transpose();
  }
  return result;
}

}  // namespace

HangingPolygon hanging_polygon(const Vec3& first_W, const Vec3& last_W, std::span<const double> lengths,
                               std::span<const double> weights) {
  const Vec3 reach(last_W.x() - first_W.x(), last_W.y() - first_W.y(), 0);
  const Vec2 end(reach.norm(), last_W.z() - first_W.z());
  const double length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const double weight = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (lengths.size() != weights.size() + 1)
    throw std::invalid_argument("a hanging polygon needs one weight for each joint between its links");
  for (const double l : lengths)
    if (!(l > 0)) throw std::invalid_argument("a hanging polygon needs links longer than 0");
  for (const double w : weights)
    if (!(w >= 0)) throw std::invalid_argument("a hanging polygon needs weights >= 0");
  if (!(weight > 0)) throw std::invalid_argument("a hanging polygon needs some weight");
  if (!(end.x() > 0)) throw std::invalid_argument("a hanging polygon needs ends that are not above each other");
  if (!(length > end.norm())) throw std::invalid_argument("a hanging polygon needs links longer than the way between");

  // Would the chain reach with the links before k hanging straight down and those after it straight up, link k slack?
  double drop = length;  // of the links after k, minus that of those before
  for (const double l : lengths) {
    drop -= l;
    if (std::hypot(end.x(), end.y() - drop) <= l)
      throw std::invalid_argument("a hanging polygon has a link so long that it would have to push: make it shorter");
    drop -= l;
  }

  std::vector<double> below(lengths.size(), 0);  // weight of the joints before each link
  std::partial_sum(weights.begin(), weights.end(), below.begin() + 1);
  Vec2 pull(weight, -0.5 * weight);
  Potential at = potential(pull, end, lengths, below);
  for (int k = 0; k < 500; ++k) {
    const Vec2 step = -at.curvature.inverse() * at.slope;
    // The value must fall; so near the minimum that it no longer resolves the gain, the slope must.
    const bool near = at.slope.norm() < 1e-6 * length;
    double share = 1;
    Potential next = potential(pull + step, end, lengths, below);
    const auto better = [&] {
      return near ? next.slope.norm() < at.slope.norm() : next.value < at.value + 1e-4 * share * at.slope.dot(step);
    };
    while (!better() && share > 1e-12) {
      share *= 0.5;
      next = potential(pull + share * step, end, lengths, below);
    }
    if (!better()) break;
    pull += share * step;
    at = next;
  }

  if (!(at.slope.norm() <= 1e-9 * length))
    throw std::invalid_argument("a hanging polygon was not found: its links are too nearly as long as the way between");

  HangingPolygon result;
  const Vec3 ahead = reach / end.x();
  result.p_W.push_back(first_W);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const double s = pull.y() + below[k];
    const double tension = std::hypot(pull.x(), s);
    result.tensions.push_back(tension);
    result.p_W.push_back(result.p_W.back() + lengths[k] / tension * (pull.x() * ahead + s * Vec3::UnitZ()));
  }
  return result;
}

}  // namespace plumbline
