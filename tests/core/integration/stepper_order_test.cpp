// The order of every integrator, of one step and over a fixed time; and what slides 29, 30 and 40 leave to be said.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "known_motions.hpp"
#include "plumbline/core/integration/adaptive_stepper.hpp"
#include "plumbline/core/integration/explicit_euler.hpp"
#include "plumbline/core/integration/position_verlet.hpp"
#include "plumbline/core/integration/stepper_table.hpp"

namespace plumbline {
namespace {

using namespace testing;

constexpr double kEps = std::numeric_limits<double>::epsilon();

double error_at_end(const StepperKind& kind, const KnownMotion& motion, long steps) {
  const auto stepper = kind.make();
  const double dt = motion.duration / static_cast<double>(steps);
  return distance(run(*stepper, motion.field, motion.initial, dt, steps), motion.final);
}

// C dt^p (1 + c dt) shows the order p + c dt/(2 ln 2) when dt is halved. Rates are 1 to 3 per second, so c is a few per
// second; the steps below make the second term less than 0.05 and keep errors far above rounding.
double observed_order(const StepperKind& kind, const KnownMotion& motion) {
  const long steps = kind.order == 4 ? 100 : 500;
  const double coarse = error_at_end(kind, motion, steps), fine = error_at_end(kind, motion, 2 * steps);
  EXPECT_GT(fine, 1e3 * kEps) << kind.name << ", " << motion.name;
  return std::log2(coarse / fine);
}

void expect_orders(const KnownMotion& motion) {
  for (const StepperKind& kind : stepper_kinds().first(5)) {
    EXPECT_NEAR(observed_order(kind, motion), kind.order, 0.05) << kind.name << ", " << motion.name;
  }
}

TEST(StepperOrder, IsAsStatedOnAnOscillator) { expect_orders(oscillator(2)); }
TEST(StepperOrder, IsAsStatedOnAPendulum) { expect_orders(pendulum(2)); }
TEST(StepperOrder, IsAsStatedOnDragWhichDependsOnVelocity) { expect_orders(ship(4)); }
TEST(StepperOrder, IsAsStatedForTheAttitudeOfATumblingBox) { expect_orders(tumbling_box(2)); }

TEST(StepperOrder, OfDormandPrinceIsEightWhileOneStepFitsIntoDt) {
  // At tolerance 0.1 the solver takes every dt in one step, so that dt alone makes the error.
  const KnownMotion motion = pendulum(6);
  const auto error = [&](long steps) {
    AdaptiveStepper stepper(0.1);
    return distance(run(stepper, motion.field, motion.initial, motion.duration / static_cast<double>(steps), steps),
                    motion.final);
  };
  EXPECT_NEAR(std::log2(error(24) / error(48)), 8, 0.3);
}

// Simpson's rule is of order 4 for integrals, and here w(t) is even exact: but the sum of w dt is not the rotation
// vector.
TEST(StepperOrder, IsTwoWhereAngularVelocitiesAreAddedUpLikeVectors) {
  const KnownMotion motion = tumbling_box(2);
  const auto error = [&](long steps) {
    const double dt = motion.duration / static_cast<double>(steps);
    TopSeries series(box_inertia(), Vec3::Zero(), 0, motion.initial.q_WB,
                     motion.initial.q_WB.conjugate() * motion.initial.w_WB);
    Quat q = motion.initial.q_WB;
    for (long n = 0; n < steps; ++n) {
      const double t = static_cast<double>(n) * dt;
      const Vec3 w0 = series.state().w_WB;
      series.advance_to(t + 0.5 * dt, dt);
      const Vec3 w1 = series.state().w_WB;
      series.advance_to(t + dt, dt);
      const Vec3 w2 = series.state().w_WB;
      q = (rotation_by(dt / 6 * (w0 + 4 * w1 + w2)) * q).normalized();
    }
    return geodesic_angle(q, motion.final.q_WB);
  };
  EXPECT_NEAR(std::log2(error(100) / error(200)), 2, 0.05);
}

// Slide 29: "error decreases quadratically". True for one step.
TEST(CourseSlide29, SpeaksOfOneStepAndAFixedTimeLosesAnOrder) {
  const auto one_step = [](double dt) {
    const KnownMotion m = oscillator(dt);
    ExplicitEuler euler;
    return distance(run(euler, m.field, m.initial, dt, 1), m.final);
  };
  EXPECT_NEAR(std::log2(one_step(2e-3) / one_step(1e-3)), 2, 0.05);
  EXPECT_NEAR(observed_order(stepper_kinds()[0], oscillator(2)), 1, 0.05);
}

// Slide 39's formula alone, s(t+dt) from two positions, over `steps` steps on x'' = -x.
double slide_39(double s_before, double s, double dt, long steps) {
  for (long n = 0; n < steps; ++n) {
    const double next = 2 * s - s_before - s * dt * dt;
    s_before = s;
    s = next;
  }
  return s;
}

// Slide 40: "the error term O(dt^4) is much smaller than Euler's O(dt^2)". True for one step from two exact positions.
TEST(CourseSlide40, SpeaksOfOneStepAndAFixedTimeLosesTwoOrders) {
  const auto x = [](double t) { return std::cos(t) + 0.5 * std::sin(t); };
  const auto one_step = [&](double dt) { return std::abs(slide_39(x(-dt), x(0), dt, 1) - x(dt)); };
  EXPECT_NEAR(std::log2(one_step(0.04) / one_step(0.02)), 4, 0.05);
  const auto two_seconds = [&](long steps) {
    const double dt = 2.0 / static_cast<double>(steps);
    return std::abs(slide_39(x(-dt), x(0), dt, steps) - x(2));
  };
  EXPECT_NEAR(std::log2(two_seconds(500) / two_seconds(1000)), 2, 0.05);
}

TEST(CourseSlide41, StartedByAStepOfEulerIsOfFirstOrderOnly) {
  const auto x = [](double t) { return std::cos(t) + 0.5 * std::sin(t); };
  const auto careless = [&](long steps) {
    const double dt = 2.0 / static_cast<double>(steps);
    return std::abs(slide_39(1 - 0.5 * dt, 1, dt, steps) - x(2));
  };
  const auto ours = [&](long steps) {
    const double dt = 2.0 / static_cast<double>(steps);
    return std::abs(slide_39(1 - 0.5 * dt - 0.5 * dt * dt, 1, dt, steps) - x(2));
  };
  EXPECT_NEAR(std::log2(careless(500) / careless(1000)), 1, 0.05);
  EXPECT_NEAR(std::log2(ours(500) / ours(1000)), 2, 0.05);
  // With x(0) = 1 the missing a dt^2/2 acts like a velocity wrong by dt/2: off by sin(2) dt/2 after 2 s.
  EXPECT_NEAR(careless(1000), std::sin(2.0) * 1e-3, 2e-5);
  // And ours is what the class does: the same recurrence, but for the rounding of s_before.
  const KnownMotion m = oscillator(2);
  PositionVerlet verlet;
  const double dt = 2.0 / 500;
  const BodyState end = run(verlet, m.field, m.initial, dt, 500);
  EXPECT_NEAR(std::abs(end.p_WB.x() - x(2)), ours(500), 500 * 500 * kEps);
}

TEST(PositionVerlet, DerivesItsVelocityAtTheTimeOfThePosition) {
  const KnownMotion m = oscillator(2);
  const auto error = [&](long steps) {
    PositionVerlet verlet;
    const BodyState end = run(verlet, m.field, m.initial, 2.0 / static_cast<double>(steps), steps);
    return std::abs(end.v_WB.x() - m.final.v_WB.x());
  };
  EXPECT_NEAR(std::log2(error(500) / error(1000)), 2, 0.05);
  // The formula of slide 39 errs by dt^2/6 s''' and the positions by dt^2/24 a second: together less than dt^2. Half a
  // step late or early the velocity would be off by a dt/2, five times as much.
  const double dt = 2.0 / 500;
  EXPECT_LT(error(500), dt * dt);
  EXPECT_GT(std::abs(m.final.p_WB.x()) * dt / 2, 4 * dt * dt);
}

// Slide 30's box of slide 8: (0, 5, 0) m, 1 kg, (2, 3, -1) m/s, -9.8 N along y, 100 steps of 0.02 s.
TEST(CourseSlide30, LeavesTheBoxAboveItsParabolaAndSemiImplicitEulerBelow) {
  const AccelerationField gravity = [](double, std::span<const BodyState>, std::span<Acceleration> a) {
    a[0] = {Vec3(0, -9.8, 0), Vec3::Zero()};
  };
  BodyState box;
  box.p_WB = Vec3(0, 5, 0);
  box.v_WB = Vec3(2, 3, -1);
  const double t = 2, dt = 0.02, exact = 5 + 3 * t - 9.8 * t * t / 2;
  EXPECT_DOUBLE_EQ(exact, -8.6);
  const double shift[] = {9.8 * t * dt / 2, -9.8 * t * dt / 2, 0, 0, 0, 0};
  for (std::size_t i = 0; i < stepper_kinds().size(); ++i) {
    const auto stepper = stepper_kinds()[i].make();
    const BodyState end = run(*stepper, gravity, box, dt, 100);
    // Positions and velocities of up to 17 are rounded a few times a step; position Verlet adds its roundings twice.
    const double rounding = (i == 2 ? 100 : 1) * 100 * 4 * kEps * 17;
    EXPECT_NEAR(end.p_WB.y(), exact + shift[i], rounding) << stepper->name();
    EXPECT_LT((end.p_WB - Vec3(4, end.p_WB.y(), -2)).norm(), rounding) << stepper->name();
    EXPECT_LT((end.v_WB - Vec3(2, -16.6, -1)).norm(), rounding / (i == 2 ? dt : 1)) << stepper->name();
  }
  EXPECT_NEAR(shift[0] - shift[1], 0.392, 1e-15);  // g t dt
}

}  // namespace
}  // namespace plumbline
