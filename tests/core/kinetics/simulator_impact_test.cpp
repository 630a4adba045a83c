// Impacts inside a run: exact times, their order, and what time-stepping engines make of them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinetic_scenes.hpp"
#include "plumbline/core/event_time.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum ImpactRule;

constexpr Integrator kAll[] = {kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet};

Scenario spheres(std::initializer_list<Body> bodies, double restitution, double friction, double duration) {
  Scenario s;
  s.id = "test/spheres";
  s.bodies = bodies;
  s.contact = ContactMaterial{restitution, friction};
  s.duration = duration;
  return s;
}

// Without gravity every scheme moves along straight lines, so that exact impacts make the whole run exact.
TEST(ExactImpacts, OfTwoSpheresHeadOnGiveTheClosedForm) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const Scenario s =
        spheres({ball("a", 0.5, 1, Vec3(-2, 0, 0), Vec3(3, 0, 0)), ball("b", 0.5, 2, Vec3(1, 0, 0), Vec3(-1, 0, 0))}, e,
                0.3, 1);
    const double hit = 2.0 / 4, va = (3 - 2 - e * 2 * 4) / 3.0, vb = (3 - 2 + e * 1 * 4) / 3.0;
    for (const Integrator integrator : kAll) {
      const Trajectory path = simulate(s, {integrator, kExactTime}, 0.07);
      for (std::size_t k = 0; k < path.samples(); ++k) {
        const double t = path.time(k);
        EXPECT_NEAR(path.at(k, 0).p_WB.x(), t < hit ? -2 + 3 * t : -0.5 + va * (t - hit), 1e-12);
        EXPECT_NEAR(path.at(k, 1).p_WB.x(), t < hit ? 1 - t : 0.5 + vb * (t - hit), 1e-12);
      }
    }
  }
}

TEST(ExactImpacts, OfObliqueSpheresGiveTheClosedForm) {
  // Equal balls of diameter 1, impact parameter 0.6: n = (0.8, 0.6) at the impact, after 2.2/4 s. With e = 1 they
  // exchange their velocities along n: 4 n.x n = (2.56, 1.92).
  const Scenario s = spheres(
      {ball("a", 0.5, 1, Vec3(-3, 0, 0), Vec3(4, 0, 0)), ball("b", 0.5, 1, Vec3(0, 0.6, 0), Vec3::Zero())}, 1, 0, 1);
  const Trajectory path = simulate(s, {kSemiImplicitEuler, kExactTime}, 0.04);
  const double after = 1 - 2.2 / 4;
  const std::size_t end = path.samples() - 1;
  EXPECT_LT((path.at(end, 1).p_WB - (Vec3(0, 0.6, 0) + after * Vec3(2.56, 1.92, 0))).norm(), 1e-12);
  EXPECT_LT((path.at(end, 0).p_WB - (Vec3(-0.8, 0, 0) + after * Vec3(1.44, -1.92, 0))).norm(), 1e-12);
}

TEST(ExactImpacts, AreTakenInTheOrderOfTimeAndComputedAnew) {
  // Within one step a hits b, and only because of that b hits c: neither pair of the second impact collides on the
  // path it has at the start. Listed last first, so that the order of bodies cannot help.
  const Scenario s =
      spheres({ball("c", 0.5, 1, Vec3(3.5, 0, 0), Vec3::Zero()), ball("b", 0.5, 1, Vec3(2, 0, 0), Vec3::Zero()),
               ball("a", 0.5, 1, Vec3(0, 0, 0), Vec3(10, 0, 0))},
              1, 0, 1);
  const Trajectory path = simulate(s, {kSemiImplicitEuler, kExactTime}, 1);
  // a stops at 1 after 0.1 s, b at 2.5 after 0.05 s more, and c has 0.85 s left.
  EXPECT_NEAR(path.at(1, 2).p_WB.x(), 1, 1e-12);
  EXPECT_NEAR(path.at(1, 1).p_WB.x(), 2.5, 1e-12);
  EXPECT_NEAR(path.at(1, 0).p_WB.x(), 3.5 + 8.5, 1e-12);
}

// Verlet moves along the true parabola, and the time of impact is found on it: bounces are exact at any dt.
TEST(ExactImpacts, MakeAVerletBounceExact) {
  const double e = 0.8, radius = 0.25, height = 2;  // of the ball's lowest point
  const Scenario s = on_ground(ball("ball", radius, 1, Vec3(0, 0, radius + height), Vec3::Zero()), e, 0, 2.5);
  for (const double dt : {1.0 / 17, 1.0 / 60, 1.0 / 240}) {
    const Trajectory path = simulate(s, {kVelocityVerlet, kExactTime}, dt);
    for (std::size_t k = 0; k < path.samples(); ++k) {
      double t = path.time(k), since = std::sqrt(2 * height / kG), speed = std::sqrt(2 * kG * height);
      double z = height - kG * t * t / 2;
      for (t -= since; t > 0; t -= since) {  // flight after flight
        speed *= e;
        since = 2 * speed / kG;
        z = speed * t - kG * t * t / 2;
      }
      EXPECT_NEAR(path.at(k, 1).p_WB.z(), radius + z, 1e-12) << "dt " << dt << ", sample " << k;
    }
  }
}

