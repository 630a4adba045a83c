#include "plumbline/core/collision/convex_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "piercing_oracle.hpp"
#include "random_scenes.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
#if defined(__SANITIZE_ADDRESS__)
constexpr int kTrials = 300;
#else
constexpr int kTrials = 3000;
#endif

// The gap that a plane across `normal` sees, from all corners.
double gap_along(const Vec3& normal, const ConvexPolyhedron& a, const BodyState& at_a, const ConvexPolyhedron& b,
                 const BodyState& at_b) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : a.vertices_B()) low = std::min(low, normal.dot(at_a.p_WB + at_a.q_WB * p));
  for (const Vec3& p : b.vertices_B()) high = std::max(high, normal.dot(at_b.p_WB + at_b.q_WB * p));
  return low - high;
}

struct Placed {
  ConvexPolyhedron a, b;
  BodyState at_a, at_b;
};

Placed random_pair(SceneRandom& random, double distance) {
  Placed pair{random.solid(), random.solid(), {}, {}};
  pair.at_a.q_WB = random.attitude();
  pair.at_b.q_WB = random.attitude();
  pair.at_a.p_WB = random.vector(3);
  pair.at_b.p_WB = pair.at_a.p_WB + distance * random.direction();
  return pair;
}

// All that separating axes promise, from all pairs of edges without the shortcut of crossing arcs.
double widest_gap(const Placed& s) {
  std::vector<Vec3> axes;
  for (const auto& face : s.a.faces()) axes.push_back(-(s.at_a.q_WB * face.normal_B));
  for (const auto& face : s.b.faces()) axes.push_back(s.at_b.q_WB * face.normal_B);
  for (const auto& u : s.a.edges()) {
    for (const auto& v : s.b.edges()) {
      const Vec3 n = (s.at_a.q_WB * (s.a.vertices_B()[u.head] - s.a.vertices_B()[u.tail]))
                         .cross(s.at_b.q_WB * (s.b.vertices_B()[v.head] - s.b.vertices_B()[v.tail]));
      if (n.norm() < 1e-3) continue;  // too near to parallel for this plain way
      axes.push_back(n.normalized());
      axes.push_back(-n.normalized());
    }
  }
  double widest = -std::numeric_limits<double>::infinity();
  for (const Vec3& n : axes) widest = std::max(widest, gap_along(n, s.a, s.at_a, s.b, s.at_b));
  return widest;
}

// Where they overlap no axis sees less depth. Where they are apart some product of edges that is no face of A - B may
// see a wider gap (towards two corners, say), but whether there is a gap is the same question.
TEST(ConvexDistance, AxisIsTheBestOfAllPairsOfEdges) {
  SceneRandom random(5);
  int overlaps = 0, edges = 0;
  for (int k = 0; k < kTrials; ++k) {
    const Placed s = random_pair(random, random.in(0, 2.5));
    const SeparatingAxis axis = separating_axis(s.a, s.at_a, s.b, s.at_b);
    const double widest = widest_gap(s), rounding = 64 * kEps * 10;
    EXPECT_LE(axis.gap, widest + rounding) << k;
    EXPECT_GE(axis.gap, widest > 0 ? -rounding : widest - rounding) << k;
    EXPECT_NEAR(axis.gap, gap_along(axis.normal_W, s.a, s.at_a, s.b, s.at_b), rounding) << k;
    overlaps += axis.gap < 0 ? 1 : 0;
    edges += axis.kind == SeparatingAxis::Kind::kEdges ? 1 : 0;
  }
  EXPECT_GT(overlaps, kTrials / 10);
  EXPECT_LT(overlaps, kTrials * 9 / 10);
  EXPECT_GT(edges, kTrials / 10);
}

// Where two edges cross at a flat angle, the place of the crossing is known the less: 1/sin of the angle, for the best
// axis if it is one of edges.
double flattest_crossing(const Placed& s) {
  const SeparatingAxis axis = separating_axis(s.a, s.at_a, s.b, s.at_b);
  if (axis.kind != SeparatingAxis::Kind::kEdges) return 1;
  const auto &u = s.a.edges()[axis.index_a], &v = s.b.edges()[axis.index_b];
  const Vec3 along_u = s.at_a.q_WB * (s.a.vertices_B()[u.head] - s.a.vertices_B()[u.tail]).normalized();
  const Vec3 along_v = s.at_b.q_WB * (s.b.vertices_B()[v.head] - s.b.vertices_B()[v.tail]).normalized();
  return 1 / along_u.cross(along_v).norm();
}

