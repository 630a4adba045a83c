// What every integrator promises, whatever its order.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "known_motions.hpp"
#include "plumbline/core/integration/position_verlet.hpp"
#include "plumbline/core/integration/stepper_table.hpp"

namespace plumbline {
namespace {

using namespace testing;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(StepperTable, SaysWhatItsSteppersSay) {
  ASSERT_EQ(stepper_kinds().size(), 6u);
  for (const StepperKind& kind : stepper_kinds()) {
    EXPECT_EQ(kind.make()->name(), kind.name);
    EXPECT_EQ(kind.make()->order(), kind.order);
    EXPECT_EQ(make_stepper(kind.name)->name(), kind.name);
  }
}

TEST(StepperTable, ListsItsNamesWhenOneIsUnknown) {
  try {
    make_stepper("Euler");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("'Euler'; there are: explicit Euler, semi-implicit Euler"), std::string::npos);
  }
}

TEST(EveryStepper, AsksForTheForceAtTheTimeItStandsAt) {
  // x'' = 6 t: x = t^3. Methods of order 2 and up see the field at the end too; order 1 errs by 6 t^2 dt/4 or so.
  const AccelerationField growing = [](double t, std::span<const BodyState>, std::span<Acceleration> a) {
    a[0] = {Vec3(6 * t, 0, 0), Vec3::Zero()};
  };
  for (const StepperKind& kind : stepper_kinds()) {
    const auto stepper = kind.make();
    const BodyState end = run(*stepper, growing, BodyState{}, 0.01, 200);
    // Order 1: half a step of the speed 3 t^2 = 12 and of the integral of 6 t over the half step; order 2: dt^2 of
    // that.
    EXPECT_NEAR(end.p_WB.x(), 8, kind.order == 1 ? 12 * 0.01 : kind.order == 2 ? 3 * 1e-4 * 2 : 1e-12) << kind.name;
    EXPECT_NEAR(end.v_WB.x(), 12, kind.order == 1 ? 6 * 0.01 * 2 : 1e-3) << kind.name;
  }
}

TEST(EveryStepper, KeepsBodiesApartAndParticlesUnturned) {
  // Body 1 is a free box, body 0 a particle on a spring: together they move as each does alone.
  const KnownMotion box = tumbling_box(1), bob = oscillator(1);
  const AccelerationField both = [&](double t, std::span<const BodyState> s, std::span<Acceleration> a) {
    bob.field(t, s.first(1), a.first(1));
    box.field(t, s.subspan(1), a.subspan(1));
  };
  for (const StepperKind& kind : stepper_kinds().first(5)) {
    const auto a = kind.make(), b = kind.make(), c = kind.make();
    BodyState pair[] = {bob.initial, box.initial};
    for (int n = 0; n < 20; ++n) a->step(both, 0.05 * n, 0.05, pair);
    EXPECT_EQ(distance(pair[0], run(*b, bob.field, bob.initial, 0.05, 20)), 0) << kind.name;
    const BodyState alone = run(*c, box.field, box.initial, 0.05, 20);
    EXPECT_EQ(std::memcmp(&pair[1], &alone, sizeof alone), 0) << kind.name;
    EXPECT_EQ(pair[0].q_WB.coeffs(), Quat::Identity().coeffs()) << kind.name;
  }
}

TEST(EveryStepper, KeepsAttitudesOfUnitLength) {
  const KnownMotion box = tumbling_box(1);
  for (const StepperKind& kind : stepper_kinds()) {
    const auto stepper = kind.make();
    const BodyState end = run(*stepper, box.field, box.initial, 0.01, 300);
    EXPECT_NEAR(end.q_WB.norm(), 1, 2 * kEps) << kind.name;
  }
}

TEST(EveryStepper, GoesBackInTime) {
  const KnownMotion m = pendulum(1);
  for (const StepperKind& kind : stepper_kinds()) {
    const auto stepper = kind.make();
    BodyState s = m.final;
    for (int n = 0; n < 1000; ++n) stepper->step(m.field, 1 - 1e-3 * n, -1e-3, {&s, 1});
    // Order 1: dt/2 times rates of about 1 and their growth e^1; order 2: the square.
    EXPECT_LT(distance(s, m.initial), kind.order == 1 ? 2e-3 : 2e-6) << kind.name;
  }
}

TEST(EveryStepper, KeepsNanOrRefusesIt) {
  for (const StepperKind& kind : stepper_kinds()) {
    const auto stepper = kind.make();
    BodyState s;
    s.v_WB.x() = kNan;
    if (kind.order == 8) {
      EXPECT_THROW(run(*stepper, oscillator(1).field, s, 0.1, 1), std::invalid_argument);
    } else {
      EXPECT_FALSE(is_finite(run(*stepper, oscillator(1).field, s, 0.1, 3))) << kind.name;
    }
  }
}

TEST(EveryStepper, RefusesStepsThatAreNone) {
  for (const StepperKind& kind : stepper_kinds()) {
    const auto stepper = kind.make();
    BodyState s;
    const AccelerationField field = oscillator(1).field;
    for (const double dt : {0.0, kNan, std::numeric_limits<double>::infinity()}) {
      EXPECT_THROW(stepper->step(field, 0, dt, {&s, 1}), std::invalid_argument) << kind.name;
    }
    EXPECT_THROW(stepper->step(field, kNan, 0.1, {&s, 1}), std::invalid_argument) << kind.name;
    EXPECT_EQ(s.p_WB, Vec3::Zero());
    EXPECT_NO_THROW(stepper->step([](double, auto, auto) {}, 0, 0.1, {})) << kind.name;  // no bodies, nothing to do
  }
}

TEST(PositionVerlet, NoticesAnImpact) {
  // A free particle is reflected after 5 steps: positions alone would let it fly on.
  const AccelerationField none = [](double, std::span<const BodyState>, std::span<Acceleration> a) { a[0] = {}; };
  PositionVerlet verlet;
  BodyState s;
  s.v_WB = Vec3(1, 0, 0);
  s = run(verlet, none, s, 0.1, 5);
  s.v_WB = -s.v_WB;
  s = run(verlet, none, s, 0.1, 5);
  EXPECT_NEAR(s.p_WB.x(), 0, 20 * kEps);
  EXPECT_NEAR(s.v_WB.x(), -1, 20 * kEps / 0.1);
}

TEST(PositionVerlet, KeepsItsOrderWhenTheStepChanges) {
  const KnownMotion m = oscillator(2);
  const auto error = [&](int steps) {
    PositionVerlet verlet;
    const double dt = 1.0 / steps;
    BodyState s = m.initial;
    for (int n = 0; n < steps; ++n) verlet.step(m.field, n * dt, dt, {&s, 1});
    for (int n = 0; n < 3 * steps; ++n) verlet.step(m.field, 1 + n * dt / 3, dt / 3, {&s, 1});
    return distance(s, m.final);
  };
  EXPECT_NEAR(std::log2(error(200) / error(400)), 2, 0.05);
}

}  // namespace
}  // namespace plumbline