TEST(ExactImpacts, OfABoxThatLandsFlatAreExactForVerlet) {
  const Scenario s = on_ground(solid("box", Box{Vec3(1, 2, 0.5)}, 3, Vec3(0, 0, 1.25), Vec3(0.3, 0, 0)), 0.5, 0, 0.8);
  const Trajectory path = simulate(s, {kVelocityVerlet, kExactTime}, 1.0 / 37);
  const double hit = std::sqrt(2 / kG), rest = path.time(path.samples() - 1) - hit;
  const double z = 0.25 + 0.5 * kG * hit * rest - kG * rest * rest / 2;
  EXPECT_NEAR(path.at(path.samples() - 1, 1).p_WB.z(), z, 1e-12);
  EXPECT_LT(path.at(path.samples() - 1, 1).w_WB.norm(), 1e-12);
}

TEST(ExactImpacts, OfATumblingBoxNeverSinkDeeperThanOneStepBends) {
  Scenario s = on_ground(solid("box", Box{Vec3(1, 0.6, 0.4)}, 2, Vec3(0, 0, 2), Vec3(2, 0, 0)), 0.3, 0.4, 4);
  s.bodies[1].initial.w_WB = Vec3(1, 2, 0.5);
  for (const Integrator integrator : kAll) {
    for (const double dt : {1.0 / 60, 1.0 / 240}) {
      const Trajectory path = simulate(s, {integrator, kExactTime}, dt);
      double lowest = 0, fastest = 0;
      for (std::size_t k = 0; k < path.samples(); ++k) {
        fastest = std::max(fastest, path.at(k, 1).w_WB.norm());
        for (const Contact& c : box_half_space_contacts(path.at(k, 1), Vec3(1, 0.6, 0.4), BodyState{}, Vec3::UnitZ())) {
          lowest = std::min(lowest, c.gap);
        }
      }
      // A corner that rests while the box turns about it leaves its straight line by w^2 r dt^2/2 in a step.
      const double arm = 0.5 * Vec3(1, 0.6, 0.4).norm();
      EXPECT_GT(lowest, -fastest * fastest * arm * dt * dt / 2);
      EXPECT_NEAR(path.at(path.samples() - 1, 1).p_WB.z(), 0.2, 1e-5);  // lies on its largest face
    }
  }
}

TEST(ExactImpacts, BeyondTheirNumberAreAnError) {
  // Between a floor and a lid 1 cm apart, at 100 m/s: 166 impacts in a step of 1/60 s.
  Scenario s = on_ground(ball("ball", 0.5, 1, Vec3(0, 0, 0.505), Vec3(0, 0, -100)), 1, 0, 1);
  s.gravity = Vec3::Zero();
  s.bodies.push_back(ground());
  s.bodies[2].shape = HalfSpace{-Vec3::UnitZ()};
  s.bodies[2].initial.p_WB.z() = 1.01;
  try {
    simulate(s, {}, 1.0 / 60);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("more than 100 impacts"), std::string::npos) << e.what();
  }
  SimulatorOptions more;
  more.max_events_per_step = 200;
  EXPECT_NO_THROW(simulate(s, {}, 1.0 / 60, more));
}

// Mean square energy error of 49 balls of 10 kg side by side that fall from 5 m with e = 1 for 20 s at 1 ms, sampled
// as the SimBenchmark project does. It publishes 75245.4 J^2 for an engine that reflects the velocity after gravity,
// and 185.027 J^2 for one that reflects the velocity before it.
double mean_square_energy_error(ImpactRule impact) {
  const Scenario s = on_ground(ball("ball", 0.1, 10, Vec3(0, 0, 5), Vec3::Zero()), 1, 0, 20);
  const Trajectory path = simulate(s, {kSemiImplicitEuler, impact}, 1e-3);
  const std::size_t samples = path.samples() - 1;
  double sum = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double error = energy(s, path.states().subspan(2 * k, 2)) - 10 * kG * 5;
    sum += 49 * error * 49 * error;  // all balls move alike
  }
  return sum / static_cast<double>(samples);
}

TEST(StepStartImpacts, ReproduceThePublishedErrorsOfTwoEngines) {
  EXPECT_NEAR(mean_square_energy_error(kStepStart), 75245.4, 0.05);  // half of the last printed digit
  EXPECT_NEAR(mean_square_energy_error(kStepStartBeforeForces), 185.027, 0.0005);
}

TEST(StepStartImpacts, AreNoticedOneStepLate) {
  // 0.25 m to go at 1 m/s with steps of 0.1 s: overlapping at 0.3, so the step from 0.3 is the first with v = +1.
  Scenario s = on_ground(ball("ball", 0.5, 1, Vec3(0, 0, 0.75), Vec3(0, 0, -1)), 1, 0, 0.5);
  s.gravity = Vec3::Zero();
  const Trajectory path = simulate(s, {kSemiImplicitEuler, kStepStart}, 0.1);
  EXPECT_NEAR(path.at(3, 1).p_WB.z(), 0.45, 1e-14);
  EXPECT_NEAR(path.at(3, 1).v_WB.z(), -1, 1e-14);
  EXPECT_NEAR(path.at(4, 1).p_WB.z(), 0.55, 1e-14);
  EXPECT_NEAR(path.at(4, 1).v_WB.z(), 1, 1e-14);
}

}  // namespace
}  // namespace plumbline