// Two points of the solids that far apart, and a plane between them that sees the same gap: no other pair can be nearer
// and no other plane see more. Nothing else need be known about how the distance was found.
TEST(ConvexDistance, IsProvedByAPlaneThatSeesIt) {
  SceneRandom random(6);
  int apart = 0, near = 0;
  for (int k = 0; k < kTrials; ++k) {
    Placed s = random_pair(random, random.in(0.5, 3));
    if (k % 2 == 0) {  // bring them near: 1e-1 to 1e-12 m
      const Separation first = convex_distance(s.a, s.at_a, s.b, s.at_b);
      s.at_a.p_WB += (std::pow(10, -1 - k / 2 % 12) - first.distance) * first.normal_W;
    }
    const Separation found = convex_distance(s.a, s.at_a, s.b, s.at_b);
    if (found.distance <= 0) continue;
    ++apart;
    near += found.distance < 1e-6 ? 1 : 0;
    // Positions of up to 6 m are rounded. The direction of two corners at the distance d is worth eps * 6 m / d.
    const double rounding = 32 * kEps * 6;
    const double tilt = std::min(1.0, rounding / found.distance);
    // A pair of points a little askew of the normal, by x, is longer by x^2 / (2 d) only: below rounding, it passes for
    // one that is straight.
    const double askew = std::sqrt(2 * found.distance * rounding) + rounding * flattest_crossing(s);
    EXPECT_LE((found.point_a_W - found.point_b_W - found.distance * found.normal_W).norm(), askew) << k;
    EXPECT_NEAR(gap_along(found.normal_W, s.a, s.at_a, s.b, s.at_b), found.distance, rounding + 2 * tilt) << k;
    if (found.distance > 1e-3) {
      EXPECT_NEAR(gap_along(found.normal_W, s.a, s.at_a, s.b, s.at_b), found.distance, 2e3 * rounding) << k;
    }
    EXPECT_LE(separating_axis(s.a, s.at_a, s.b, s.at_b).gap, found.distance + rounding) << k;
    // The two points belong to the solids.
    for (const auto& face : s.a.faces()) {
      const Vec3 p = s.at_a.q_WB.conjugate() * (found.point_a_W - s.at_a.p_WB);
      EXPECT_LE(face.normal_B.dot(p) - face.offset, rounding) << k;
    }
    for (const auto& face : s.b.faces()) {
      const Vec3 p = s.at_b.q_WB.conjugate() * (found.point_b_W - s.at_b.p_WB);
      EXPECT_LE(face.normal_B.dot(p) - face.offset, rounding) << k;
    }
  }
  EXPECT_GT(apart, kTrials / 2);
  EXPECT_GT(near, kTrials / 8);
}

TEST(ConvexDistance, DepthIsTheShortestWayOut) {
  SceneRandom random(7);
  int overlaps = 0;
  for (int k = 0; k < kTrials; ++k) {
    Placed s = random_pair(random, random.in(0, 1));
    const Separation found = convex_distance(s.a, s.at_a, s.b, s.at_b);
    if (found.distance >= 0) continue;
    ++overlaps;
    const double rounding = 64 * kEps * 6;
    EXPECT_LE((found.point_a_W - found.point_b_W - found.distance * found.normal_W).norm(), rounding) << k;
    // Any other direction is a longer way out.
    for (int j = 0; j < 20; ++j) {
      EXPECT_LE(gap_along(random.direction(), s.a, s.at_a, s.b, s.at_b), found.distance + rounding) << k;
    }
    // Pushed out by it they touch, which edges that pierce confirm.
    Motion a{s.at_a, Vec3::Zero()}, b{s.at_b, Vec3::Zero()};
    a.start.p_WB -= found.distance * found.normal_W;
    EXPECT_NEAR(PiercingOracle(s.a, a, s.b, b).height(0), 0, rounding) << k;
  }
  EXPECT_GT(overlaps, kTrials / 4);
}

TEST(ConvexDistance, OfBoxesIsWhatOneReadsOff) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  BodyState a, b;
  a.p_WB = Vec3(0.5, 0, 3);
  const Separation faces = convex_distance(cube, a, cube, b);
  EXPECT_DOUBLE_EQ(faces.distance, 1);
  EXPECT_EQ(faces.normal_W, Vec3(0, 0, 1));
  EXPECT_LE((faces.point_a_W - Vec3(0.25, 0, 2)).norm(), 4 * kEps);  // the middle of the part that they share

  a.p_WB = Vec3(5, 6, 2 + 12);  // corners (1,1,1) and (4,5,13): 3, 4, 12 apart
  const Separation corners = convex_distance(cube, a, cube, b);
  EXPECT_DOUBLE_EQ(corners.distance, 13);
  EXPECT_LE((corners.normal_W - Vec3(3, 4, 12) / 13).norm(), 4 * kEps);
  EXPECT_EQ(corners.point_b_W, Vec3(1, 1, 1));

  a.p_WB = Vec3(5, 6, 0);  // parallel edges, 3 and 4 apart
  EXPECT_DOUBLE_EQ(convex_distance(cube, a, cube, b).distance, 5);

  a.p_WB = Vec3(0, 0, 2 * std::sqrt(2.0) + 0.5);  // two edges on end, across each other
  a.q_WB = rotation_by(Vec3(M_PI / 4, 0, 0));
  b.q_WB = rotation_by(Vec3(0, M_PI / 4, 0));
  const Separation edges = convex_distance(cube, a, cube, b);
  EXPECT_NEAR(edges.distance, 0.5, 16 * kEps);
  EXPECT_LE((edges.point_b_W - Vec3(0, 0, std::sqrt(2.0))).norm(), 8 * kEps);

  a.p_WB = Vec3(0.1, 0.2, 1.5);  // overlap, least along z
  a.q_WB = b.q_WB = rotation_by(Vec3::Zero());
  EXPECT_NEAR(convex_distance(cube, a, cube, b).distance, -0.5, 4 * kEps);
  EXPECT_EQ(convex_distance(cube, a, cube, b).normal_W, Vec3(0, 0, 1));
}

TEST(ConvexDistance, IsNanForNan) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  BodyState a, b;
  a.p_WB.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(convex_distance(cube, a, cube, b).distance));
  EXPECT_TRUE(std::isnan(convex_distance(cube, b, cube, a).distance));
  EXPECT_TRUE(std::isnan(separating_axis(cube, a, cube, b).gap));
}

}  // namespace
}  // namespace plumbline
