#include "plumbline/core/broad_phase/enclosing_sphere.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumbline {
namespace {

// Points this much outside, relative to the squared radius, count as inside: rounding must not make the search run on.
constexpr double kSlack = 1e-12;

struct Support {
  std::array<Vec3, 4> points;
  int count = 0;
};

bool outside(const BoundingSphere& sphere, const Vec3& point) {
  return (point - sphere.centre).squaredNorm() > sphere.radius * sphere.radius * (1 + kSlack);
}

// The smallest sphere with all supporting points on its surface. Its centre is p0 + sum_k l_k d_k with d_k = pk - p0;
// equal distances to p0 and pk mean 2 d_k . sum_j l_j d_j = d_k . d_k: a system of at most three equations. Points on a
// line (or plane) make it singular; full pivoting then leaves out the directions that add nothing.
BoundingSphere through(const Support& support) {
  if (support.count == 0) return {Vec3::Zero(), -1};  // contains nothing: see below
  const Vec3& p0 = support.points[0];
  const int n = support.count - 1;
  if (n == 0) return {p0, 0};
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> d(3, n);
  for (int k = 0; k < n; ++k) d.col(k) = support.points[static_cast<std::size_t>(k) + 1] - p0;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = 2 * d.transpose() * d;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> squares = d.colwise().squaredNorm().transpose();
  const Vec3 offset = d * gram.fullPivLu().solve(squares);
  return {p0 + offset, offset.norm()};
}

// Around the first `count` points, with the supporting ones on its surface: add the points one by one; one that falls
// outside must lie on the surface of the sphere around its predecessors and itself. It moves to the front, since a
// point that mattered once is likely to matter again.
BoundingSphere smallest(std::vector<Vec3>& points, std::size_t count, Support support) {
  BoundingSphere sphere = through(support);
  if (support.count == 4) return sphere;
  for (std::size_t k = 0; k < count; ++k) {
    if (sphere.radius >= 0 && !outside(sphere, points[k])) continue;
    Support with = support;
    with.points[static_cast<std::size_t>(with.count++)] = points[k];
    sphere = smallest(points, k, with);
    const auto at = points.begin() + static_cast<std::ptrdiff_t>(k);
    std::rotate(points.begin(), at, at + 1);
  }
  return sphere;
}

}  // namespace

BoundingSphere enclosing_sphere(std::span<const Vec3> points_W) {
  if (points_W.empty()) throw std::invalid_argument("no points to enclose: give one at least");
  for (std::size_t k = 0; k < points_W.size(); ++k) {
    if (!points_W[k].allFinite())
      throw std::invalid_argument("point " + std::to_string(k) + " to enclose is not finite");
  }
  // Relative to their middle, so that points far from the origin keep their digits; shuffled, since the expected time
  // is one over random orders and a sorted mesh would be a bad case.
  const Aabb box = bounding_box(points_W);
  const Vec3 middle = centre(box);
  std::vector<Vec3> points;
  for (const Vec3& p : points_W) points.push_back(p - middle);
  std::mt19937_64 random(1991);
  for (std::size_t k = points.size(); k > 1; --k) std::swap(points[k - 1], points[random() % k]);

  BoundingSphere sphere = smallest(points, points.size(), {});
  sphere.centre += middle;
  sphere.radius = 0;
  for (const Vec3& p : points_W) sphere.radius = std::max(sphere.radius, (p - sphere.centre).norm());
  return sphere;
}

}  // namespace plumbline
