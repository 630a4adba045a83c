// Where each integrator is stable, and what it keeps: energy, areas, the way back (slides 26, 30, 39).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "known_motions.hpp"
#include "plumbline/core/integration/explicit_euler.hpp"
#include "plumbline/core/integration/position_verlet.hpp"
#include "plumbline/core/integration/runge_kutta_4.hpp"
#include "plumbline/core/integration/semi_implicit_euler.hpp"
#include "plumbline/core/integration/stepper_table.hpp"
#include "plumbline/core/integration/velocity_verlet.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace testing;

constexpr double kEps = std::numeric_limits<double>::epsilon();

AccelerationField spring() { return oscillator(1).field; }  // w = 1 rad/s

AccelerationField damping() {  // v' = -v: 2 m/c = 2 s
  return [](double, std::span<const BodyState> s, std::span<Acceleration> a) { a[0] = {-s[0].v_WB, -s[0].w_WB}; };
}

// Largest |x|, |v| over so many steps from (1, 0).
double largest_swing(Stepper& stepper, double dt, int steps) {
  BodyState s;
  s.p_WB = Vec3(1, 0, 0);
  double largest = 0;
  for (int n = 0; n < steps; ++n) {
    stepper.step(spring(), n * dt, dt, {&s, 1});
    largest = max_or_nan(largest, std::max(std::abs(s.p_WB.x()), std::abs(s.v_WB.x())));
  }
  return largest;
}

double speed_left(Stepper& stepper, double dt, int steps) {
  BodyState s;
  s.v_WB = Vec3(1, 0, 0);
  s.w_WB = Vec3(0, 0, 1);
  s = run(stepper, damping(), s, dt, steps);
  EXPECT_NEAR(s.w_WB.z(), s.v_WB.x(), 1e-9 * std::abs(s.v_WB.x()));  // spin decays as speed does
  return std::abs(s.v_WB.x());
}

TEST(StepperStability, OfEulerOnDragEndsAtTwoMOverC) {
  // One step multiplies v by 1 - dt c/m: by -0.998 and -1.002 here.
  ExplicitEuler euler;
  SemiImplicitEuler semi_implicit;
  for (Stepper* stepper : {static_cast<Stepper*>(&euler), static_cast<Stepper*>(&semi_implicit)}) {
    EXPECT_NEAR(speed_left(*stepper, 2 * 0.999, 1000), std::pow(0.998, 1000), 1e-10) << stepper->name();
    EXPECT_NEAR(speed_left(*stepper, 2 * 1.001, 1000), std::pow(1.002, 1000), 1e-9) << stepper->name();
  }
}

TEST(StepperStability, OfRungeKutta4OnDragEndsWhereItsPolynomialSays) {
  // |R(z)| = 1 at z = -2.7852935634052817, the real root of z^3/24 + z^2/6 + z/2 + 1.
  const double z = 2.7852935634052817;
  EXPECT_NEAR(-z * z * z / 24 + z * z / 6 - z / 2 + 1, 0, 4 * kEps);
  RungeKutta4 rk4;
  EXPECT_LT(speed_left(rk4, z * 0.999, 2000), 0.1);
  EXPECT_GT(speed_left(rk4, z * 1.001, 2000), 10);
}

TEST(StepperStability, OfExplicitEulerOnASpringDoesNotExist) {
  for (const double dt : {0.5, 0.1, 0.01}) {
    ExplicitEuler euler;
    BodyState s;
    s.p_WB = Vec3(1, 0, 0);
    s = run(euler, spring(), s, dt, 1000);
    // Each step multiplies x^2 + v^2 by 1 + dt^2.
    const double grown = std::pow(1 + dt * dt, 1000);
    EXPECT_NEAR(s.p_WB.squaredNorm() + s.v_WB.squaredNorm(), grown, 1000 * 8 * kEps * grown);
  }
}

TEST(StepperStability, OfSymplecticSchemesOnASpringEndsAtTwo) {
  SemiImplicitEuler semi_implicit;
  PositionVerlet position_verlet;
  VelocityVerlet velocity_verlet;
  for (Stepper* stepper : {static_cast<Stepper*>(&semi_implicit), static_cast<Stepper*>(&position_verlet),
                           static_cast<Stepper*>(&velocity_verlet)}) {
    // Below, orbits are ellipses with axes up to 1/sqrt(1 - (dt/2)^2) = 22 times longer. Above, the larger root of
    // z + 1/z = 2 - dt^2 is about 1 + 2 sqrt(0.002) = 1.09 in size: 500 steps make e^43 of it.
    EXPECT_LT(largest_swing(*stepper, 2 * 0.999, 20000), 50) << stepper->name();
    stepper->restart();
    EXPECT_GT(largest_swing(*stepper, 2 * 1.001, 500), 1e12) << stepper->name();
  }
}

TEST(StepperStability, OfRungeKutta4OnASpringEndsAtTwoRootTwo) {
  // |R(iy)|^2 = 1 - y^6/72 + y^8/576 = 1 at y = 2 sqrt 2; 0.1 % beside it, +-0.0142 a step.
  const double limit = 2 * std::sqrt(2.0);
  RungeKutta4 rk4;
  BodyState s;
  s.p_WB = Vec3(1, 0, 0);
  EXPECT_LT(run(rk4, spring(), s, limit * 0.999, 2000).p_WB.norm(), 1e-4);
  EXPECT_GT(run(rk4, spring(), s, limit * 1.001, 2000).p_WB.norm(), 1e4);
}

