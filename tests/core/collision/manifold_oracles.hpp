// Distances of convex bodies found feature by feature, and random bodies that nearly touch: what manifolds are tested
// on.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "plumbline/core/collision/contact_manifold.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline::oracles {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();
inline const double kPi = std::acos(-1.0);

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Quat attitude() {
    for (;;) {
      const Eigen::Vector4d x(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1));
      if (x.norm() > 0.1 && x.norm() <= 1) return Quat(x(0), x(1), x(2), x(3)).normalized();
    }
  }

 private:
  std::mt19937_64 bits_;
};

struct PlacedBox {
  Vec3 size;
  BodyState state;
};

inline double distance_to_box(const Vec3& x_W, const PlacedBox& b) {
  const Vec3 x = (b.state.q_WB.conjugate() * (x_W - b.state.p_WB)).cwiseAbs() - 0.5 * b.size;
  return x.cwiseMax(0.0).norm();
}

// Nearest points of two segments p + s u, q + t v with s, t in [0, 1], by minimising along one, then the other: each
// quadratic is solved with the other's end points too, so that no case is told apart.
inline double segment_distance(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const auto to_segment = [](const Vec3& x, const Vec3& at, const Vec3& d) {
    return (x - at - std::clamp(d.dot(x - at) / d.squaredNorm(), 0.0, 1.0) * d).norm();
  };
  double best = std::min({to_segment(p, q, v), to_segment(p + u, q, v), to_segment(q, p, u), to_segment(q + v, p, u)});
  const Vec3 n = u.cross(v);
  if (n.squaredNorm() > 0) {  // both interior: the lines' common perpendicular
    const double s = (q - p).cross(v).dot(n) / n.squaredNorm(), t = (q - p).cross(u).dot(n) / n.squaredNorm();
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, (p + s * u - q - t * v).norm());
  }
  return best;
}

// Distance of two boxes that do not overlap, feature by feature: corners to boxes and edges to edges.
inline double distance(const PlacedBox& a, const PlacedBox& b) {
  const auto corner = [](const PlacedBox& x, int k) -> Vec3 {
    return x.state.p_WB + x.state.q_WB * box_corner(x.size, k);
  };
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 8; ++k) {
    best = std::min({best, distance_to_box(corner(a, k), b), distance_to_box(corner(b, k), a)});
    for (int axis = 0; axis < 3; ++axis) {
      if ((k >> axis & 1) != 0) continue;
      const Vec3 p = corner(a, k), u = corner(a, k | 1 << axis) - p;
      for (int j = 0; j < 8; ++j) {
        for (int other = 0; other < 3; ++other) {
          if ((j >> other & 1) != 0) continue;
          const Vec3 q = corner(b, j);
          best = std::min(best, segment_distance(p, u, q, corner(b, j | 1 << other) - q));
        }
      }
    }
  }
  return best;
}

// The textbook's separation of two oriented boxes (Gottschalk et al. 1996): |T . L| less the two radii along L.
inline double separation(const PlacedBox& a, const PlacedBox& b) {
  const Mat3 ra = a.state.q_WB.toRotationMatrix(), rb = b.state.q_WB.toRotationMatrix();
  const Vec3 t = b.state.p_WB - a.state.p_WB;
  double best = -std::numeric_limits<double>::infinity();
  const auto along = [&](const Vec3& axis) {
    const Vec3 l = axis.normalized();
    const double reach =
        0.5 * (a.size.dot((ra.transpose() * l).cwiseAbs()) + b.size.dot((rb.transpose() * l).cwiseAbs()));
    best = std::max(best, std::abs(t.dot(l)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    along(ra.col(i));
    along(rb.col(i));
    for (int j = 0; j < 3; ++j) along(ra.col(i).cross(rb.col(j)));
  }
  return best;
}

inline std::vector<Contact> contacts_of(const PlacedBox& a, const PlacedBox& b) {
  return box_box_contacts(a.state, a.size, b.state, b.size);
}

inline double nearest_gap(const std::vector<Contact>& contacts) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Contact& c : contacts) gap = std::min(gap, c.gap);
  return gap;
}

// Two boxes of random size and attitude, brought to that distance along the line of their centres by bisection.
inline std::pair<PlacedBox, PlacedBox> near_touch(Random& random, double gap) {
  PlacedBox a{Vec3(random.in(0.2, 2), random.in(0.2, 2), random.in(0.2, 2)), {random.vector(1), random.attitude()}};
  PlacedBox b{Vec3(random.in(0.2, 2), random.in(0.2, 2), random.in(0.2, 2)), {Vec3::Zero(), random.attitude()}};
  const Vec3 line = random.attitude() * Vec3::UnitX();
  double near = 0, far = 4;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (near + far);
    b.state.p_WB = a.state.p_WB + middle * line;
    const double axes = separation(a, b);  // never more than the distance
    const bool apart = axes > gap || (axes > 0 && distance(a, b) > gap);
    (apart ? far : near) = middle;
  }
  b.state.p_WB = a.state.p_WB + far * line;
  return {a, b};
}

inline PlacedBox flat(const Vec3& size, const Vec3& p_WB, double turn = 0) {
  return {size, {p_WB, rotation_by(Vec3(0, 0, turn))}};
}

inline void expect_points(const std::vector<Contact>& contacts, std::vector<Vec3> expected, const Vec3& normal,
                          double gap, double left = 1e-15) {
  EXPECT_EQ(contacts.size(), expected.size());
  for (const Contact& c : contacts) {
    EXPECT_LT((c.normal_W - normal).norm(), left);
    EXPECT_NEAR(c.gap, gap, left);
    const auto at = std::find_if(expected.begin(), expected.end(),
                                 [&](const Vec3& x) { return (c.point_W - x).norm() < 8 * left; });
    ASSERT_NE(at, expected.end()) << c.point_W.transpose();
    expected.erase(at);
  }
}

}  // namespace plumbline::oracles
