// The fast gas of hard spheres: the collisions that must happen, in their order, at their times.
#include "plumbline/core/events/hard_sphere_gas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "hard_sphere_scene.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using gas::BruteForceGas;
using gas::lattice_gas;
using gas::Scene;

void expect_same_collisions(const Scene& scene, int collisions) {
  HardSphereGas fast(scene.positions, scene.velocities, scene.diameter, scene.box);
  BruteForceGas slow(scene), shadow(gas::disturbed(scene));
  double allowed = gas::kClockRounding;
  for (int k = 0; k < collisions; ++k) {
    const HardSphereCollision expected = slow.collide_next(), got = fast.collide_next();
    allowed = std::max(allowed, std::abs(shadow.collide_next().time - expected.time));
    ASSERT_EQ(got.a, expected.a) << "collision " << k;
    ASSERT_EQ(got.b, expected.b) << "collision " << k;
    ASSERT_NEAR(got.time, expected.time, allowed) << "collision " << k;
  }
  ASSERT_LT(allowed, 1e-8);  // else the comparison would say nothing
  const std::vector<Vec3> p = fast.positions(), v = fast.velocities();
  double apart = 0, shadow_apart = 0, turned = 0, shadow_turned = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    apart = max_or_nan(apart, slow.way_around(slow.positions()[i] - p[i]).norm());
    turned = max_or_nan(turned, (slow.velocities()[i] - v[i]).norm());
    shadow_apart = max_or_nan(shadow_apart, (slow.positions()[i] - shadow.positions()[i]).norm());
    shadow_turned = max_or_nan(shadow_turned, (slow.velocities()[i] - shadow.velocities()[i]).norm());
  }
  EXPECT_LT(apart, shadow_apart);
  EXPECT_LT(turned, shadow_turned);
  testing::Test::RecordProperty("apart", std::to_string(apart / gas::kDisturbance) + "e-13");
}

TEST(HardSphereGas, HasTheCollisionsOfABruteForceSearchInAFluid) {
  expect_same_collisions(lattice_gas(4, 4, 4, 0.5, 1), 400);
}

TEST(HardSphereGas, HasTheCollisionsOfABruteForceSearchInADenseFluid) {
  expect_same_collisions(lattice_gas(4, 4, 4, 0.9, 2), 400);
}

TEST(HardSphereGas, HasTheCollisionsOfABruteForceSearchInAThinGas) {
  expect_same_collisions(lattice_gas(3, 3, 3, 0.05, 3), 100);
}

// Edges of different length, cells of different width, as few as three along one axis.
TEST(HardSphereGas, HasTheCollisionsOfABruteForceSearchInALongBox) {
  expect_same_collisions(lattice_gas(3, 4, 6, 0.6, 4), 400);
}

TEST(HardSphereGas, MeetsThroughTheSidesOfTheBox) {
  // Centres 2 apart through the side at x = 0, each coming with speed 1: diameter 1 apart after 0.5 s at x = 0.5
  // and 9.5.
  const Vec3 p[] = {Vec3(1, 5, 5), Vec3(9, 5, 5)}, v[] = {Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  HardSphereGas gas(p, v, 1, Vec3(10, 10, 10));
  const HardSphereCollision hit = gas.collide_next();
  EXPECT_NEAR(hit.time, 0.5, 1e-15);
  EXPECT_EQ(hit.a, 0u);
  EXPECT_EQ(hit.b, 1u);
  EXPECT_LT((gas.positions()[0] - Vec3(0.5, 5, 5)).norm(), 1e-14);
  EXPECT_LT((gas.velocities()[0] - Vec3(1, 0, 0)).norm(), 1e-15);
  // Now they part and meet on the other side: 9 apart with speed 2, so 8 to go. The virial: twice d * 2 m/s.
  EXPECT_NEAR(gas.collide_next().time, 0.5 + 4, 1e-14);
  EXPECT_NEAR(gas.statistics().virial, 4, 1e-14);
}

TEST(HardSphereGas, MeetsObliquelyAsTheClosedFormSays) {
  // Impact parameter 0.6 at diameter 1: they meet 0.8 before the foot of the perpendicular, n = (0.8, 0.6), and
  // exchange their velocities along it.
  const Vec3 p[] = {Vec3(2, 5, 5), Vec3(6, 5.6, 5)}, v[] = {Vec3(4, 0, 0), Vec3::Zero()};
  HardSphereGas gas(p, v, 1, Vec3(12, 12, 12));
  EXPECT_NEAR(gas.collide_next().time, (4 - 0.8) / 4, 1e-15);
  EXPECT_LT((gas.velocities()[1] - Vec3(2.56, 1.92, 0)).norm(), 1e-14);
  EXPECT_LT((gas.velocities()[0] - Vec3(1.44, -1.92, 0)).norm(), 1e-14);
}

// What was flown can be flown back: no collision was missed or invented, or the gas would not find its way home.
TEST(HardSphereGas, FlownBackReturnsToItsStart) {
  const Scene scene = lattice_gas(5, 5, 5, 0.5, 5);
  HardSphereGas forth(scene.positions, scene.velocities, scene.diameter, scene.box);
  const double duration = 1;  // 7.7 collisions a sphere
  forth.run_until(duration);
  const std::vector<Vec3> p = forth.positions();
  std::vector<Vec3> v = forth.velocities();
  for (Vec3& u : v) u = -u;
  HardSphereGas back(p, v, scene.diameter, scene.box);
  back.run_until(duration);
  EXPECT_EQ(back.statistics().collisions, forth.statistics().collisions);
  EXPECT_GT(forth.statistics().collisions, 3 * scene.positions.size());
  const BruteForceGas around(scene);
  // 7.7 collisions a sphere on the way and as many back, each of which makes a difference some 1 + 2 l/d times larger,
  // with l the way since the last one, 0.2 d in the mean here and more for some: below 3 on average, 3^15 = 1e7.
  const double allowed = 1e-15 * 1e7 * 10;
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_LT(around.way_around(back.positions()[i] - scene.positions[i]).norm(), allowed);
    EXPECT_LT((back.velocities()[i] + scene.velocities[i]).norm(), 10 * allowed);
  }
}

