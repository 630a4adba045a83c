// Coulomb's friction over time, against its closed forms: thresholds found by bisection, stopping, rolling.
#include <gtest/gtest.h>

#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum ImpactRule;

// The body lies on a slope that falls towards +x of the slope's own axes.
Scenario on_slope(Body body, double angle, double friction, double duration) {
  const Quat tilt = rotation_by(Vec3(0, angle, 0));
  Scenario s = on_ground(std::move(body), 0, friction, duration);
  s.bodies[0].shape = HalfSpace{tilt * Vec3::UnitZ()};
  s.bodies[1].initial.p_WB = tilt * s.bodies[1].initial.p_WB;
  s.bodies[1].initial.q_WB = tilt;
  return s;
}

double distance_down(const Scenario& s, double angle, double dt, Integrator integrator = kSemiImplicitEuler,
                     Leaps leaps = Leaps::kAllowed) {
  SimulatorOptions options;
  options.leaps = leaps;
  const Trajectory path = simulate(s, {integrator, kExactTime}, dt, options);
  const std::size_t end = path.samples() - 1;
  return (rotation_by(Vec3(0, angle, 0)).conjugate() * (path.at(end, 1).p_WB - path.at(0, 1).p_WB)).x();
}

// Half a second at an angle d too steep slides g d / cos(atan mu) / 8 m or more. What counts as sliding is 1e-11 m,
// a hundred times what a resting box drifts. The leaps hold a grip up to 1e-10 of it (kShare in impulse_equations.cpp),
// and the angle turns the load by that times 1 + mu^2 <= 50: within 1e-8 rad creeping and sliding are not told apart.
TEST(FrictionLaw, LetsABoxSlideBeyondTheAngleOfFriction) {
  for (const double mu : {0.1, 0.3, 0.6, 1.0, 7.0}) {
    double sticks = 0, slides = 1.55;
    while (slides - sticks > 1e-11) {
      const double angle = 0.5 * (sticks + slides);
      // Flat enough not to topple: its width over its height is 10.
      const Body box = solid("box", Box{Vec3(1, 1, 0.1)}, 1, Vec3(0, 0, 0.05), Vec3::Zero());
      (distance_down(on_slope(box, angle, mu, 0.5), angle, 0.05) > 1e-11 ? slides : sticks) = angle;
    }
    EXPECT_NEAR(slides, std::atan(mu), 1e-8) << mu;
  }
}

// What the leaps are for: sweeps alone are cut off after 1000 and let the box creep before the angle is reached.
TEST(FrictionLaw, LetsABoxCreepNearTheAngleOfFrictionWithSweepsAlone) {
  const double angle = std::atan(0.6) - 1e-4;
  const Scenario s = on_slope(solid("box", Box{Vec3(1, 1, 0.1)}, 1, Vec3(0, 0, 0.05), Vec3::Zero()), angle, 0.6, 0.5);
  EXPECT_GT(distance_down(s, angle, 0.05, kSemiImplicitEuler, Leaps::kNever), 1e-6);
  EXPECT_LT(distance_down(s, angle, 0.05, kSemiImplicitEuler, Leaps::kAllowed), 1e-13);
}

// v0^2 / (2 mu g): the distance is off by v0 dt/2, less on the last step. First order, as the scheme is.
TEST(FrictionLaw, StopsASlidingBoxToFirstOrderInTheStep) {
  const double mu = 0.3, v0 = 2, exact = v0 * v0 / (2 * mu * kG);
  double errors[4];
  for (int k = 0; k < 4; ++k) {
    const double dt = std::ldexp(1.0 / 50, -2 * k);
    const Scenario s = on_ground(solid("box", Box{Vec3(1, 1, 0.2)}, 2, Vec3(0, 0, 0.1), Vec3(v0, 0, 0)), 0, mu, 1);
    const Trajectory path = simulate(s, {}, dt);
    errors[k] = std::abs(path.at(path.samples() - 1, 1).p_WB.x() - exact);
    EXPECT_NEAR(errors[k], v0 * dt / 2, mu * kG * dt * dt / 8 * 1.01);  // the worst phase of the last step
  }
  for (int k = 0; k < 3; ++k) {
    const double order = std::log2(errors[k] / errors[k + 1]) / 2;
    EXPECT_NEAR(order, 1, 0.05) << k;
    RecordProperty("order" + std::to_string(k), std::to_string(order));
  }
}

