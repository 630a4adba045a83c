// What each integrator does between impacts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "kinetic_scenes.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr Integrator kAll[] = {kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet};

const BodyState& last(const Trajectory& t) { return t.at(t.samples() - 1, 0); }

// m x'' = -k x with m = 1 kg: a unit oscillator of angular frequency sqrt(k).
Scenario spring(double k, double x0, double v0, double duration) {
  Scenario s = free_flight(ball("bob", 0.1, 1, Vec3(x0, 0, 0), Vec3(v0, 0, 0)), Vec3::Zero(), duration);
  s.forces.push_back({0,
                      [k](double, const BodyState& b) {
                        return Wrench{Vec3(-k * b.p_WB.x(), 0, 0), Vec3::Zero()};
                      },
                      false, false, ""});
  return s;
}

TEST(Integrator, ErrsAboutTheParabolaByHalfAStepOfFall) {
  const double dt = 0.02, duration = 2;
  const Scenario s = free_flight(ball("b", 1, 3, Vec3(0, 0, 5), Vec3(2, 0, -1)), Vec3(0, 0, -kG), duration);
  for (const Scheme& scheme : candidate_schemes(s)) {
    const Trajectory path = simulate(s, scheme, dt);
    ASSERT_EQ(path.samples(), 101u);
    const double factor = scheme.integrator == kSemiImplicitEuler ? -1 : scheme.integrator == kExplicitEuler ? 1 : 0;
    for (std::size_t k = 0; k < path.samples(); ++k) {
      const double t = path.time(k);
      // Each step rounds a position and a velocity of at most 24 m (m/s); velocity errors add up over the time.
      const double rounding = 4 * kEps * 24 * static_cast<double>(k + 1);
      EXPECT_NEAR(path.at(k, 0).p_WB.z() - (5 - t - kG * t * t / 2), factor * kG * t * dt / 2, rounding)
          << name(scheme);
      EXPECT_NEAR(path.at(k, 0).v_WB.z(), -1 - kG * t, rounding) << name(scheme);
      EXPECT_NEAR(path.at(k, 0).p_WB.x(), 2 * t, rounding) << name(scheme);
    }
  }
}

TEST(Integrator, HasFirstOrderOnDrag) {
  // v' = (T - c v)/m from rest. The error of order one has a second-order part of relative size dt c/m: the observed
  // order may differ from 1 by about that, 0.0025.
  const double m = 1000, thrust = 5000, c = 250, duration = 10, dt = 0.01;
  const double exact = thrust / c * duration + thrust / c * (m / c) * (std::exp(-c * duration / m) - 1);
  Scenario s = free_flight(ball("ship", 1, m, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), duration);
  s.forces.push_back({0,
                      [=](double, const BodyState& b) {
                        return Wrench{Vec3(thrust - c * b.v_WB.x(), 0, 0), Vec3::Zero()};
                      },
                      false, false, ""});
  for (const Integrator integrator : {kSemiImplicitEuler, kExplicitEuler}) {
    const double coarse = last(simulate(s, {integrator}, dt)).p_WB.x() - exact;
    const double fine = last(simulate(s, {integrator}, dt / 2)).p_WB.x() - exact;
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.0025);
  }
}

// One step is a linear map of (x, v). Its determinant, the growth of areas, tells the schemes apart:
// semi-implicit [1-kh^2, h; -kh, 1] has 1, explicit [1, h; -kh, 1] has 1 + kh^2, and Verlet with the force held,
// [1-kh^2/2, h; -kh, 1], has 1 + kh^2/2: half of explicit Euler's growth, so first order only. A second-order
// Verlet would need the force at the end of the step, which an engine is not given.
TEST(Integrator, GrowsAreasOfAnOscillatorAsItsMapSays) {
  const double k = 4, h = 0.05;
  const std::size_t steps = 40;
  const double duration = h * static_cast<double>(steps);
  for (const Integrator integrator : kAll) {
    const BodyState a = last(simulate(spring(k, 1, 0, duration), {integrator}, h));
    const BodyState b = last(simulate(spring(k, 0, 1, duration), {integrator}, h));
    const double area = a.p_WB.x() * b.v_WB.x() - a.v_WB.x() * b.p_WB.x();
    const double excess = integrator == kSemiImplicitEuler ? 0
                          : integrator == kExplicitEuler   ? k * h * h
                                                           : k * h * h / 2;
    const double grown = std::pow(1 + excess, static_cast<double>(steps));
    EXPECT_NEAR(area, grown, 8 * kEps * static_cast<double>(steps) * grown * 4);
  }
}

TEST(Integrator, VerletIsExactForAConstantForceAndHasFirstOrderForAGrowingOne) {
  // f = b t held over each step: v_n = b dt^2 n(n-1)/2, late by b t dt/2.
  const double b = 3, dt = 0.1;
  Scenario s = free_flight(ball("b", 1, 1, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), 2);
  s.forces.push_back({0,
                      [=](double t, const BodyState&) {
                        return Wrench{Vec3(b * t, 0, 0), Vec3::Zero()};
                      },
                      false, false, ""});
  const Trajectory path = simulate(s, {kVelocityVerlet}, dt);
  EXPECT_NEAR(last(path).v_WB.x() - b * 2 * 2 / 2, -b * 2 * dt / 2, 64 * kEps * 6);
}

