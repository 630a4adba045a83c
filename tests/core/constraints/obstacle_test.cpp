#include "plumbline/core/constraints/obstacle.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "particle_scenes.hpp"
#include "plumbline/core/constraints/link_escape.hpp"

namespace plumbline {
namespace {

using namespace particles;

Obstacle turned_box() { return {Box{Vec3(1, 1.5, 0.8)}, Vec3(0.2, 0.1, -0.3), rotation_by(Vec3(0.3, 0.5, -0.2))}; }
Obstacle ball() { return {Sphere{0.7}, Vec3(0.1, -0.2, 0.3), Quat::Identity()}; }
Obstacle slope() { return {HalfSpace{Vec3(1, 2, 2) / 3}, Vec3(0.1, 0, 0.2), Quat::Identity()}; }

// How far the box or ball reaches along n from its centre.
double reach(const Obstacle& o, const Vec3& n) {
  if (const auto* sphere = std::get_if<Sphere>(&o.shape)) return sphere->radius;
  return 0.5 * std::get<Box>(o.shape).size.dot((o.q_WO.conjugate() * n).cwiseAbs());
}

TEST(ObstacleGap, OfAPointIsTheLargestGapOverAllDirections) {
  // For convex solids the signed distance is the maximum over unit n of n.(p - c) - reach(n), inside and outside, and
  // it is taken on at the normal: checked from below by random directions and from above at the normal itself.
  Random random(11);
  for (const Obstacle& o : {turned_box(), ball()}) {
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 p = o.p_WO + random.vector(1.2);
      const PointGap gap = gap_to_point(o, p);
      EXPECT_NEAR(gap.normal_W.norm(), 1, 4 * kEps);
      EXPECT_NEAR(gap.normal_W.dot(p - o.p_WO) - reach(o, gap.normal_W), gap.distance, 20 * kEps);
      for (int other = 0; other < 50; ++other) {
        const Vec3 n = (gap.normal_W + random.in(0, 2) * random.direction()).normalized();
        EXPECT_LE(n.dot(p - o.p_WO) - reach(o, n), gap.distance + 20 * kEps);
      }
    }
  }
}

TEST(ObstacleGap, OfALinkInsideIsItsDepth) {
  // As above, with the lower end of the link along n. Outside a box the gap is only a lower bound.
  Random random(12);
  int inside = 0;
  for (const Obstacle& o : {turned_box(), ball()}) {
    for (int trial = 0; trial < 600; ++trial) {
      const Vec3 a = o.p_WO + random.vector(1.2), b = o.p_WO + random.vector(1.2);
      const LinkGap gap = gap_to_link(o, a, b);
      const auto along = [&](const Vec3& n) { return std::min(n.dot(a - o.p_WO), n.dot(b - o.p_WO)) - reach(o, n); };
      // Near the centre of a ball, at r, the direction of the normal is only known to eps/r.
      const double r = ((1 - gap.s) * a + gap.s * b - o.p_WO).norm();
      EXPECT_NEAR(along(gap.normal_W), gap.distance, 20 * kEps * (1 + 0.2 / r));
      if (gap.distance >= 0) continue;
      ++inside;
      for (int other = 0; other < 50; ++other) {
        const Vec3 n = (gap.normal_W + random.in(0, 2) * random.direction()).normalized();
        EXPECT_LE(along(n), gap.distance + 20 * kEps);
      }
    }
  }
  EXPECT_GT(inside, 200);
}

TEST(ObstacleGap, OfALinkSaysWhetherItTouches) {
  // Against the nearest of many points of the link: it can only be farther than the link itself, by at most the
  // spacing.
  Random random(13);
  for (const Obstacle& o : {turned_box(), ball(), slope()}) {
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 a = o.p_WO + random.vector(1.5), b = o.p_WO + random.vector(1.5);
      double nearest = 1e9;
      constexpr int kPoints = 400;
      for (int k = 0; k <= kPoints; ++k) {
        const double s = static_cast<double>(k) / kPoints;
        nearest = std::min(nearest, gap_to_point(o, (1 - s) * a + s * b).distance);
      }
      const double spacing = (b - a).norm() / kPoints;
      const double distance = gap_to_link(o, a, b).distance;
      EXPECT_FALSE(nearest < 0 && distance >= 0);
      EXPECT_FALSE(nearest > spacing && distance <= 0);
      EXPECT_LE(distance, nearest + 20 * kEps);
    }
  }
}

// Random links of length 1 that are in the obstacle.
template <class Check>
void for_links_inside(const Obstacle& o, unsigned long long seed, const Check& check) {
  Random random(seed);
  int count = 0;
  while (count < 200) {
    Link link;
    link.a_W = o.p_WO + random.vector(1);
    link.b_W = link.a_W + random.direction();
    link.inverse_mass_a = random.in(0.3, 3);
    link.inverse_mass_b = random.in(0.3, 3);
    if (gap_to_link(o, link.a_W, link.b_W).distance > -0.01) continue;
    ++count;
    check(link, random);
  }
}

