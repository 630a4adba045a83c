#include "plumbline/core/collision/polyhedron_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "piercing_oracle.hpp"
#include "plumbline/core/collision/convex_distance.hpp"
#include "random_scenes.hpp"

namespace plumbline {
namespace {

// Under the sanitizers each operation costs some ten times more: a tenth of the scenes then.
#if defined(__SANITIZE_ADDRESS__)
constexpr int kScenes = 1000;
#else
constexpr int kScenes = 10000;
#endif

constexpr double kHorizon = 2;                      // [s]
constexpr double kResolution = kHorizon * 0x1p-36;  // of the oracle [s]: 3e-11

struct Scene {
  ConvexPolyhedron a, b;
  Motion motion_a, motion_b;
};

// Two solids a few metres from each other, aimed so that more than half of them meet within the horizon.
Scene random_scene(SceneRandom& random, bool turning) {
  Scene s{random.solid(), random.solid(), {}, {}};
  s.motion_a.start.p_WB = random.vector(2);
  s.motion_b.start.p_WB = s.motion_a.start.p_WB + random.in(2, 4) * random.direction();
  const Vec3 d = s.motion_b.start.p_WB - s.motion_a.start.p_WB;
  s.motion_a.start.v_WB = random.in(0.3, 1) * d + random.vector(0.6);
  s.motion_b.start.v_WB = random.in(-0.2, 0.1) * d + random.vector(0.3);
  s.motion_a.start.q_WB = random.attitude();
  s.motion_b.start.q_WB = random.attitude();
  if (turning) {
    s.motion_a.start.w_WB = random.in(0, 5) * random.direction();
    s.motion_b.start.w_WB = random.in(0, 5) * random.direction();
  }
  return s;
}

BodyState state_at(const Motion& m, double t) {
  BodyState s = m.start;
  s.p_WB += t * m.start.v_WB + 0.5 * t * t * m.a_W;
  s.v_WB += t * m.a_W;
  s.q_WB = rotation_by(t * m.start.w_WB) * m.start.q_WB;
  return s;
}

// Moves A sideways so that the smallest gap on the way becomes about `gap` (negative: they overlap by so much).
void make_graze(Scene& s, double gap) {
  for (int round = 0; round < 3; ++round) {
    SeparatingAxis nearest;
    nearest.gap = std::numeric_limits<double>::infinity();
    double best = 0, width = kHorizon;
    for (int level = 0; level < 6; ++level) {
      const double from = best - width / 2, step = width / 16;
      const double start = level == 0 ? 0 : from;
      for (int k = 0; k <= 16; ++k) {
        const double t = std::clamp(start + k * step, 0.0, kHorizon);
        const SeparatingAxis axis = separating_axis(s.a, state_at(s.motion_a, t), s.b, state_at(s.motion_b, t));
        if (axis.gap < nearest.gap) nearest = axis, best = t;
      }
      width /= 8;
    }
    s.motion_a.start.p_WB += (gap - nearest.gap) * nearest.normal_W;
  }
}

// What the core and the oracle may differ by: the core stops up to kImpactTolerance of the size before the touch, and
// both round positions of a few metres; a length becomes a time by the speed at which the gap of the one and the height
// of the other shrink. The factor 2: these speeds grow into a grazing touch, so that just before they were smaller.
double allowed(const Scene& s, double approach, double height_rate) {
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * 10;
  return 2 * ((kImpactTolerance * (s.a.radius() + s.b.radius()) + rounding) / approach + rounding / height_rate);
}

// Translating (a third) and turning pairs; a fifth of them is shifted so that they graze: pass each other at, or dip
// into each other by, 1e-2 to 1e-5 m.
TEST(PolyhedronImpact, AgreesWithPiercingOnRandomPairs) {
  SceneRandom random(8);
  int hits = 0, misses = 0, grazing_hits = 0, grazing_misses = 0, by_edges = 0;
  double worst = 0, worst_of_fast = 0;
  for (int k = 0; k < kScenes; ++k) {
    Scene s = random_scene(random, k % 3 != 0);
    const bool grazing = k % 5 == 0;
    if (grazing) make_graze(s, (k % 2 == 0 ? 1 : -1) * std::pow(10, -2 - k / 10 % 4));
    PiercingOracle oracle(s.a, s.motion_a, s.b, s.motion_b);
    if (oracle.height(0) <= 0) continue;
    const auto expected = oracle.first_touch(0, kHorizon, kResolution);
    const auto found = polyhedron_meets_polyhedron(s.a, s.motion_a, s.b, s.motion_b, kHorizon);
    ASSERT_EQ(found.has_value(), expected.has_value()) << "scene " << k;
    (found ? hits : misses) += 1;
    if (grazing) (found ? grazing_hits : grazing_misses) += 1;
    if (!found) continue;

    const BodyState a = state_at(s.motion_a, found->time), b = state_at(s.motion_b, found->time);
    by_edges += separating_axis(s.a, a, s.b, b).kind == SeparatingAxis::Kind::kEdges ? 1 : 0;
    const Vec3 v_a = a.v_WB + a.w_WB.cross(found->point_W - a.p_WB);
    const Vec3 v_b = b.v_WB + b.w_WB.cross(found->point_W - b.p_WB);
    const double approach = -found->normal_W.dot(v_a - v_b);  // right only if point and normal are
    ASSERT_GT(approach, 0) << "scene " << k;
    const double error = std::abs(found->time - *expected), before = 1e-6;
    const double height_rate = (oracle.height(found->time - before) - oracle.height(found->time)) / before;
    EXPECT_LE(error, allowed(s, approach, height_rate)) << "scene " << k << ", approach " << approach;
    worst = std::max(worst, error);
    if (approach > 0.01) worst_of_fast = std::max(worst_of_fast, error);
  }
  EXPECT_LE(worst_of_fast, 1e-10);
  // None of the kinds may be missing.
  EXPECT_GT(hits, kScenes / 2);
  EXPECT_GT(misses, kScenes / 4);
  EXPECT_GT(grazing_hits, kScenes / 20);
  EXPECT_GT(grazing_misses, kScenes / 20);
  EXPECT_GT(by_edges, hits / 4);
  EXPECT_LT(by_edges, hits * 3 / 4);
  RecordProperty("hits", hits);
  RecordProperty("hits_of_edges", by_edges);
  RecordProperty("grazing_hits", grazing_hits);
  RecordProperty("worst_error_fs", std::to_string(worst * 1e15));
}

const Quat kOnCorner(Eigen::Quaterniond::FromTwoVectors(Vec3(-1, -1, -1), Vec3(0, 0, -1)));

TEST(PolyhedronImpact, KnowsFacesCornersAndEdges) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  Motion a, b;
  a.start.p_WB = Vec3(0.5, 0, 12);
  a.start.v_WB = Vec3(0, 0, -4);
  const auto flat = polyhedron_meets_polyhedron(cube, a, cube, b, 10);
  ASSERT_TRUE(flat.has_value());
  EXPECT_NEAR(flat->time, 2.5, kImpactTolerance);
  EXPECT_EQ(flat->normal_W, Vec3(0, 0, 1));
  EXPECT_LE((flat->point_W - Vec3(0.25, 0, 1)).norm(), 1e-12);  // the middle of what the faces share

