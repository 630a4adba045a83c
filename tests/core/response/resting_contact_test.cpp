// Contact that lasts: lying, coming to rest, sliding, rolling.
#include <gtest/gtest.h>

#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum ImpactRule;

constexpr Integrator kAll[] = {kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet};

const BodyState& last(const Trajectory& t) { return t.at(t.samples() - 1, 1); }

// Impulses are iterated to 1e-14 of g dt; over 600 steps such residues of 2e-15 m/s add up to at most 2e-14 m, and
// levers of a box turn them into angles of the same size. 1e-12 leaves room for the rounding of each step.
TEST(RestingContact, KeepsABoxWhereItLies) {
  const Vec3 start(0.3, -0.2, 0.25);
  for (const double mu : {0.0, 0.5}) {
    for (const double e : {0.0, 0.8}) {
      const Scenario s = on_ground(solid("box", Box{Vec3(1, 2, 0.5)}, 3, start, Vec3::Zero()), e, mu, 10);
      for (const Scheme& scheme : candidate_schemes(s)) {
        const Trajectory path = simulate(s, scheme, 1.0 / 60);
        for (std::size_t k = 0; k < path.samples(); ++k) {
          ASSERT_LT((path.at(k, 1).p_WB - start).norm(), 1e-12) << name(scheme) << " mu " << mu << " e " << e;
          ASSERT_LT(geodesic_angle(path.at(k, 1).q_WB, Quat::Identity()), 1e-12) << name(scheme);
        }
      }
    }
  }
}

TEST(RestingContact, LetsABouncingBallComeToRest) {
  // The last bounce is over after t0 (1+e)/(1-e) = 5.75 s; afterwards at most a hop of a few dt.
  const Scenario s = on_ground(ball("ball", 0.25, 1, Vec3(0, 0, 2.25), Vec3::Zero()), 0.8, 0, 10);
  for (const Integrator integrator : kAll) {
    const Trajectory path = simulate(s, {integrator, kExactTime}, 1.0 / 240);
    for (std::size_t k = path.samples() * 7 / 10; k < path.samples(); ++k) {
      ASSERT_NEAR(path.at(k, 1).p_WB.z(), 0.25, 1e-12) << name({integrator, kExactTime});
    }
  }
}

TEST(RestingContact, LetsADroppedBoxRestAtHalfItsHeight) {
  const Scenario s = on_ground(solid("box", Box{Vec3(1, 1, 1)}, 1, Vec3(0, 0, 1.237), Vec3::Zero()), 0, 0.5, 3);
  for (const Integrator integrator : kAll) {
    const BodyState end = last(simulate(s, {integrator, kExactTime}, 1.0 / 60));
    EXPECT_NEAR(end.p_WB.z(), 0.5, 1e-12);
    EXPECT_LT(end.v_WB.norm() + end.w_WB.norm(), 1e-12);
  }
}

// Slides to a halt under mu g: v0^2/(2 mu g) in v0/(mu g). The stopping step is where schemes differ: by at most
// mu g dt in speed over dt, and the Euler schemes by v0 dt/2 on the way.
TEST(RestingContact, BrakesASlidingBoxByCoulombsLaw) {
  const double mu = 0.3, v0 = 2, dt = 1.0 / 240, path_length = v0 * v0 / (2 * mu * kG);
  const Scenario s =
      on_ground(solid("box", Box{Vec3(1, 1, 0.2)}, 2, Vec3(0, 0, 0.1), Vec3(v0 * 0.6, v0 * 0.8, 0)), 0, mu, 2);
  for (const Integrator integrator : kAll) {
    const BodyState end = last(simulate(s, {integrator, kExactTime}, dt));
    const double sign = integrator == kSemiImplicitEuler ? -1 : integrator == kExplicitEuler ? 1 : 0;
    EXPECT_NEAR(end.p_WB.head<2>().norm(), path_length + sign * v0 * dt / 2, mu * kG * dt * dt);
    EXPECT_NEAR(end.p_WB.y() / end.p_WB.x(), 0.8 / 0.6, 1e-10);  // straight on: the cone is round
    EXPECT_LT(end.v_WB.norm(), integrator == kExplicitEuler ? 1e-10 : 1e-12);
    EXPECT_NEAR(end.p_WB.z(), 0.1, 1e-12);
  }
}

TEST(RestingContact, TurnsSlidingIntoRollingAtFiveSeventhsOfTheSpeed) {
  const double mu = 0.2, v0 = 3;
  const Scenario s = on_ground(ball("ball", 0.5, 2, Vec3(0, 0, 0.5), Vec3(v0, 0, 0)), 0.5, mu, 2);
  for (const Integrator integrator : kAll) {
    const BodyState end = last(simulate(s, {integrator, kExactTime}, 1.0 / 100));
    // Angular momentum about the line of contact is kept by every scheme, so only rounding of 200 steps is left.
    EXPECT_NEAR(end.v_WB.x(), 5.0 / 7 * v0, 1e-12);
    EXPECT_NEAR(end.w_WB.y() * 0.5, 5.0 / 7 * v0, 1e-12);
  }
}

// On a slope of 20 degrees: sticks for mu = 0.5 > tan 20, slides with g (sin - mu cos) for mu = 0.2.
TEST(RestingContact, SticksOrSlidesOnASlope) {
  const double slope = 20 * std::acos(-1.0) / 180, duration = 2, dt = 1.0 / 100;
  const Quat tilt = rotation_by(Vec3(0, slope, 0));  // downhill is +x of the slope
  for (const double mu : {0.2, 0.5}) {
    Scenario s =
        on_ground(solid("box", Box{Vec3(0.4, 0.3, 0.2)}, 1, tilt * Vec3(0, 0, 0.1), Vec3::Zero()), 0, mu, duration);
    s.bodies[0].shape = HalfSpace{tilt * Vec3::UnitZ()};
    s.bodies[1].initial.q_WB = tilt;
    const double a = mu > 0.3 ? 0 : kG * (std::sin(slope) - mu * std::cos(slope));
    for (const Integrator integrator : kAll) {
      const BodyState end = last(simulate(s, {integrator, kExactTime}, dt));
      const Vec3 moved = tilt.conjugate() * end.p_WB - Vec3(0, 0, 0.1);
      const double sign = integrator == kSemiImplicitEuler ? 1 : integrator == kExplicitEuler ? -1 : 0;
      EXPECT_NEAR(moved.x(), a * duration * duration / 2 + sign * a * duration * dt / 2, 1e-11) << mu;
      EXPECT_NEAR(moved.y(), 0, 1e-11);
      EXPECT_NEAR(moved.z(), 0, 1e-11);
    }
  }
}

}  // namespace
}  // namespace plumbline
