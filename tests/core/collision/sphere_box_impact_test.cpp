#include "plumbline/core/collision/sphere_box_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plumbline/core/collision/convex_polyhedron.hpp"
#include "plumbline/core/collision/nearest_points.hpp"
#include "random_scenes.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
#if defined(__SANITIZE_ADDRESS__)
constexpr int kTrials = 1000;
#else
constexpr int kTrials = 10000;
#endif

struct Scene {
  Motion sphere, box;
  double radius;
  Vec3 size;
};

// The gap from the features of the box one by one: the feet on its faces and the nearest points of its edges. Inside,
// minus the depth below the nearest face.
double gap(const Scene& s, const ConvexPolyhedron& box, double t) {
  const auto at = [&](const Motion& m) { return Vec3(m.start.p_WB + t * m.start.v_WB + 0.5 * t * t * m.a_W); };
  const Quat q = rotation_by(t * s.box.start.w_WB) * s.box.start.q_WB;
  const Vec3 x = q.conjugate() * (at(s.sphere) - at(s.box));
  double outside = std::numeric_limits<double>::infinity(), height = -outside;
  for (const auto& face : box.faces()) height = std::max(height, face.normal_B.dot(x) - face.offset);
  if (height <= 0) return height - s.radius;
  for (const auto& face : box.faces()) {
    const Vec3 foot = x - (face.normal_B.dot(x) - face.offset) * face.normal_B;
    if (((foot.cwiseAbs() - 0.5 * s.size).array() <= 8 * kEps).all()) outside = std::min(outside, (x - foot).norm());
  }
  for (const auto& edge : box.edges()) {
    const Segment segment{box.vertices_B()[edge.tail], box.vertices_B()[edge.head]};
    outside = std::min(outside, (x - nearest_on_segment(x, segment)).norm());
  }
  return outside - s.radius;
}

// The first time at which the gap closes: intervals in which it cannot do so at that speed are left out, the others
// halved; at last halving by sign.
std::optional<double> first_closing(const Scene& s, const ConvexPolyhedron& box, double speed, double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  if (gap(s, box, middle) > half * speed) return std::nullopt;
  if (half < 1e-9) {
    if (gap(s, box, to) > 0) return std::nullopt;
    double low = from, high = to;
    for (int k = 0; k < 60; ++k) {
      const double m = 0.5 * (low + high);
      (gap(s, box, m) > 0 ? low : high) = m;
    }
    return low;
  }
  const auto early = first_closing(s, box, speed, from, middle);
  return early ? early : first_closing(s, box, speed, middle, to);
}

Scene random_scene(SceneRandom& random) {
  Scene s;
  s.radius = random.in(0.05, 0.8);
  s.size = Vec3::Constant(1) + random.vector(0.9);
  s.box.start.p_WB = random.vector(2);
  s.box.start.q_WB = random.attitude();
  s.box.start.v_WB = random.vector(0.5);
  s.sphere.start.p_WB = s.box.start.p_WB + random.in(2, 4) * random.direction();
  s.sphere.start.v_WB = random.in(0.3, 1) * (s.box.start.p_WB - s.sphere.start.p_WB) + random.vector(0.9);
  s.sphere.start.w_WB = random.vector(10);  // plays no part
  return s;
}

// Which feature of the box is hit: how many coordinates of the point are on faces.
int faces_at(const Scene& s, const Touch& touch) {
  const Vec3 centre = s.box.start.p_WB + touch.time * s.box.start.v_WB + 0.5 * touch.time * touch.time * s.box.a_W;
  const Quat q = rotation_by(touch.time * s.box.start.w_WB) * s.box.start.q_WB;
  const Vec3 x = q.conjugate() * (touch.point_W - centre);
  int faces = 0;
  for (int k = 0; k < 3; ++k) faces += std::abs(std::abs(x(k)) - 0.5 * s.size(k)) < 1e-9 ? 1 : 0;
  return faces;
}

struct Tally {
  int hits = 0, misses = 0, on[4] = {0, 0, 0, 0};
  double worst = 0;
};

