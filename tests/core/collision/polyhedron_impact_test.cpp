#include "plumbline/core/collision/polyhedron_impact.hpp"

#include <gtest/gtest.h>

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

TEST(PolyhedronImpact, AgreesWithPiercingOnRandomPairs) {
  SceneRandom random(8);
  int hits = 0, misses = 0, at_once = 0, by_kind[3] = {0, 0, 0}, grazing_hits = 0, grazing_misses = 0;
  double worst = 0, worst_of_fast = 0;
  for (int k = 0; k < kScenes; ++k) {
    Scene s = random_scene(random, k % 3 != 0);
    const bool grazing = k % 5 == 0;
    if (grazing) make_graze(s, (k % 2 == 0 ? 1 : -1) * std::pow(10, -2 - k / 10 % 4));
    PiercingOracle oracle(s.a, s.motion_a, s.b, s.motion_b);
    const auto expected = oracle.first_touch(0, kHorizon, kResolution);
    const auto found = polyhedron_meets_polyhedron(s.a, s.motion_a, s.b, s.motion_b, kHorizon);
    if (expected && *expected == 0) {
      ++at_once;
      continue;
    }
    ASSERT_EQ(found.has_value(), expected.has_value()) << "scene " << k << ": " << (found ? found->time : *expected)
                                                       << " height " << oracle.height(found ? found->time : *expected);
    if (!found) {
      ++misses;
      grazing_misses += grazing ? 1 : 0;
      continue;
    }
    ++hits;
    grazing_hits += grazing ? 1 : 0;
    const BodyState a = state_at(s.motion_a, found->time), b = state_at(s.motion_b, found->time);
    ++by_kind[static_cast<int>(separating_axis(s.a, a, s.b, b).kind)];
    const Vec3 v_a = a.v_WB + a.w_WB.cross(found->point_W - a.p_WB);
    const Vec3 v_b = b.v_WB + b.w_WB.cross(found->point_W - b.p_WB);
    const double approach = -found->normal_W.dot(v_a - v_b);
    ASSERT_GT(approach, 0) << "scene " << k;
    const double error = std::abs(found->time - *expected);
    const double before = 1e-6;  // [s]
    const double height_rate = (oracle.height(found->time - before) - oracle.height(found->time)) / before;
    EXPECT_LE(error, allowed(s, approach, height_rate))
        << "height rate " << height_rate << "scene " << k << ", approach " << approach;
    worst = std::max(worst, error);
    if (approach > 0.01) worst_of_fast = std::max(worst_of_fast, error);
  }
  EXPECT_LE(worst_of_fast, 1e-10);
  RecordProperty("worst", std::to_string(worst * 1e15) + " fs");
  printf("hits %d misses %d at once %d kinds %d %d %d grazing %d %d worst %g fast %g\n", hits, misses, at_once,
         by_kind[0], by_kind[1], by_kind[2], grazing_hits, grazing_misses, worst, worst_of_fast);
}

}  // namespace
}  // namespace plumbline
