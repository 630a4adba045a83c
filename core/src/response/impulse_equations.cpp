#include "impulse_equations.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace plumbline {
namespace {

// Four corners under a box share its weight in many ways, which makes the equations singular along directions that no
// velocity feels. This share of the diagonal shuts them off, and spoils what velocities feel by as little.
constexpr double kShare = 1e-10;

// Normal first, then two directions across it.
Mat3 axes_of(const Contact& c) {
  Mat3 axes;
  axes.col(0) = c.normal_W;
  axes.col(1) = c.normal_W.unitOrthogonal();
  axes.col(2) = c.normal_W.cross(axes.col(1));
  return axes;
}

// How the relative velocity at point i answers an impulse at point j.
Mat3 mobility(const Contact& i, const Contact& j, std::span<const Inertness> inertness,
              std::span<const BodyState> states) {
  Mat3 sum = Mat3::Zero();
  const auto add = [&](std::size_t body, double sign) {
    if (inertness[body].inverse_mass == 0) return;
    const Vec3& p = states[body].p_WB;
    sum += sign * point_mobility(inertness[body], i.point_W - p, j.point_W - p);
  };
  if (i.body_a == j.body_a) add(i.body_a, 1);
  if (i.body_b == j.body_b) add(i.body_b, 1);
  if (i.body_a == j.body_b) add(i.body_a, -1);
  if (i.body_b == j.body_a) add(i.body_b, -1);
  return sum;
}

// F(J) = 0 at one point, in its own axes and as impulses [N s]: its value, and how it changes with the point's impulse
// and with its velocity.
struct Equation {
  Vec3 value = Vec3::Zero();
  Mat3 by_impulse = Mat3::Zero(), by_velocity = Mat3::Zero();
};

Equation equation_of(const ImpactPoint& point, const PointImpulse& p, const Mat3& axes, const Vec3& velocity_W) {
  const Vec3 v = axes.transpose() * velocity_W, impulse = axes.transpose() * p.tangent;
  Equation e;
  e.value.x() = p.normal_mass * (v.x() - point.rebound_speed);
  e.by_velocity(0, 0) = p.normal_mass;
  e.by_impulse(0, 0) = kShare;

  const double bound = point.friction * p.normal;
  const Eigen::Vector2d q = impulse.tail<2>() - p.tangent_mass * v.tail<2>();
  const double length = q.norm();
  const auto identity = Eigen::Matrix2d::Identity();
  if (point.friction == 0) {
    e.by_impulse.bottomRightCorner<2, 2>() = identity;
  } else if (length <= bound) {
    e.value.tail<2>() = p.tangent_mass * v.tail<2>();
    e.by_velocity.bottomRightCorner<2, 2>() = p.tangent_mass * identity;
    e.by_impulse.bottomRightCorner<2, 2>() = kShare * identity;
  } else {
    const Eigen::Vector2d d = q / length;
    const Eigen::Matrix2d turn = bound / length * (identity - d * d.transpose());
    e.value.tail<2>() = impulse.tail<2>() - bound * d;
    e.by_impulse.bottomRightCorner<2, 2>() = (1 + kShare) * identity - turn;
    e.by_impulse.bottomLeftCorner<2, 1>() = -point.friction * d;
    e.by_velocity.bottomRightCorner<2, 2>() = p.tangent_mass * turn;
  }
  return e;
}

}  // namespace

Mat3 point_mobility(const Inertness& body, const Vec3& r, const Vec3& s) {
  return body.inverse_mass * Mat3::Identity() - cross_matrix(r) * body.inverse_inertia_W * cross_matrix(s);
}

void solve_pushing_points(std::span<const ImpactPoint> points, std::span<const Inertness> inertness,
                          std::span<const BodyState> states, std::span<PointImpulse> impulses) {
  std::vector<std::size_t> pushing;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (impulses[k].normal > 0) pushing.push_back(k);
  }
  if (pushing.empty()) return;
  // Without friction the two unknowns across the normal are zero and need no room.
  const bool smooth = std::all_of(points.begin(), points.end(), [](const ImpactPoint& p) { return p.friction == 0; });
  const Eigen::Index width = smooth ? 1 : 3, size = width * static_cast<Eigen::Index>(pushing.size());
  Eigen::MatrixXd matrix(size, size);
  Eigen::VectorXd right(size);
  std::vector<Mat3> axes;
  for (const std::size_t k : pushing) axes.push_back(axes_of(points[k].contact));

  for (std::size_t i = 0; i < pushing.size(); ++i) {
    const ImpactPoint& point = points[pushing[i]];
    const Equation e = equation_of(point, impulses[pushing[i]], axes[i], contact_velocity(point.contact, states));
    const Eigen::Index row = width * static_cast<Eigen::Index>(i);
    right.segment(row, width) = -e.value.head(width);
    for (std::size_t j = 0; j < pushing.size(); ++j) {
      const Mat3 answer = mobility(point.contact, points[pushing[j]].contact, inertness, states);
      Mat3 block = e.by_velocity * (axes[i].transpose() * answer * axes[j]);
      if (i == j) block += e.by_impulse;
      matrix.block(row, width * static_cast<Eigen::Index>(j), width, width) = block.topLeftCorner(width, width);
    }
  }
  const Eigen::VectorXd change = matrix.partialPivLu().solve(right);
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    Vec3 step = Vec3::Zero();
    step.head(width) = change.segment(width * static_cast<Eigen::Index>(i), width);
    PointImpulse& p = impulses[pushing[i]];
    p.normal += step.x();
    p.tangent += axes[i].rightCols<2>() * step.tail<2>();
  }
}

}  // namespace plumbline