// 1e6 collisions: the relative error of energy is a walk of 1e6 steps of a rounding of two spheres' part of it,
// sqrt(1e6) 2e-16 2/1372, far below 1e-12; momentum likewise. A contact is as exact as positions in a cell and times
// within 6 s of clock are: 4e-16 of the clock times speeds of 4.
TEST(HardSphereGas, KeepsEnergyAndMomentumOverAMillionCollisions) {
  const Scene scene = lattice_gas(7, 7, 7, 0.5, 6);
  HardSphereGas gas(scene.positions, scene.velocities, scene.diameter, scene.box);
  const double energy = gas.velocity_square_sum();
  gas.run_events(1'000'000);
  EXPECT_EQ(gas.statistics().collisions, 1'000'000u);
  EXPECT_NEAR(gas.velocity_square_sum() / energy, 1, 1e-12);
  Vec3 momentum = Vec3::Zero();
  double speeds = 0;
  for (const Vec3& v : gas.velocities()) {
    momentum += v;
    speeds += v.norm();
  }
  EXPECT_LT(momentum.norm() / speeds, 1e-12);
  EXPECT_LT(gas.statistics().contact_error, 3e-14);
  EXPECT_GT(gas.smallest_gap(), -3e-14);
}

// Stopping to look is not an event.
TEST(HardSphereGas, GoesTheSameWayWhereverItIsStopped) {
  const Scene scene = lattice_gas(5, 5, 5, 0.5, 7);
  HardSphereGas whole(scene.positions, scene.velocities, scene.diameter, scene.box);
  HardSphereGas pieces(scene.positions, scene.velocities, scene.diameter, scene.box);
  whole.run_until(8);  // long enough for the clock to be set back several times
  for (int k = 1; k <= 80; ++k) {
    pieces.run_until(0.1 * k);
    (void)pieces.positions();
  }
  EXPECT_EQ(pieces.time(), 8);
  EXPECT_EQ(whole.statistics().collisions, pieces.statistics().collisions);
  EXPECT_EQ(whole.statistics().virial, pieces.statistics().virial);
  const std::vector<Vec3> p = whole.positions(), q = pieces.positions();
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(p[i], q[i]);
}

TEST(HardSphereGas, AtRestStaysAtRest) {
  const Scene scene = lattice_gas(4, 4, 4, 0.5, 8);
  const std::vector<Vec3> still(scene.positions.size(), Vec3::Zero());
  HardSphereGas gas(scene.positions, still, scene.diameter, scene.box);
  gas.run_until(100);
  EXPECT_EQ(gas.time(), 100);
  EXPECT_EQ(gas.compressibility(), 1);
  EXPECT_THROW(gas.collide_next(), std::runtime_error);
}

// Touching from the start: those that approach collide at once, those that part do not.
TEST(HardSphereGas, CollidesAtOnceWhereSpheresTouchAndApproach) {
  const Vec3 p[] = {Vec3(2, 2, 2), Vec3(3, 2, 2), Vec3(6, 6, 6), Vec3(7, 6, 6)};
  const Vec3 v[] = {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 0)};
  HardSphereGas gas(p, v, 1, Vec3(10, 10, 10));
  const HardSphereCollision hit = gas.collide_next();
  EXPECT_NEAR(hit.time, 0, 1e-15);
  EXPECT_EQ(hit.a, 0u);
  EXPECT_EQ(hit.b, 1u);
  gas.run_until(1);
  EXPECT_EQ(gas.statistics().collisions, 1u);
}

TEST(HardSphereGas, RejectsWhatItCannotRun) {
  const Scene good = lattice_gas(4, 4, 4, 0.5, 9);
  const auto make = [&](const auto& change) {
    Scene scene = good;
    change(scene);
    HardSphereGas(scene.positions, scene.velocities, scene.diameter, scene.box);
  };
  EXPECT_NO_THROW(make([](Scene&) {}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make([](Scene& s) { s.velocities.pop_back(); }), std::invalid_argument);
  EXPECT_THROW(make([](Scene& s) { s.diameter = 0; }), std::invalid_argument);
  EXPECT_THROW(make([&](Scene& s) { s.diameter = nan; }), std::invalid_argument);
  EXPECT_THROW(make([](Scene& s) { s.box.x() = 3.9; }), std::invalid_argument);
  EXPECT_THROW(make([](Scene& s) { s.box.z() = 1e9; }), std::invalid_argument);
  EXPECT_THROW(make([&](Scene& s) { s.box.y() = nan; }), std::invalid_argument);
  EXPECT_THROW(make([&](Scene& s) { s.positions[3].y() = nan; }), std::invalid_argument);
  EXPECT_THROW(make([&](Scene& s) { s.velocities[3].y() = nan; }), std::invalid_argument);
  EXPECT_THROW(make([](Scene& s) { s.positions[1] = s.positions[0] + Vec3(0.9, 0, 0); }), std::invalid_argument);
  EXPECT_THROW(make([](Scene& s) { std::fill(s.positions.begin(), s.positions.end(), Vec3::Zero()); }),
               std::invalid_argument);
  HardSphereGas gas(good.positions, good.velocities, good.diameter, good.box);
  gas.run_until(0.1);
  EXPECT_THROW(gas.run_until(0.05), std::invalid_argument);
  EXPECT_THROW(gas.run_until(nan), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
