// The fast path gives what the readable one gives.
#include "plumbline/core/kinetics/free_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

constexpr double kEps = std::numeric_limits<double>::epsilon();

Scenario swarm(std::size_t count, double spin) {
  std::mt19937_64 bits(11);
  const auto uniform = [&] { return 2 * static_cast<double>(bits() >> 11) * 0x1p-53 - 1; };
  const auto vector = [&] { return Vec3(uniform(), uniform(), uniform()); };
  Scenario s;
  s.gravity = Vec3(0.1, 0, -kG);
  for (std::size_t i = 0; i < count; ++i) {
    Body b = solid("b" + std::to_string(i), Box{Vec3(1.5, 1.2, 1) + 0.4 * vector()}, 2 + uniform(), vector(), vector());
    b.initial.q_WB = rotation_by(3 * vector());
    b.initial.w_WB = spin * vector();
    s.bodies.push_back(b);
  }
  return s;
}

void expect_the_simulators_result(const Scenario& scenario, double dt, std::size_t steps) {
  const Scheme scheme{Integrator::kSemiImplicitEuler};
  Simulator readable(scenario, scheme);
  FreeBodies fast(scenario.bodies, scenario.gravity);
  for (std::size_t k = 0; k < steps; ++k) readable.step(dt);
  fast.step(dt, steps);
  std::vector<BodyState> states(fast.size());
  fast.read(states);
  // Each step rounds a dozen operations; angular velocities feed on themselves, at a rate of |w| <= 2 spin h per step,
  // so their errors grow by at most e^(|w| t), and angles by the time as much. 16 eps a step covers both sides.
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState &a = states[i], &b = readable.states()[i];
    const double turned = scenario.bodies[i].initial.w_WB.norm() * dt * static_cast<double>(steps);
    const double rounding = 16 * kEps * static_cast<double>(steps) * std::exp(turned);
    EXPECT_LT((a.p_WB - b.p_WB).norm(), rounding * (1 + a.p_WB.norm()));
    EXPECT_LT((a.v_WB - b.v_WB).norm(), rounding * (1 + a.v_WB.norm()));
    EXPECT_LT((a.w_WB - b.w_WB).norm(), rounding * b.w_WB.norm());
    EXPECT_LT(geodesic_angle(a.q_WB, b.q_WB), rounding * (1 + turned));
    EXPECT_NEAR(a.q_WB.norm(), 1, 2 * kEps);
  }
}

TEST(FreeBodies, GivesTheSimulatorsResult) { expect_the_simulators_result(swarm(300, 2), 1.0 / 240, 240); }

// Half angles of up to 1.7 rad a step, far beyond the series.
TEST(FreeBodies, TurnsByLargeAnglesToo) { expect_the_simulators_result(swarm(19, 20), 0.1, 1); }

TEST(FreeBodies, ManyStepsAtOnceAreTheSameBitsAsOneByOne) {
  const Scenario s = swarm(777, 3);
  FreeBodies one_by_one(s.bodies, s.gravity), at_once(s.bodies, s.gravity);
  for (int k = 0; k < 50; ++k) one_by_one.step(0.01);
  at_once.step(0.01, 50);
  std::vector<BodyState> a(s.bodies.size()), b(s.bodies.size());
  one_by_one.read(a);
  at_once.read(b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].p_WB, b[i].p_WB);
    EXPECT_EQ(a[i].q_WB.coeffs(), b[i].q_WB.coeffs());
  }
}

TEST(FreeBodies, KeepsNanWithItsBody) {
  Scenario s = swarm(9, 20);
  s.bodies[4].initial.w_WB.x() = std::nan("");
  FreeBodies flight(s.bodies, s.gravity);
  flight.step(0.1, 3);
  std::vector<BodyState> states(9);
  flight.read(states);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(is_finite(states[i]), i != 4);
}

TEST(FreeBodies, RefusesWhatCannotFly) {
  Scenario s = swarm(2, 1);
  FreeBodies flight(s.bodies, s.gravity);
  std::vector<BodyState> too_few(1);
  EXPECT_THROW(flight.read(too_few), std::invalid_argument);
  EXPECT_THROW(flight.step(0), std::invalid_argument);
  s.bodies[1].inertia.y() = 0;
  EXPECT_THROW(FreeBodies(s.bodies, s.gravity), std::invalid_argument);
  EXPECT_EQ(FreeBodies({}, Vec3::Zero()).size(), 0u);
}

}  // namespace
}  // namespace plumbline
