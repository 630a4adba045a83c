// The fast time-stepped spheres: the same states as the simulator that people read, every impact found, energy kept.
#include "plumbline/core/kinetics/sphere_stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

constexpr double kDt = 1.0 / 60;

// Spheres of several sizes on a jittered lattice of edge 2, in random flight.
SphereBoxScene gas(int nx, int ny, int nz, double smallest_radius, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto random = [&] { return 0x1p-52 * static_cast<double>(bits() >> 11) - 1; };  // in [-1, 1)
  SphereBoxScene scene;
  scene.lower_W = Vec3(-1, -2, -3);
  scene.upper_W = scene.lower_W + 2 * Vec3(nx, ny, nz);
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      for (int z = 0; z < nz; ++z) {
        SteppedSphere s;
        s.radius = smallest_radius + (0.5 - smallest_radius) * std::abs(random());
        s.mass = 1 + std::abs(random());
        const double a = random(), b = random(), c = random(), u = random(), v = random(), w = random();
        s.p_W = scene.lower_W + 2 * Vec3(x + 0.5, y + 0.5, z + 0.5) + 0.45 * Vec3(a, b, c);
        s.v_W = 3 * Vec3(u, v, w);
        scene.spheres.push_back(s);
      }
    }
  }
  return scene;
}

// The same as a scenario: six half-spaces, then the spheres.
Scenario as_scenario(const SphereBoxScene& scene) {
  Scenario s;
  s.id = "test/spheres_in_a_box";
  s.gravity = scene.gravity;
  s.contact = ContactMaterial{scene.restitution, 0};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      Body wall;
      wall.name = "wall";
      wall.shape = HalfSpace{side * Vec3::Unit(axis)};
      wall.fixed = true;
      wall.initial.p_WB = side > 0 ? scene.lower_W : scene.upper_W;
      s.bodies.push_back(wall);
    }
  }
  for (const SteppedSphere& b : scene.spheres) s.bodies.push_back(scenes::ball("b", b.radius, b.mass, b.p_W, b.v_W));
  return s;
}

// Pairs that overlap and approach, and sides of the box that are met, at the start of a step; `once` is false where a
// sphere has part in two of them.
struct Impacts {
  std::uint64_t count = 0;
  bool once = true;
};
Impacts impacts_ahead(const SphereBoxScene& scene, const std::vector<SteppedSphere>& spheres) {
  Impacts result;
  std::set<std::size_t> busy;
  const auto count = [&](std::size_t i) { result.once = busy.insert(i).second && result.once; };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const SteppedSphere& a = spheres[i];
    for (int axis = 0; axis < 3; ++axis) {
      const double v = a.v_W[axis] + scene.gravity[axis] * kDt;
      if ((v < 0 && a.p_W[axis] - a.radius <= scene.lower_W[axis]) ||
          (v > 0 && a.p_W[axis] + a.radius >= scene.upper_W[axis])) {
        ++result.count;
        count(i);
      }
    }
    for (std::size_t j = i + 1; j < spheres.size(); ++j) {
      const SteppedSphere& b = spheres[j];
      const Vec3 d = a.p_W - b.p_W;
      if (d.norm() <= a.radius + b.radius && d.dot(a.v_W - b.v_W) < 0) {
        ++result.count;
        count(i);
        count(j);
      }
    }
  }
  return result;
}

// Each impact makes a difference in position some 2 l/r times larger, l the way since the last one: below 20 here.
// Spheres have at most four impacts: 1e-15 * 20^4 = 2e-10.
void expect_states_of_the_simulator(const SphereBoxScene& scene, int steps, std::uint64_t impacts) {
  Simulator simulator(as_scenario(scene), {Integrator::kSemiImplicitEuler, ImpactRule::kStepStart});
  SphereStepper stepper(scene);
  for (int k = 0; k < steps; ++k) {
    ASSERT_TRUE(impacts_ahead(scene, stepper.spheres()).once) << "step " << k << ": choose a scene without that";
    simulator.step(kDt);
    stepper.step(kDt);
  }
  double apart = 0, velocity = 0;
  const std::vector<SteppedSphere> spheres = stepper.spheres();
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const BodyState& expected = simulator.states()[i + 6];
    apart = max_or_nan(apart, (spheres[i].p_W - expected.p_WB).norm());
    velocity = max_or_nan(velocity, (spheres[i].v_W - expected.v_WB).norm());
  }
  testing::Test::RecordProperty("apart_in_1e-15_m", std::to_string(apart * 1e15));
  EXPECT_LT(apart, 2e-10);
  EXPECT_LT(velocity, 2e-9);
  EXPECT_GE(stepper.impacts(), impacts);
}

