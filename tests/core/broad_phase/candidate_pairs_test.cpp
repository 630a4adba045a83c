// Course slide 17: "first test whether bounding volumes intersect; if so, apply more complex tests."
#include "plumbline/core/broad_phase/candidate_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "scattered_boxes.hpp"

namespace plumbline {
namespace {

struct Scene {
  std::vector<Body> bodies;
  std::vector<Motion> motions;
  double duration = 0.05;

  void add(const Shape& shape, const Motion& motion, bool fixed = false) {
    Body body;
    body.shape = shape;
    body.fixed = fixed;
    body.initial = motion.start;
    bodies.push_back(body);
    motions.push_back(motion);
  }
};

// Spheres of 0.3 to 0.6 m at 0.1 to a cubic metre, at speeds of some m/s under gravity, over a floor and beside a
// slope.
Scene gas(std::size_t n, Dice& dice) {
  Scene scene;
  const double half = 0.5 * std::cbrt(10.0 * static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    Motion m;
    m.start.p_WB = dice.vector(half);
    m.start.v_WB = dice.vector(5);
    m.a_W = {0, 0, -9.81};
    scene.add(Sphere{dice.in(0.3, 0.6)}, m);
  }
  Motion plane;
  plane.start.p_WB.z() = -half;
  scene.add(HalfSpace{Vec3::UnitZ()}, plane, true);
  plane.start.p_WB = {0, -half, 0};
  scene.add(HalfSpace{Vec3(0, 0.8, 0.6)}, plane, true);
  return scene;
}

// The exact test: the time of impact of two bodies of the scene, if there is one within the step.
bool meet(const Scene& scene, BodyPair pair) {
  const Motion &a = scene.motions[pair.first], &b = scene.motions[pair.second];
  const auto* sphere = std::get_if<Sphere>(&scene.bodies[pair.first].shape);
  if (const auto* other = std::get_if<Sphere>(&scene.bodies[pair.second].shape)) {
    // Those that overlap at the start and part count as well: they touch, and that is what must not be missed.
    const double reach = sphere->radius + other->radius;
    if ((a.start.p_WB - b.start.p_WB).norm() <= reach) return true;
    const auto time = sphere_meets_sphere(a, sphere->radius, b, other->radius, scene.duration);
    return time && *time <= scene.duration;
  }
  const Vec3& n = std::get<HalfSpace>(scene.bodies[pair.second].shape).normal;
  const Plane plane{n, n.dot(b.start.p_WB)};
  if (n.dot(a.start.p_WB) - plane.offset <= sphere->radius) return true;
  const auto time = sphere_meets_plane(a, sphere->radius, plane);
  return time && *time <= scene.duration;
}

std::vector<BodyPair> moving_pairs(const Scene& scene) {
  std::vector<BodyPair> pairs;
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < scene.bodies.size(); ++j) {
      if (!scene.bodies[i].fixed || !scene.bodies[j].fixed) pairs.push_back({i, j});
    }
  }
  return pairs;
}

std::vector<BodyPair> meeting(const Scene& scene, std::span<const BodyPair> pairs) {
  std::vector<BodyPair> result;
  for (const BodyPair pair : pairs) {
    if (meet(scene, pair)) result.push_back(pair);
  }
  return result;
}

TEST(CandidatePairs, SaveExactTestsAndMissNoImpact) {
  Dice dice(5);
  CandidatePairs candidates;
  std::size_t all_tests = 0, box_tests = 0, sphere_tests = 0, impacts = 0;
  for (int k = 0; k < 40; ++k) {
    const Scene scene = gas(200, dice);
    const std::vector<BodyPair> all = moving_pairs(scene);
    const auto some = candidates.find(scene.bodies, scene.motions, scene.duration);
    const std::vector<BodyPair> expected = meeting(scene, all);
    EXPECT_EQ(meeting(scene, some), expected);
    EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
    all_tests += all.size();
    box_tests += some.size();
    impacts += expected.size();
    // The same with spheres around the swept bodies, half-spaces always tested.
    std::vector<BodyPair> by_sphere;
    for (const BodyPair pair : all) {
      const auto bound = [&](std::uint32_t i) {
        return swept_sphere(scene.bodies[i].shape, scene.motions[i], scene.duration);
      };
      if (overlap(bound(pair.first), bound(pair.second))) by_sphere.push_back(pair);
    }
    EXPECT_EQ(meeting(scene, by_sphere), expected);
    sphere_tests += by_sphere.size();
  }
  RecordProperty("exact_tests_without_bounds", std::to_string(all_tests));
  RecordProperty("exact_tests_with_boxes", std::to_string(box_tests));
  RecordProperty("exact_tests_with_spheres", std::to_string(sphere_tests));
  RecordProperty("impacts", std::to_string(impacts));
  EXPECT_GT(impacts, 1000u);
  // Two boxes of 0.9 m that move by 0.25 m meet if their centres are within 1.15 m or so along each axis: a share of
  // (2 1.15)^3 / (10 200) = 0.6 % of the pairs, at most doubled by the spread of sizes and the floor. 2 % leaves room.
  EXPECT_LT(box_tests, all_tests / 50);
  // Spheres are bounded best by spheres, but here all 400 pairs with a half-space stay, whose sphere is infinite.
  EXPECT_LT(sphere_tests, all_tests / 25);
}