// `stop`: how far above the surface the search may stop [m].
void compare(const Scene& s, int trial, double horizon, double speed, double stop, Tally& tally) {
  const ConvexPolyhedron box = box_polyhedron(s.size);
  const auto expected = first_closing(s, box, speed, 0, horizon);
  const auto found = sphere_meets_box(s.sphere, s.radius, s.box, s.size, horizon);
  if (gap(s, box, 0) <= 0) return;
  ASSERT_EQ(found.has_value(), expected.has_value()) << trial;
  if (!found) {
    ++tally.misses;
    return;
  }
  ++tally.hits;
  ++tally.on[faces_at(s, *found)];
  const double rounding = 64 * kEps * 10, step = 1e-6;
  const double approach = (gap(s, box, *expected - step) - gap(s, box, *expected)) / step;
  const double error = std::abs(found->time - *expected);
  EXPECT_LE(error, 2 * (stop + rounding) / approach) << trial << ", approach " << approach;
  if (approach > 0.1) tally.worst = std::max(tally.worst, error);
  EXPECT_NEAR(found->normal_W.norm(), 1, 16 * kEps);  // turned by a product of unit quaternions
  const Vec3 centre =
      s.sphere.start.p_WB + found->time * s.sphere.start.v_WB + 0.5 * found->time * found->time * s.sphere.a_W;
  EXPECT_LE((centre - s.radius * found->normal_W - found->point_W).norm(), stop + rounding) << trial;
}

TEST(SphereBoxImpact, InStraightMotionIsExact) {
  SceneRandom random(16);
  Tally tally;
  for (int k = 0; k < kTrials; ++k) {
    Scene s = random_scene(random);
    compare(s, k, 3, (s.sphere.start.v_WB - s.box.start.v_WB).norm(), 0, tally);
  }
  EXPECT_GT(tally.misses, kTrials / 20);
  for (const int feature : {1, 2, 3}) EXPECT_GT(tally.on[feature], kTrials / 30);  // face, edge, corner
  EXPECT_LT(tally.worst, 1e-12);
  RecordProperty("worst_error_fs", std::to_string(tally.worst * 1e15));
}

TEST(SphereBoxImpact, WithATurningAndFallingBoxIsTheFirstTouch) {
  SceneRandom random(17);
  Tally tally;
  for (int k = 0; k < kTrials / 2; ++k) {
    Scene s = random_scene(random);
    s.box.start.w_WB = random.vector(4);
    if (k % 2 == 0) s.sphere.a_W = random.vector(2);
    const double horizon = 2;
    const double glide = (s.sphere.start.v_WB - s.box.start.v_WB).norm() + horizon * s.sphere.a_W.norm();
    // The point as the box sees it: its own velocity and that of the turning axes.
    const double speed = glide + s.box.start.w_WB.norm() * (4 + glide * horizon);
    compare(s, k, horizon, speed, kImpactTolerance * (s.size.norm() + 2 * s.radius), tally);
  }
  EXPECT_GT(tally.misses, kTrials / 40);
  for (const int feature : {1, 2, 3}) EXPECT_GT(tally.on[feature], kTrials / 60);
  EXPECT_LT(tally.worst, 1e-10);
  RecordProperty("worst_error_fs", std::to_string(tally.worst * 1e15));
}

TEST(SphereBoxImpact, KnowsFaceEdgeAndCorner) {
  Motion sphere, box;
  const Vec3 size(2, 4, 6);
  sphere.start.v_WB = Vec3(0, 0, -2);
  sphere.start.p_WB = Vec3(0.5, 0.5, 14);
  const auto face = sphere_meets_box(sphere, 1, box, size, 100);
  ASSERT_TRUE(face.has_value());
  EXPECT_DOUBLE_EQ(face->time, 5);  // 14 - 2 t = 3 + 1
  EXPECT_EQ(face->normal_W, Vec3(0, 0, 1));
  EXPECT_LE((face->point_W - Vec3(0.5, 0.5, 3)).norm(), 8 * kEps);

  sphere.start.p_WB = Vec3(1.6, 0, 14);  // 0.6 beside the edge at x = 1: sinks to 0.8 above it
  const auto edge = sphere_meets_box(sphere, 1, box, size, 100);
  ASSERT_TRUE(edge.has_value());
  EXPECT_NEAR(edge->time, 0.5 * (14 - 3.8), 16 * kEps);
  EXPECT_LE((edge->normal_W - Vec3(0.6, 0, 0.8)).norm(), 16 * kEps);

  sphere.start.p_WB = Vec3(1 + 2.0 / 7, 2 + 3.0 / 7, 14);  // 2, 3, 6 and 7 make a box with a whole diagonal
  const auto corner = sphere_meets_box(sphere, 1, box, size, 100);
  ASSERT_TRUE(corner.has_value());
  EXPECT_NEAR(corner->time, 0.5 * (11 - 6.0 / 7), 16 * kEps);
  EXPECT_LE((corner->normal_W - Vec3(2, 3, 6) / 7).norm(), 16 * kEps);
  EXPECT_LE((corner->point_W - Vec3(1, 2, 3)).norm(), 16 * kEps);

  sphere.start.p_WB = Vec3(1 + 0.8, 2 + 0.8, 14);  // 1.13 from the corner's vertical: passes
  EXPECT_EQ(sphere_meets_box(sphere, 1, box, size, 100), std::nullopt);
}