TEST(SphereStepper, HasTheStatesOfTheSimulatorInAnElasticGas) {
  expect_states_of_the_simulator(gas(3, 3, 4, 0.3, 1), 60, 40);
}

TEST(SphereStepper, HasTheStatesOfTheSimulatorWithGravityAndRestitution) {
  SphereBoxScene scene = gas(3, 4, 3, 0.2, 7);
  scene.gravity = Vec3(0.3, 0, -9.81);
  scene.restitution = 0.7;
  expect_states_of_the_simulator(scene, 40, 30);
}

TEST(SphereStepper, FindsEveryImpact) {
  const SphereBoxScene scene = gas(8, 7, 9, 0.2, 3);
  SphereStepper stepper(scene);
  int compared = 0;
  std::uint64_t impacts = 0;
  for (int k = 0; k < 240; ++k) {
    const Impacts ahead = impacts_ahead(scene, stepper.spheres());
    const std::uint64_t before = stepper.impacts();
    stepper.step(kDt);
    if (!ahead.once) continue;  // the first impulse may take the second impact away
    EXPECT_EQ(stepper.impacts() - before, ahead.count) << "step " << k;
    ++compared;
    impacts += ahead.count;
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(impacts, 300u);
}

// The first overlap is after 31 steps: 1.5 apart and 1 reach, 0.5 to go at 1/60 a step is 30 steps to touch, and
// rounding decides whether that counts; so 1.49 apart, 29.4 steps. Then velocities change places.
TEST(SphereStepper, NoticesAHeadOnImpactAtTheNextStep) {
  SphereBoxScene scene;
  scene.upper_W = Vec3(10, 10, 10);
  scene.spheres = {{Vec3(3, 5, 5), Vec3(1, 0, 0), 0.5, 1}, {Vec3(4.49, 5, 5), Vec3::Zero(), 0.5, 1}};
  SphereStepper stepper(scene);
  for (int k = 0; k < 30; ++k) stepper.step(kDt);
  EXPECT_EQ(stepper.impacts(), 0u);
  EXPECT_NEAR(stepper.spheres()[0].p_W.x(), 3.5, 1e-14);
  stepper.step(kDt);
  EXPECT_EQ(stepper.impacts(), 1u);
  EXPECT_NEAR(stepper.spheres()[0].p_W.x(), 3.5, 1e-14);
  EXPECT_NEAR(stepper.spheres()[1].p_W.x(), 4.49 + kDt, 1e-14);
  for (int k = 0; k < 30; ++k) stepper.step(kDt);  // still overlapping for a step, but they part
  EXPECT_EQ(stepper.impacts(), 1u);
  EXPECT_NEAR(stepper.spheres()[1].v_W.x(), 1, 1e-15);
}

// Unequal masses, e = 0.5: u = 3, J = (1 + e) u m_a m_b / (m_a + m_b) = 1.5 * 3 * 2/3 = 3.
TEST(SphereStepper, GivesTheImpulseOfTheSlide) {
  SphereBoxScene scene;
  scene.upper_W = Vec3(10, 10, 10);
  scene.restitution = 0.5;
  scene.spheres = {{Vec3(4, 5, 5), Vec3(3, 0, 0), 0.5, 2}, {Vec3(5, 5, 5), Vec3(0, 0, 1), 0.5, 1}};
  SphereStepper stepper(scene);
  stepper.step(kDt);
  EXPECT_NEAR(stepper.spheres()[0].v_W.x(), 3 - 3.0 / 2, 1e-15);
  EXPECT_NEAR(stepper.spheres()[1].v_W.x(), 3, 1e-15);
  EXPECT_EQ(stepper.spheres()[1].v_W.z(), 1);
}

// Also where many spheres are in several contacts at once: pair by pair nothing is lost. About 2e4 impacts, each with
// a rounding of its pair's share.
TEST(SphereStepper, KeepsTheEnergyOfADenseElasticGas) {
  SphereBoxScene scene = gas(10, 10, 10, 0.49, 4);
  for (SteppedSphere& s : scene.spheres) s.radius *= 1.9;
  SphereStepper stepper(scene);
  const double energy = stepper.kinetic_energy();
  for (int k = 0; k < 180; ++k) stepper.step(kDt);
  EXPECT_GT(stepper.impacts(), 10'000u);
  EXPECT_NEAR(stepper.kinetic_energy() / energy, 1, 1e-12);
  for (const SteppedSphere& s : stepper.spheres()) {
    EXPECT_GT((s.p_W - scene.lower_W).minCoeff(), 0);
    EXPECT_GT((scene.upper_W - s.p_W).minCoeff(), 0);
  }
}

TEST(SphereStepper, KeepsAPlanarGasInItsPlane) {
  SphereBoxScene scene = gas(12, 12, 1, 0.4, 5);
  for (SteppedSphere& s : scene.spheres) s.p_W.z() = -2, s.v_W.z() = 0;
  SphereStepper stepper(scene);
  for (int k = 0; k < 120; ++k) stepper.step(kDt);
  EXPECT_GT(stepper.impacts(), 100u);
  for (const SteppedSphere& s : stepper.spheres()) EXPECT_EQ(s.p_W.z(), -2);
}

// A ball that falls from 1 m with e = 0.5 has bounced out after 3 (2 * 1/g)^(1/2) = 1.35 s, and lies still from then
// on, at most one step of the first impact (4.4 m/s) deep in the floor.
TEST(SphereStepper, LetsAFallenBallRest) {
  SphereBoxScene scene;
  scene.upper_W = Vec3(4, 4, 4);
  scene.gravity = Vec3(0, 0, -9.81);
  scene.restitution = 0.5;
  scene.spheres = {{Vec3(2, 2, 1.25), Vec3(0, 0, 0), 0.25, 1}};
  SphereStepper stepper(scene);
  for (int k = 0; k < 120; ++k) stepper.step(kDt);
  const SteppedSphere rests = stepper.spheres()[0];
  EXPECT_EQ(rests.v_W.z(), 0);
  EXPECT_NEAR(rests.p_W.z(), 0.25, 4.5 * kDt);
  stepper.step(kDt);
  EXPECT_EQ(stepper.spheres()[0].p_W, rests.p_W);
}

TEST(SphereStepper, RejectsWhatItCannotRun) {
  const auto make = [](const auto& change) {
    SphereBoxScene scene = gas(3, 3, 3, 0.3, 6);
    change(scene);
    return SphereStepper(scene);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(make([](SphereBoxScene&) {}));
  EXPECT_NO_THROW(make([](SphereBoxScene& s) { s.spheres.clear(); }).step(kDt));
  EXPECT_THROW(make([](SphereBoxScene& s) { s.spheres[2].radius = 0; }), std::invalid_argument);
  EXPECT_THROW(make([](SphereBoxScene& s) { s.spheres[2].mass = -1; }), std::invalid_argument);
  EXPECT_THROW(make([&](SphereBoxScene& s) { s.spheres[2].mass = nan; }), std::invalid_argument);
  EXPECT_THROW(make([&](SphereBoxScene& s) { s.spheres[2].p_W.x() = nan; }), std::invalid_argument);
  EXPECT_THROW(make([&](SphereBoxScene& s) { s.spheres[2].v_W.x() = nan; }), std::invalid_argument);
  EXPECT_THROW(make([](SphereBoxScene& s) { s.spheres[2].p_W.x() = 100; }), std::invalid_argument);
  EXPECT_THROW(make([](SphereBoxScene& s) { s.upper_W.y() = s.lower_W.y(); }), std::invalid_argument);
  EXPECT_THROW(make([](SphereBoxScene& s) { s.restitution = 1.1; }), std::invalid_argument);
  EXPECT_THROW(make([&](SphereBoxScene& s) { s.restitution = nan; }), std::invalid_argument);
  EXPECT_THROW(make([&](SphereBoxScene& s) { s.gravity.z() = nan; }), std::invalid_argument);
  EXPECT_THROW(make([](SphereBoxScene&) {}).step(0), std::invalid_argument);
  EXPECT_THROW(make([](SphereBoxScene&) {}).step(nan), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