TEST(CandidatePairs, AreTheSameWithEveryBroadPhase) {
  Dice dice(6);
  const Scene scene = gas(300, dice);
  CandidatePairs reference(make_brute_force());
  const auto expected = reference.find(scene.bodies, scene.motions, scene.duration, 0.1);
  for (const BroadPhaseMethod& method : broad_phases()) {
    CandidatePairs candidates(method.make());
    EXPECT_TRUE(std::ranges::equal(candidates.find(scene.bodies, scene.motions, scene.duration, 0.1), expected));
  }
}

TEST(CandidatePairs, LeaveOutFixedBodiesAmongThemselves) {
  Scene scene;
  const Motion at_rest;
  scene.add(HalfSpace{Vec3::UnitZ()}, at_rest, true);
  scene.add(Box{Vec3::Ones()}, at_rest, true);
  scene.add(Box{Vec3::Ones()}, at_rest, true);
  scene.add(Sphere{1}, at_rest);
  CandidatePairs candidates;
  const auto pairs = candidates.find(scene.bodies, scene.motions, scene.duration);
  EXPECT_TRUE(std::ranges::equal(pairs, std::vector<BodyPair>{{0, 3}, {1, 3}, {2, 3}}));
}

// A bullet of 1 cm at 1000 m/s crosses a 10 cm plate within one step: neither end of its way is near.
TEST(CandidatePairs, FindTheBulletThatWouldTunnel) {
  Scene scene;
  scene.duration = 0.01;
  Motion bullet, plate;
  bullet.start.p_WB = {-5, 0, 0};
  bullet.start.v_WB = {1000, 0, 0};
  scene.add(Sphere{0.01}, bullet);
  scene.add(Box{Vec3(0.1, 2, 2)}, plate, true);
  CandidatePairs candidates;
  EXPECT_EQ(candidates.find(scene.bodies, scene.motions, scene.duration).size(), 1u);
  EXPECT_EQ(candidates.find(scene.bodies, scene.motions, 0).size(), 0u);
}

TEST(CandidatePairs, ReachAsFarAsTheMargin) {
  Scene scene;
  Motion left, right, floor;
  right.start.p_WB = {2.5, 0, 0};  // a gap of 0.5 m; the floor is 0.25 m below
  floor.start.p_WB = {0, 0, -1.25};
  scene.add(Sphere{1}, left);
  scene.add(Sphere{1}, right);
  scene.add(HalfSpace{Vec3(0, 0, 1)}, floor, true);
  CandidatePairs candidates;
  EXPECT_EQ(candidates.find(scene.bodies, scene.motions, 0, 0.24).size(), 0u);
  EXPECT_EQ(candidates.find(scene.bodies, scene.motions, 0, 0.26).size(), 2u);
  EXPECT_EQ(candidates.find(scene.bodies, scene.motions, 0, 0.51).size(), 3u);
}

TEST(CandidatePairs, RefuseWhatMakesNoSense) {
  Dice dice(7);
  Scene scene = gas(3, dice);
  CandidatePairs candidates;
  EXPECT_THROW(CandidatePairs(nullptr), std::invalid_argument);
  EXPECT_THROW(candidates.find(scene.bodies, std::span(scene.motions).first(2), 1), std::invalid_argument);
  EXPECT_THROW(candidates.find(scene.bodies, scene.motions, 1, -1), std::invalid_argument);
  scene.motions[1].start.v_WB.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(candidates.find(scene.bodies, scene.motions, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
