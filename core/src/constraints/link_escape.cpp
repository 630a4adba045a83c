#include "plumbline/core/constraints/link_escape.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumbline {

namespace {

constexpr double kRounding = 1e-14;  // of positions, relative to their size
constexpr int kMostIterations = 500;

double size(const Link& link, const Obstacle& o) {
  return (link.a_W - o.p_WO).norm() + (link.b_W - o.p_WO).norm() + o.p_WO.norm();
}

LinkMotion motion_of(const Link& link, const Vec3& d_a_W, const Vec3& d_b_W) {
  double cost = 0;
  if (link.inverse_mass_a > 0) cost += d_a_W.squaredNorm() / link.inverse_mass_a;
  if (link.inverse_mass_b > 0) cost += d_b_W.squaredNorm() / link.inverse_mass_b;
  return {d_a_W, d_b_W, cost};
}

LinkGap gap_after(const Link& link, const Obstacle& o, const LinkMotion& motion) {
  return gap_to_link(o, link.a_W + motion.d_a_W, link.b_W + motion.d_b_W);
}

// The smallest motion with e . (d_b - d_a) = stretch (length kept) and n_a . d_a + n_b . d_b = rise for each given end:
// repeated linearisation about where the motion ends, whose fixed point is Lagrange's condition of constraint.hpp.
// Shares of each change as in constraint.cpp.
struct EndClearance {
  double share_a, share_b;  // of the gap's gradient
  Vec3 normal_W;
  double gap;
};

template <int kRows, class ClearanceAt>
std::optional<LinkMotion> constrained_motion(const Link& link, const Obstacle& o, ClearanceAt clearance_at) {
  using Matrix = Eigen::Matrix<double, kRows, 6>;
  using Vector = Eigen::Matrix<double, kRows, 1>;
  const double length = (link.b_W - link.a_W).norm();
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Vector6 w, before = Vector6::Zero(), d = Vector6::Zero();
  w << Vec3::Constant(link.inverse_mass_a), Vec3::Constant(link.inverse_mass_b);
  double share = 1;
  for (int k = 0; k < kMostIterations; ++k) {
    const Vec3 a = link.a_W + d.template head<3>(), b = link.b_W + d.template tail<3>();
    const Vec3 e = (b - a).normalized();
    Matrix g;
    Vector c;
    g.row(0) << -e.transpose(), e.transpose();
    c[0] = (b - a).norm() - length;
    for (int row = 1; row < kRows; ++row) {
      const EndClearance end = clearance_at(row, a, b);
      g.row(row) << end.share_a * end.normal_W.transpose(), end.share_b * end.normal_W.transpose();
      c[row] = end.gap;
    }
    const Matrix gw = g * w.asDiagonal();
    const Vector6 next = gw.transpose() * (gw * g.transpose()).fullPivLu().solve(g * d - c);
    const Vector6 change = next - d;
    const double turn = (change - before).squaredNorm();
    if (k > 0 && turn > 0) share = std::clamp(-share * before.dot(change - before) / turn, 0.02, 1.0);
    before = change;
    d += share * change;
    if (!(change.norm() > kRounding * 0.01 * size(link, o))) break;
  }
  const LinkMotion motion = motion_of(link, d.template head<3>(), d.template tail<3>());
  const double stretch = (link.b_W + motion.d_b_W - link.a_W - motion.d_a_W).norm() - length;
  const bool holds = std::abs(stretch) <= kRounding * size(link, o) &&
                     gap_after(link, o, motion).distance >= -kRounding * size(link, o);
  return holds ? std::optional(motion) : std::nullopt;
}

std::optional<LinkMotion> cheaper(const std::optional<LinkMotion>& one, const std::optional<LinkMotion>& other) {
  if (!one) return other;
  return other && other->cost < one->cost ? other : one;
}

// Out of a sphere: the gap of its nearest point. Out of anything flat: the deeper end just clear, or both ends.
std::optional<LinkMotion> both_out_of_sphere(const Link& link, const Obstacle& o) {
  return constrained_motion<2>(link, o, [&](int, const Vec3& a, const Vec3& b) {
    const LinkGap gap = gap_to_link(o, a, b);
    return EndClearance{1 - gap.s, gap.s, gap.normal_W, gap.distance};
  });
}

std::optional<LinkMotion> both_out_of_half_space(const Link& link, const Obstacle& o, const Vec3& n, double offset) {
  std::optional<LinkMotion> best;
  for (const double s : {0.0, 1.0}) {
    best = cheaper(best, constrained_motion<2>(link, o, [&](int, const Vec3& a, const Vec3& b) {
                     return EndClearance{1 - s, s, n, n.dot((1 - s) * a + s * b) - offset};
                   }));
  }
  return cheaper(best, constrained_motion<3>(link, o, [&](int row, const Vec3& a, const Vec3& b) {
                   const double s = row - 1;
                   return EndClearance{1 - s, s, n, n.dot((1 - s) * a + s * b) - offset};
                 }));
}

}  // namespace