// The link afterwards: clear of the obstacle and as long as before. Positions are below 3 and the escapes are found to
// 1e-14 of the scene's size of some 5.
void expect_clear(const Link& link, const Obstacle& o, const LinkMotion& motion) {
  const Vec3 a = link.a_W + motion.d_a_W, b = link.b_W + motion.d_b_W;
  EXPECT_GE(gap_to_link(o, a, b).distance, -5e-14);
  EXPECT_NEAR((b - a).norm(), (link.b_W - link.a_W).norm(), 5e-14);
}

TEST(LinkEscape, ClearsTheLinkAndKeepsItsLength) {
  int rotated = 0, combined = 0, all = 0;
  for (const Obstacle& o : {turned_box(), ball(), slope()}) {
    for_links_inside(o, 14, [&](const Link& link, Random&) {
      const auto by_translation = escape_by_translation(link, o), by_rotation = escape_by_rotation(link, o),
                 by_both = escape_by_both(link, o), least = least_escape(link, o);
      ++all;
      ASSERT_TRUE(by_translation && least);
      for (const auto& motion : {by_translation, by_rotation, by_both, least}) {
        if (!motion) continue;
        expect_clear(link, o, *motion);
        EXPECT_LE(least->cost, motion->cost);
      }
      rotated += by_rotation.has_value();
      combined += by_both.has_value();
    });
  }
  EXPECT_EQ(all, 600);
  EXPECT_GT(rotated, 200);  // the others have their pivot inside as well
  EXPECT_GT(combined, 590);
}

TEST(LinkEscape, CombinedIsNeverBeatenByOtherRigidMotionsOutOfABallOrSlope) {
  for (const Obstacle& o : {ball(), slope()}) {
    for_links_inside(o, 15, [&](const Link& link, Random& random) {
      const auto least = least_escape(link, o);
      ASSERT_TRUE(least);
      // Rigid motions near the one found; those that clear the link may not cost less.
      const Vec3 a = link.a_W + least->d_a_W, b = link.b_W + least->d_b_W, middle = 0.5 * (a + b);
      for (int other = 0; other < 50; ++other) {
        const double size = random.in(0, 0.1);
        const Quat q = rotation_by(random.vector(size));
        const Vec3 t = random.vector(size);
        const Vec3 a2 = middle + t + q * (a - middle), b2 = middle + t + q * (b - middle);
        if (gap_to_link(o, a2, b2).distance < 0) continue;
        const double cost2 =
            (a2 - link.a_W).squaredNorm() / link.inverse_mass_a + (b2 - link.b_W).squaredNorm() / link.inverse_mass_b;
        EXPECT_GE(cost2, least->cost * (1 - 1e-12));
      }
    });
  }
}

TEST(LinkEscape, RotatesByTheAngleThatGeometryGives) {
  // Out of a half-space: about the end at height h to the elevation -asin(h/L).
  Link link{Vec3(0, 0, 0.3), Vec3(std::sqrt(0.75), 0, -0.2)};
  const Obstacle ground{HalfSpace{Vec3::UnitZ()}};
  auto motion = escape_by_rotation(link, ground);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->d_a_W, Vec3(Vec3::Zero()));
  EXPECT_LE((link.b_W + motion->d_b_W - Vec3(std::sqrt(1 - 0.09), 0, 0)).norm(), 10 * kEps);
  // Out of a ball beside it, until it is tangent: sin(angle between link and centre) = R/D.
  link = {Vec3(0, 0, 0), Vec3(2, 0, 0)};
  const Obstacle ball{Sphere{0.4}, Vec3(1, 0.1, 0), Quat::Identity()};
  motion = escape_by_rotation(link, ball);
  ASSERT_TRUE(motion);
  // s = 0.5: the farther end is a tie, a stays.
  const double distance = std::hypot(1, 0.1), angle = std::asin(0.4 / distance) - std::atan2(0.1, 1);
  EXPECT_LE((link.b_W + motion->d_b_W - 2 * Vec3(std::cos(angle), -std::sin(angle), 0)).norm(), 20 * kEps);
}

TEST(LinkEscape, PrefersRotationWhereOneEndIsIn) {
  // One of two equal ends 0.2 deep: translation costs 2 * 0.2^2, and turning about the other end only half of that.
  const Link link{Vec3(0, 0, 5), Vec3(0, 3, -0.2)};
  const Obstacle ground{HalfSpace{Vec3::UnitZ()}};
  const double translation = escape_by_translation(link, ground)->cost;
  EXPECT_NEAR(translation, 0.08, 1e-15);
  EXPECT_LT(least_escape(link, ground)->cost, translation);
}

TEST(LinkEscape, RespectsHeldEnds) {
  Link link{Vec3(0, 0, 0.5), Vec3(0, 1, -0.2), 0, 1};
  const Obstacle ground{HalfSpace{Vec3::UnitZ()}};
  EXPECT_FALSE(escape_by_translation(link, ground));
  const auto least = least_escape(link, ground);
  ASSERT_TRUE(least);
  EXPECT_EQ(least->d_a_W, Vec3(Vec3::Zero()));
  expect_clear(link, ground, *least);
  link.inverse_mass_b = 0;
  EXPECT_FALSE(least_escape(link, ground));
}

}  // namespace
}  // namespace plumbline