  a.start.q_WB = kOnCorner;
  const auto corner = polyhedron_meets_polyhedron(cube, a, cube, b, 10);
  ASSERT_TRUE(corner.has_value());
  EXPECT_NEAR(corner->time, (11 - std::sqrt(3.0)) / 4, kImpactTolerance);
  EXPECT_LE((corner->normal_W - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LE((corner->point_W - Vec3(0.5, 0, 1)).norm(), 1e-12);

  a.start.q_WB = rotation_by(Vec3(M_PI / 4, 0, 0));
  b.start.q_WB = rotation_by(Vec3(0, M_PI / 4, 0));
  const auto edges = polyhedron_meets_polyhedron(cube, a, cube, b, 10);
  ASSERT_TRUE(edges.has_value());
  EXPECT_NEAR(edges->time, (12 - std::sqrt(8.0)) / 4, kImpactTolerance);
  EXPECT_LE((edges->normal_W - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LE((edges->point_W - Vec3(0, 0, std::sqrt(2.0))).norm(), 1e-12);
}

// A wing turns about z at w. Its upper face, at half its thickness d above the axis, meets the tip of a resting
// tetrahedron at the height r when r cos(w t) = d/2.
TEST(PolyhedronImpact, OfATurningWingIsThatOfItsFace) {
  const double turn = 2, thickness = 0.2, arm = 3;
  const ConvexPolyhedron wing = box_polyhedron(Vec3(10, thickness, 1));
  const ConvexPolyhedron tip =
      convex_hull(std::vector<Vec3>{Vec3(0, 0, 0), Vec3(-1, -0.3, 0.5), Vec3(-1, 0.3, -0.5), Vec3(-1, 0.3, 0.5)});
  Motion a, b;
  a.start.p_WB = Vec3(0, arm, 0);
  b.start.w_WB = Vec3(0, 0, turn);
  const auto touch = polyhedron_meets_polyhedron(tip, a, wing, b, 1);
  ASSERT_TRUE(touch.has_value());
  const double exact = std::acos(0.5 * thickness / arm) / turn;
  const double size = wing.radius() + tip.radius();
  EXPECT_NEAR(touch->time, exact, 2 * kImpactTolerance * size / (turn * arm));
  EXPECT_LE((touch->normal_W - Vec3(-std::sin(turn * exact), std::cos(turn * exact), 0)).norm(), 1e-12);
  EXPECT_LE((touch->point_W - Vec3(0, arm, 0)).norm(), 1e-11);
}

TEST(PolyhedronImpact, DoesNotTunnel) {
  const ConvexPolyhedron plate = box_polyhedron(Vec3(10, 10, 1e-3)), bullet = box_polyhedron(Vec3(1e-3, 1e-3, 1e-3));
  Motion a, b;
  a.start.p_WB = Vec3(0.1, 0.2, 10);
  a.start.v_WB = Vec3(0, 0, -1000);
  a.start.w_WB = Vec3(0, 0, 300);
  b.start.w_WB = Vec3(0, 0, -20);
  const auto touch = polyhedron_meets_polyhedron(bullet, a, plate, b, 1);
  ASSERT_TRUE(touch.has_value());
  EXPECT_NEAR(touch->time, (10 - 1e-3) / 1000, kImpactTolerance * 8 / 1000);
}

TEST(PolyhedronImpact, IsZeroForTouchingBodiesThatApproachAndNothingForThoseThatPart) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  for (const double height : {2.0, 1.8}) {
    for (const double v : {-1.0, 1.0}) {
      for (const double spin : {0.0, 0.2}) {
        Motion a, b;
        a.start.p_WB = Vec3(0.3, 0.1, height);
        a.start.v_WB = Vec3(0, 0, v);
        a.start.w_WB = Vec3(0, 0, spin);
        const auto touch = polyhedron_meets_polyhedron(cube, a, cube, b, 10);
        ASSERT_EQ(touch.has_value(), v < 0) << height << " " << spin;
        if (touch) {
          EXPECT_EQ(touch->time, 0);
          EXPECT_EQ(touch->normal_W, Vec3(0, 0, 1));
        }
      }
    }
  }
}

TEST(PolyhedronImpact, ComesBackUnderGravity) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  Motion a, b;
  a.start.p_WB = Vec3(0.3, 0.1, 2);
  a.start.v_WB = Vec3(0, 0, 3);
  a.a_W = Vec3(0, 0, -10);
  const auto thrown = polyhedron_meets_polyhedron(cube, a, cube, b, 10);
  ASSERT_TRUE(thrown.has_value());
  EXPECT_NEAR(thrown->time, 0.6, kImpactTolerance * 4 / 3);
  a.start.v_WB = Vec3::Zero();
  a.start.p_WB.z() = 22;
  const auto dropped = polyhedron_meets_polyhedron(cube, a, cube, b, 10);
  ASSERT_TRUE(dropped.has_value());
  EXPECT_NEAR(dropped->time, 2, kImpactTolerance);
  EXPECT_EQ(polyhedron_meets_polyhedron(cube, a, cube, b, 1.9), std::nullopt);
}

TEST(PolyhedronImpact, OfBodiesThatSlideOrSpinOnEachOtherIsNone) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  for (const double gap : {0.0, 1e-14, 1e-9}) {
    Motion a, b;
    a.start.p_WB = Vec3(0.3, 0.1, 2 + gap);
    EXPECT_EQ(polyhedron_meets_polyhedron(cube, a, cube, b, 10), std::nullopt) << gap;
    a.start.v_WB = Vec3(0.7, 0.4, 0);
    EXPECT_EQ(polyhedron_meets_polyhedron(cube, a, cube, b, 10), std::nullopt) << gap;
    a.start.w_WB = Vec3(0, 0, 2);
    b.start.w_WB = Vec3(0, 0, -1);
    EXPECT_EQ(polyhedron_meets_polyhedron(cube, a, cube, b, 10), std::nullopt) << gap;
  }
}

// The same scene with the bodies exchanged, from a train at 50 m/s, and a kilometre off.
TEST(PolyhedronImpact, DoesNotDependOnTheObserver) {
  SceneRandom random(9);
  int hits = 0;
  for (int k = 0; k < 200; ++k) {
    const Scene s = random_scene(random, true);
    const auto here = polyhedron_meets_polyhedron(s.a, s.motion_a, s.b, s.motion_b, kHorizon);
    const auto swapped = polyhedron_meets_polyhedron(s.b, s.motion_b, s.a, s.motion_a, kHorizon);
    Motion a = s.motion_a, b = s.motion_b;
    const Vec3 offset = 1000 * random.direction(), train = 50 * random.direction();
    for (Motion* m : {&a, &b}) m->start.p_WB += offset, m->start.v_WB += train;
    const auto there = polyhedron_meets_polyhedron(s.a, a, s.b, b, kHorizon);
    ASSERT_EQ(here.has_value(), swapped.has_value()) << k;
    ASSERT_EQ(here.has_value(), there.has_value()) << k;
    if (!here) continue;
    ++hits;
    // A kilometre has 1e-13 m of rounding, twice; most of these meet at 0.1 m/s or more. Points and normals move and
    // turn at some metres a second.
    EXPECT_NEAR(swapped->time, here->time, 1e-11) << k;
    EXPECT_NEAR(there->time, here->time, 1e-11) << k;
    EXPECT_LE((swapped->normal_W + here->normal_W).norm(), 1e-9) << k;
    EXPECT_LE((swapped->point_W - here->point_W).norm(), 1e-9) << k;
    EXPECT_LE((there->point_W - there->time * train - offset - here->point_W).norm(), 1e-9) << k;
  }
  EXPECT_GT(hits, 80);
}

TEST(PolyhedronImpact, IsNothingForNan) {
  const ConvexPolyhedron cube = box_polyhedron(Vec3(2, 2, 2));
  for (int place = 0; place < 4; ++place) {
    Motion a, b;
    a.start.p_WB = Vec3(0, 0, 3);
    a.start.v_WB = Vec3(0, 0, -1);
    (place == 0   ? a.start.p_WB
     : place == 1 ? a.start.v_WB
     : place == 2 ? b.start.w_WB
                  : a.a_W)
        .x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(polyhedron_meets_polyhedron(cube, a, cube, b, 10), std::nullopt) << place;
  }
}

}  // namespace
}  // namespace plumbline