TEST(Integrator, SpinsAboutAPrincipalAxisExactly) {
  Body box = solid("box", Box{Vec3(0.1, 0.4, 0.9)}, 10, Vec3::Zero(), Vec3::Zero());
  box.initial.w_WB = Vec3(0, 0, 1.3);
  const Scenario s = free_flight(box, Vec3::Zero(), 3);
  for (const Integrator integrator : kAll) {
    const Trajectory path = simulate(s, {integrator}, 0.01);
    // 300 products of quaternions, a few roundings each.
    EXPECT_NEAR(geodesic_angle(last(path).q_WB, rotation_by(Vec3(0, 0, 3 * 1.3))), 0, 300 * 8 * kEps);
    EXPECT_LT((last(path).w_WB - Vec3(0, 0, 1.3)).norm(), 300 * 4 * kEps);
  }
}

TEST(Integrator, TurnsByAConstantTorqueLikeItFalls) {
  // w = tau t/I; the angle tau t^2/(2I) is met by Verlet and missed by +-tau t dt/(2I) by the Euler schemes.
  Scenario s = free_flight(ball("b", 0.5, 2, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), 1);
  s.forces.push_back({0,
                      [](double, const BodyState&) {
                        return Wrench{Vec3::Zero(), Vec3(0, 0.2, 0)};
                      },
                      false, true, ""});
  const double alpha = 0.2 / (0.4 * 2 * 0.25), dt = 0.01;
  for (const Integrator integrator : kAll) {
    const BodyState end = last(simulate(s, {integrator}, dt));
    const double sign = integrator == kSemiImplicitEuler ? 1 : integrator == kExplicitEuler ? -1 : 0;
    EXPECT_NEAR(end.w_WB.y(), alpha, 100 * 4 * kEps);
    EXPECT_NEAR(2 * std::atan2(end.q_WB.y(), end.q_WB.w()), alpha / 2 + sign * alpha * dt / 2, 100 * 8 * kEps);
  }
}

double angular_momentum_drift(const Scenario& s, Integrator integrator, double dt) {
  const Trajectory path = simulate(s, {integrator}, dt);
  const Vec3 start = angular_momentum(s, path.states().first(1));
  double largest = 0;
  for (std::size_t k = 0; k < path.samples(); ++k) {
    largest = max_or_nan(largest, (angular_momentum(s, path.states().subspan(k, 1)) - start).norm() / start.norm());
  }
  return largest;
}

Scenario free_rotation(double duration) {
  Body box = solid("box", Box{Vec3(0.1, 0.4, 0.9)}, 10, Vec3::Zero(), Vec3::Zero());
  box.initial.w_WB = Vec3(0.1, 5, 0.1);
  return free_flight(box, Vec3::Zero(), duration);
}

TEST(Integrator, KeepsTheAngularMomentumOfATumblingBoxToFirstOrder) {
  const Scenario s = free_rotation(1);  // up to the first flip: behind it the unstable axis has multiplied the error
  for (const Integrator integrator : kAll) {
    const double coarse = angular_momentum_drift(s, integrator, 1e-3),
                 fine = angular_momentum_drift(s, integrator, 5e-4);
    // The next term of the error is smaller by dt times a rate, here the 5 rad/s of the motion times the tenfold by
    // which the unstable axis has grown after 1 s. Halving dt makes that an error of the order of rate dt/(2 ln 2).
    EXPECT_NEAR(std::log2(coarse / fine), 1, 50 * 1e-3 / (2 * std::log(2.0)));
  }
}

TEST(Integrator, KeepsNanForever) {
  Scenario s = on_ground(ball("ball", 0.5, 1, Vec3(0, 0, 3), Vec3::Zero()), 0.5, 0.5, 1);
  s.forces.push_back({1,
                      [](double t, const BodyState&) {
                        const double f = t > 0.29 && t < 0.31 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
                        return Wrench{Vec3(0, 0, f), Vec3::Zero()};
                      },
                      false, false, ""});
  for (const Scheme& scheme : candidate_schemes(s)) {
    const Trajectory path = simulate(s, scheme, 0.1);
    EXPECT_TRUE(is_finite(path.at(3, 1))) << name(scheme);
    for (std::size_t k = 4; k < path.samples(); ++k) EXPECT_FALSE(is_finite(path.at(k, 1))) << name(scheme);
  }
}

TEST(Integrator, GivesTheSameBitsTwice) {
  Scenario s = on_ground(solid("box", Box{Vec3(1, 0.6, 0.4)}, 2, Vec3(0, 0, 2), Vec3(1, 0.5, 0)), 0.4, 0.3, 2);
  s.bodies[1].initial.w_WB = Vec3(1, 2, 0.5);
  for (const Scheme& scheme : candidate_schemes(s)) {
    const Trajectory a = simulate(s, scheme, 1.0 / 60), b = simulate(s, scheme, 1.0 / 60);
    ASSERT_EQ(a.states().size(), b.states().size());
    EXPECT_EQ(std::memcmp(a.states().data(), b.states().data(), a.states().size_bytes()), 0) << name(scheme);
  }
}

TEST(Integrator, HoldsAWrenchForOneStepOnly) {
  Simulator simulator(free_flight(ball("b", 1, 2, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), 1), {});
  const Wrench push[] = {{Vec3(4, 0, 0), Vec3::Zero()}};
  simulator.apply(push);
  simulator.step(0.5);
  simulator.step(0.5);
  EXPECT_EQ(simulator.states()[0].v_WB, Vec3(1, 0, 0));
}

TEST(Integrator, RefusesWhatMakesNoSense) {
  Scenario s = free_flight(ball("feather", 1, 1, Vec3::Zero(), Vec3::Zero()), Vec3::Zero(), 1);
  Simulator simulator(s, {});
  EXPECT_THROW(simulator.step(0), std::invalid_argument);
  EXPECT_THROW(simulator.step(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(simulator.apply({}), std::invalid_argument);
  for (const double mass : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    s.bodies[0].mass = mass;
    try {
      Simulator refused(s, {});
      FAIL() << mass;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find("feather"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace plumbline