// A wing of half length L turning at w meets a resting ball at the angle at which its face comes to it.
TEST(SphereBoxImpact, OfATurningWingIsThatOfItsFace) {
  Motion sphere, box;
  const double turn = 2, radius = 0.1, thickness = 0.2, arm = 3;
  box.start.w_WB = Vec3(0, 0, turn);
  sphere.start.p_WB = Vec3(0, arm, 0);
  // The upper face, at half the thickness above the wing's axis, has the distance arm cos(w t) from the ball's centre
  // less that half: it is hit when arm cos(w t) = thickness/2 + radius.
  const auto touch = sphere_meets_box(sphere, radius, box, Vec3(10, thickness, 1), 1);
  ASSERT_TRUE(touch.has_value());
  const double exact = std::acos((0.5 * thickness + radius) / arm) / turn;
  EXPECT_NEAR(touch->time, exact, 2 * kImpactTolerance * 11 / (turn * arm));
  EXPECT_LE((touch->normal_W - Vec3(-std::sin(turn * exact), std::cos(turn * exact), 0)).norm(), 1e-12);
}

TEST(SphereBoxImpact, IsZeroForTouchingBodiesThatApproachAndNothingForThoseThatPart) {
  for (const double turn : {0.0, 1.0}) {  // in closed form, and by advancing
    for (const double height : {1.5, 1.2}) {
      for (const double v : {-1.0, 1.0}) {
        Motion sphere, box;
        box.start.w_WB = Vec3(0, 0, turn);
        sphere.start.p_WB = Vec3(0, 0, height);
        sphere.start.v_WB = Vec3(0, 0, v);
        const auto touch = sphere_meets_box(sphere, 0.5, box, Vec3(2, 2, 2), 1);
        ASSERT_EQ(touch.has_value(), v < 0) << turn << " " << height;
        if (touch) {
          EXPECT_EQ(touch->time, 0);
          EXPECT_EQ(touch->normal_W, Vec3(0, 0, 1));
        }
      }
    }
  }
}

TEST(SphereBoxImpact, OfAPointIsWithTheBoxItself) {
  Motion point, box;
  point.start.p_WB = Vec3(0.3, 0.2, 5);
  point.start.v_WB = Vec3(0, 0, -1);
  const auto touch = sphere_meets_box(point, 0, box, Vec3(1, 1, 1), 100);
  ASSERT_TRUE(touch.has_value());
  EXPECT_DOUBLE_EQ(touch->time, 4.5);
  EXPECT_EQ(touch->normal_W, Vec3(0, 0, 1));
}

TEST(SphereBoxImpact, IsNothingForNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int place = 0; place < 4; ++place) {
    Motion sphere, box;
    sphere.start.p_WB = Vec3(0, 0, 3);
    sphere.start.v_WB = Vec3(0, 0, -1);
    (place == 0   ? sphere.start.p_WB
     : place == 1 ? sphere.start.v_WB
     : place == 2 ? box.start.w_WB
                  : sphere.a_W)
        .z() = nan;
    EXPECT_EQ(sphere_meets_box(sphere, 1, box, Vec3(1, 1, 1), 10), std::nullopt) << place;
  }
}

}  // namespace
}  // namespace plumbline