// v0 = 2 m/s, mu = 0.3: rolling begins at t* = 2 v0 / (7 mu g), at 12 v0^2 / (49 mu g), with 5/7 v0.
TEST(FrictionLaw, TurnsSlidingIntoRollingAtItsTime) {
  const double mu = 0.3, v0 = 2, begins = 2 * v0 / (7 * mu * kG), slid = 12 * v0 * v0 / (49 * mu * kG),
               rolls = 5.0 / 7 * v0;
  EXPECT_NEAR(begins, 0.194165332, 5e-10);
  EXPECT_NEAR(slid, 0.332854854, 5e-10);
  const double duration = 0.5, exact = slid + rolls * (duration - begins);
  const Scenario s = on_ground(ball("ball", 0.1, 1, Vec3(0, 0, 0.1), Vec3(v0, 0, 0)), 0, mu, duration);
  double errors[4];
  for (int k = 0; k < 4; ++k) {
    const double dt = std::ldexp(1.0 / 50, -2 * k);
    const Trajectory path = simulate(s, {}, dt);
    const BodyState& end = path.at(path.samples() - 1, 1);
    EXPECT_NEAR(end.v_WB.x(), rolls, 1e-13);
    EXPECT_NEAR(end.w_WB.y() * 0.1, rolls, 1e-13);
    std::size_t first = 0;
    while (path.at(first, 1).v_WB.x() - 0.1 * path.at(first, 1).w_WB.y() > 1e-12) ++first;
    EXPECT_NEAR(path.time(first), begins, dt);
    errors[k] = std::abs(end.p_WB.x() - exact);
    // Verlet is exact while it slides and while it rolls; within the one step between, speed is off by 2/7 of what
    // slides at most: (2/7)(7/2) mu g dt, over dt.
    const Trajectory verlet = simulate(s, {kVelocityVerlet, kExactTime}, dt);
    EXPECT_NEAR(verlet.at(verlet.samples() - 1, 1).p_WB.x(), exact, mu * kG * dt * dt);
  }
  for (int k = 0; k < 3; ++k) {
    const double order = std::log2(errors[k] / errors[k + 1]) / 2;
    EXPECT_NEAR(order, 1, 0.05) << k;
    RecordProperty("order" + std::to_string(k), std::to_string(order));
  }
}

// A sphere rolls without slip iff mu >= 2/7 tan(angle): 5/7 g sin; else it slides with g (sin - mu cos). Both are
// constant, so that semi-implicit Euler is off by a T dt/2 exactly.
TEST(FrictionLaw, LetsASphereRollDownASlope) {
  const double duration = 1, dt = 0.01, angle = 0.5;
  for (const double mu : {0.05, 2.0 / 7 * std::tan(angle) - 1e-6, 2.0 / 7 * std::tan(angle) + 1e-6, 0.8}) {
    const bool rolls = mu >= 2.0 / 7 * std::tan(angle);
    const double a = kG * (rolls ? 5.0 / 7 * std::sin(angle) : std::sin(angle) - mu * std::cos(angle));
    const Scenario s = on_slope(ball("ball", 0.2, 3, Vec3(0, 0, 0.2), Vec3::Zero()), angle, mu, duration);
    const double down = distance_down(s, angle, dt);
    EXPECT_NEAR(down, 0.5 * a * duration * (duration + dt), 1e-12 * 10) << mu;
    EXPECT_NEAR(distance_down(s, angle, dt, kVelocityVerlet), 0.5 * a * duration * duration, 1e-12 * 10) << mu;
  }
}

// A box that slides upon a box: friction drags the lower one along on its smooth ground until both go together.
TEST(FrictionLaw, SharesTheMomentumOfABoxThatSlidesUponABox) {
  const double mu = 0.4, v0 = 1.5, dt = 1.0 / 200;
  Scenario s = on_ground(solid("sledge", Box{Vec3(4, 1, 0.2)}, 3, Vec3(0, 0, 0.1), Vec3::Zero()), 0, mu, 1);
  s.bodies.push_back(solid("load", Box{Vec3(0.5, 0.5, 0.1)}, 1, Vec3(-1, 0, 0.25), Vec3(v0, 0, 0)));
  // On ground with the same mu the sledge would stick (friction on it is mu m g, on the ground up to mu (m + M) g):
  // the load slides as on fixed ground.
  const Trajectory path = simulate(s, {}, dt);
  const std::size_t end = path.samples() - 1;
  EXPECT_LT((path.at(end, 1).p_WB - Vec3(0, 0, 0.1)).norm(), 1e-11);
  EXPECT_NEAR(path.at(end, 2).p_WB.x() + 1, v0 * v0 / (2 * mu * kG) - v0 * dt / 2, mu * kG * dt * dt);
  // Floating free, without gravity but pressed by a force on the load: momentum is shared, v0 m / (m + M).
  s.bodies[0].initial.p_WB.z() = -1;  // out of the way
  s.gravity = Vec3::Zero();
  const double press = 4;
  s.forces = {{2,
               [press](double, const BodyState&) {
                 return Wrench{Vec3(0, 0, -press), Vec3::Zero()};
               },
               false, false, ""},
              {1,
               [press](double, const BodyState&) {
                 return Wrench{Vec3(0, 0, press), Vec3::Zero()};
               },
               false, false, ""}};
  s.bodies[1].inertia *= 1e9;  // so that the couple of the two forces does not turn it
  s.bodies[2].inertia *= 1e9;
  s.duration = 1.5;
  const Trajectory free = simulate(s, {}, dt);
  const std::size_t last = free.samples() - 1;
  EXPECT_NEAR(free.at(last, 1).v_WB.x(), v0 / 4, 1e-9);
  EXPECT_NEAR(free.at(last, 2).v_WB.x(), v0 / 4, 1e-9);
}

}  // namespace
}  // namespace plumbline