// One step of a linear motion is a matrix on (x, v); its columns are the images of (1, 0) and (0, 1).
double determinant_of_step(Stepper& stepper, double dt) {
  BodyState a, b;
  a.p_WB = Vec3(1, 0, 0);
  b.v_WB = Vec3(1, 0, 0);
  stepper.step(spring(), 0, dt, {&a, 1});
  stepper.step(spring(), 0, dt, {&b, 1});
  return a.p_WB.x() * b.v_WB.x() - a.v_WB.x() * b.p_WB.x();
}

TEST(AreaInPhaseSpace, IsKeptByVerletAndSemiImplicitEulerOnly) {
  ExplicitEuler explicit_euler;
  SemiImplicitEuler semi_implicit;
  PositionVerlet position_verlet;
  VelocityVerlet velocity_verlet;
  RungeKutta4 rk4;
  for (const double h : {0.1, 0.5, 1.5}) {
    const double rounding = 16 * kEps;
    EXPECT_NEAR(determinant_of_step(semi_implicit, h), 1, rounding);
    EXPECT_NEAR(determinant_of_step(velocity_verlet, h), 1, rounding);
    EXPECT_NEAR(determinant_of_step(position_verlet, h), 1, rounding / h);  // its velocities are differences over h
    EXPECT_NEAR(determinant_of_step(explicit_euler, h), 1 + h * h, 4 * rounding);
    EXPECT_NEAR(determinant_of_step(rk4, h), 1 - std::pow(h, 6) / 72 + std::pow(h, 8) / 576, rounding);
  }
}

double pendulum_energy(const BodyState& s) { return 0.5 * s.v_WB.squaredNorm() - std::cos(s.p_WB.x()); }

struct Drift {
  double swing = 0;  // largest |E - E0|
  double end = 0;    // E - E0 at the end, the mean of the last tenth
};

Drift energy_drift(Stepper& stepper, double dt, int steps) {
  const KnownMotion m = pendulum(1);
  BodyState s = m.initial;
  const double before = pendulum_energy(s);
  Drift d;
  for (int n = 0; n < steps; ++n) {
    stepper.step(m.field, n * dt, dt, {&s, 1});
    const double off = pendulum_energy(s) - before;
    d.swing = max_or_nan(d.swing, std::abs(off));
    if (n >= steps - steps / 10) d.end += off / (steps / 10);
  }
  return d;
}

TEST(EnergyOfAPendulum, SwingsUnderSymplecticSchemesAndRunsAwayUnderExplicitEuler) {
  const double dt = 0.05;
  for (const std::string_view name : {"semi-implicit Euler", "position Verlet", "velocity Verlet"}) {
    const auto stepper = make_stepper(name);
    const Drift shortly = energy_drift(*stepper, dt, 400);
    stepper->restart();
    const Drift long_after = energy_drift(*stepper, dt, 40000);
    // A hundred times longer, no larger: what swings is (dt/2) x' sin(x) or dt^2/8 sin^2(x) and the like.
    EXPECT_LT(long_after.swing, 1.02 * shortly.swing) << name;
    EXPECT_LT(shortly.swing, stepper->order() == 1 ? dt : dt * dt) << name;
  }
  ExplicitEuler euler;
  EXPECT_GT(energy_drift(euler, dt, 4000).end, 1);  // more than enough to go over the top
}

TEST(EnergyOfAPendulum, LeaksAwayUnderRungeKutta4LikeTheFifthPowerOfTheStep) {
  RungeKutta4 rk4;
  const double coarse = energy_drift(rk4, 0.1, 4000).end, fine = energy_drift(rk4, 0.05, 8000).end;
  EXPECT_LT(coarse, 0);
  EXPECT_NEAR(std::log2(coarse / fine), 5, 0.1);  // order 4 in each component, one more in what it loses per second
}

// The distance to the start after so many steps forth and as many with reversed velocities.
double way_back(Stepper& stepper, const KnownMotion& m, double dt, int steps) {
  BodyState s = run(stepper, m.field, m.initial, dt, steps);
  s.v_WB = -s.v_WB;
  s = run(stepper, m.field, s, dt, steps);
  s.v_WB = -s.v_WB;
  return distance(s, m.initial);
}

TEST(TimeReversal, BringsVerletHome) {
  const KnownMotion m = pendulum(1);
  PositionVerlet position_verlet;
  VelocityVerlet velocity_verlet;
  // 2000 steps of a few roundings each, which grow at most like the time, 100 s; position Verlet adds them up twice.
  EXPECT_LT(way_back(velocity_verlet, m, 0.1, 1000), 2000 * 4 * kEps * 100);
  EXPECT_LT(way_back(position_verlet, m, 0.1, 1000), 2000 * 4 * kEps * 100 / 0.1);
  ExplicitEuler explicit_euler;
  SemiImplicitEuler semi_implicit;
  RungeKutta4 rk4;
  EXPECT_GT(way_back(explicit_euler, m, 0.1, 1000), 0.1);
  EXPECT_GT(way_back(semi_implicit, m, 0.1, 1000), 1e-2);
  EXPECT_GT(way_back(rk4, m, 0.1, 1000), 1e-5);
}

}  // namespace
}  // namespace plumbline