std::optional<LinkMotion> escape_by_translation(const Link& link, const Obstacle& obstacle) {
  const LinkGap gap = gap_to_link(obstacle, link.a_W, link.b_W);
  if (gap.distance >= 0) return motion_of(link, Vec3::Zero(), Vec3::Zero());
  if (link.inverse_mass_a == 0 || link.inverse_mass_b == 0) return std::nullopt;
  const Vec3 out = -gap.distance * gap.normal_W;
  return motion_of(link, out, out);
}

std::optional<LinkMotion> escape_by_rotation(const Link& link, const Obstacle& obstacle) {
  const LinkGap gap = gap_to_link(obstacle, link.a_W, link.b_W);
  if (gap.distance >= 0) return motion_of(link, Vec3::Zero(), Vec3::Zero());
  const bool about_a = gap.s >= 0.5;  // the farther end
  const Vec3 pivot = about_a ? link.a_W : link.b_W,
             arm = about_a ? Vec3(link.b_W - link.a_W) : Vec3(link.a_W - link.b_W);
  if ((about_a ? link.inverse_mass_b : link.inverse_mass_a) == 0) return std::nullopt;
  if (gap_to_point(obstacle, pivot).distance < 0) return std::nullopt;
  Vec3 axis = arm.cross(gap.normal_W);
  axis = axis.norm() <= 1e-12 * arm.norm() ? Vec3(arm.unitOrthogonal()) : Vec3(axis.normalized());
  const auto turned = [&](double angle) { return Vec3(rotation_by(angle * axis) * arm); };
  const auto clear = [&](double angle) { return gap_to_link(obstacle, pivot, pivot + turned(angle)).distance >= 0; };
  double blocked = 0, free = 0;
  constexpr int kLooks = 64;  // within half a turn
  for (int k = 1; k <= kLooks && free == 0; ++k) {
    const double angle = k * std::numbers::pi / kLooks;
    (clear(angle) ? free : blocked) = angle;
  }
  if (free == 0) return std::nullopt;
  for (double middle = 0.5 * (blocked + free); blocked < middle && middle < free; middle = 0.5 * (blocked + free))
    (clear(middle) ? free : blocked) = middle;
  const Vec3 d = turned(free) - arm;
  return about_a ? motion_of(link, Vec3::Zero(), d) : motion_of(link, d, Vec3::Zero());
}

std::optional<LinkMotion> escape_by_both(const Link& link, const Obstacle& obstacle) {
  const LinkGap gap = gap_to_link(obstacle, link.a_W, link.b_W);
  if (gap.distance >= 0) return motion_of(link, Vec3::Zero(), Vec3::Zero());
  if (std::holds_alternative<Sphere>(obstacle.shape)) return both_out_of_sphere(link, obstacle);
  const Vec3 deepest = (1 - gap.s) * link.a_W + gap.s * link.b_W;
  return both_out_of_half_space(link, obstacle, gap.normal_W, gap.normal_W.dot(deepest) - gap.distance);
}

std::optional<LinkMotion> least_escape(const Link& link, const Obstacle& obstacle) {
  return cheaper(escape_by_both(link, obstacle),
                 cheaper(escape_by_translation(link, obstacle), escape_by_rotation(link, obstacle)));
}

}  // namespace plumbline
