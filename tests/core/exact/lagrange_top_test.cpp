#include "plumbline/core/exact/lagrange_top.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "independent_check.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/exact/top_precession.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kPi = std::numbers::pi;

const TopBody kTop{1, Vec3(0, 0, 0.5), 0.02, 0.03, 9.81};

BodyState tilted(const Vec3& phi, const Vec3& w_W) {
  BodyState state;
  state.q_WB = rotation_by(phi);
  state.w_WB = w_W;
  return state;
}

Vec3 inertia_at_pivot(const TopBody& top) {
  const double across = transverse_inertia_at_pivot(top);
  const Vec3 along = top.arm_B.normalized().cwiseAbs();  // the arm lies along a body axis in these tests
  return across * (Vec3::Ones() - along) + top.inertia_axial * along;
}

double energy(const TopBody& top, const BodyState& s, double pivot_z) {
  const Vec3 w = s.q_WB.conjugate() * s.w_WB;
  return 0.5 * w.dot(inertia_at_pivot(top).cwiseProduct(w)) + top.mass * top.gravity * (s.p_WB.z() - pivot_z);
}

double vertical_momentum(const TopBody& top, const BodyState& s) {
  return (s.q_WB * inertia_at_pivot(top).cwiseProduct(s.q_WB.conjugate() * s.w_WB)).z();
}

void expect_agreement(const TopBody& top, const BodyState& s, double t, int steps, double tolerance) {
  LongDoubleTop integration(inertia_at_pivot(top), top.arm_B, Vec3(0, 0, -top.mass * top.gravity), s);
  integration.run(t, steps);
  const BodyState exact = LagrangeTop(top, s).at(t);
  EXPECT_LT(geodesic_angle(exact.q_WB, integration.attitude()), tolerance) << s.w_WB.transpose();
  EXPECT_LT((exact.w_WB - integration.w_W()).norm(), tolerance * (10 + s.w_WB.norm())) << s.w_WB.transpose();
}

TEST(LagrangeTop, MatchesThePublishedHeavyTop) {
  // The benchmark of Geradin and Cardona: m = 15, J = diag(.234375, .46875, .234375), centre of mass (0, 1, 0).
  const TopBody top{15, Vec3(0, 1, 0), 0.46875, 0.234375, 9.81};
  BodyState s;
  s.p_WB = Vec3(0, 1, 0);
  s.w_WB = Vec3(0, 150, -4.61538);
  const LagrangeTop exact(top, s);
  EXPECT_LT((exact.at(0.2).p_WB - Vec3(0.60555056, 0.59895768, -0.52398303)).norm(), 1e-8);
  EXPECT_NEAR(energy(top, exact.at(0.2), 0), 5435.69679, 1e-5);
  // w h = 1.5e-3 in the body, 1e-12 by the law of the method.
  expect_agreement(top, s, 0.2, 100000, 2e-13);
}

TEST(LagrangeTop, AgreesWithAnIntegrationInEveryRegime) {
  const double tolerance = 2e-13;  // 2 s, at most 80 rad turned and flips that stretch rounding tenfold
  expect_agreement(kTop, tilted(Vec3(0.7, 0.2, 0), Vec3(0.3, 0.2, 40)), 2, 200000, tolerance);  // loops
  expect_agreement(kTop, tilted(Vec3(2.7, 0.2, 0), Vec3(0.3, 0.2, 0)), 2, 20000, tolerance);    // hangs
  expect_agreement(kTop, tilted(Vec3(3, 1, 0.1), Vec3(0, 0, 0)), 2, 20000, tolerance);          // plane swing
  expect_agreement(kTop, tilted(Vec3(0, 0, 0), Vec3(0.3, 0.2, 10)), 2, 50000, tolerance);       // from upright
  expect_agreement(kTop, tilted(Vec3(0, 0, 0), Vec3(0.3, 0, 0)), 2, 20000, tolerance);          // turns over
  expect_agreement(kTop, tilted(Vec3(kPi, 0, 0), Vec3(1, 2, 3)), 2, 20000, tolerance);          // from hanging
  expect_agreement(kTop, tilted(Vec3(1e-9, 0, 0), Vec3(1e-9, 0, 1)), 2, 20000, 1e-11);  // falls from 1e-9 rad: e^12
}

TEST(LagrangeTop, SatisfiesItsEquationOfMotion) {
  std::mt19937_64 bits(1);
  const Vec3 inertia = inertia_at_pivot(kTop);
  for (int k = 0; k < 200; ++k) {
    BodyState s;
    s.q_WB = uniform_attitude(bits);
    s.w_WB = 6 * uniform_vector(bits);
    const LagrangeTop top(kTop, s);
    const double t = 4 * uniform(bits) - 2;
    const auto w_B = [&](double x) { return (top.at(x).q_WB.conjugate() * top.at(x).w_WB).eval(); };
    const Vec3 w = w_B(t), weight_B = top.at(t).q_WB.conjugate() * Vec3(0, 0, -kTop.mass * kTop.gravity);
    const Vec3 residual =
        inertia.cwiseProduct(derivative(w_B, t, 0.003)) + w.cross(inertia.cwiseProduct(w)) - kTop.arm_B.cross(weight_B);
    // Rates up to 12 rad/s: truncation (0.036)^8 9!/630 x 12 = 2e-8 at the very worst, 1e-11 for the poles of these
    // motions, which lie at 0.2 s and more; rounding 1e-14/0.003. Against torques of 5 N m.
    EXPECT_LT(residual.norm(), 1e-9);
    EXPECT_LT((top.at(t).v_WB - derivative([&](double x) { return top.at(x).p_WB; }, t, 0.003)).norm(), 1e-9);
  }
}

TEST(LagrangeTop, KeepsEnergyAndBothMomenta) {
  std::mt19937_64 bits(2);
  for (int k = 0; k < 1000; ++k) {
    BodyState s;
    s.q_WB = uniform_attitude(bits);
    s.p_WB = s.q_WB * kTop.arm_B;
    s.w_WB = 10 * uniform_vector(bits);
    const LagrangeTop top(kTop, s);
    const BodyState later = top.at(5 * uniform(bits));
    // Sums of terms up to 20 J, each rounded a few times.
    EXPECT_NEAR(energy(kTop, later, 0), energy(kTop, s, 0), 1e-12);
    EXPECT_NEAR(vertical_momentum(kTop, later), vertical_momentum(kTop, s), 1e-13);
    EXPECT_NEAR(later.w_WB.dot(later.q_WB * Vec3::UnitZ()), top.spin(), 1e-12);
    EXPECT_NEAR(later.p_WB.norm(), 0.5, 4 * kEps);
  }
}

TEST(LagrangeTop, NutatesBetweenItsTurningPoints) {
  const LagrangeTop top(kTop, tilted(Vec3(0.7, 0.2, 0), Vec3(0.3, 0.2, 40)));
  double least = 1, most = -1;
  for (int k = 0; k < 2000; ++k) {
    const double u = (top.at(k * top.nutation_period() / 2000).q_WB * Vec3::UnitZ()).z();
    least = std::min(least, u);
    most = std::max(most, u);
  }
  // A sample lies within half a 2000th of the period from each extremum: parabola of that width, 2.5e-6 of the range.
  EXPECT_NEAR(least, top.lowest_cosine(), 5e-6);
  EXPECT_NEAR(most, top.highest_cosine(), 5e-6);
}

TEST(LagrangeTop, PrecessesSteadilyAtBothRoots) {
  const double theta = 0.6, spin = 150;
  const PrecessionRates rates = precession_rates(kTop, theta, spin);
  const double i1 = transverse_inertia_at_pivot(kTop), moment = kTop.mass * kTop.gravity * 0.5;
  for (const double rate : {rates.slow, rates.fast}) {
    EXPECT_NEAR(i1 * rate * rate * std::cos(theta) - kTop.inertia_axial * spin * rate + moment, 0, 1e-13 * moment * 10);
    const BodyState s = precessing_state(kTop, theta, spin, rate, Vec3(1, 2, 3));
    const LagrangeTop top(kTop, s);
    EXPECT_LT((top.pivot_W() - Vec3(1, 2, 3)).norm(), 4 * kEps);
    EXPECT_NEAR(top.highest_cosine() - top.lowest_cosine(), 0, 1e-13);
    const Vec3 axis = rotation_by(Vec3(0, 0, 1.5 * rate)) * (s.q_WB * Vec3::UnitZ());
    EXPECT_LT((top.at(1.5).q_WB * Vec3::UnitZ() - axis).norm(), 1e-12);
  }
  EXPECT_NEAR(rates.slow, moment / (kTop.inertia_axial * spin), 0.2 * rates.slow);  // the gyroscope's rule of thumb
  EXPECT_THROW(precession_rates(kTop, theta, 1), std::invalid_argument);
}

TEST(LagrangeTop, SleepsAboveTheCriticalSpinOnly) {
  const double critical = sleeping_spin(kTop);
  EXPECT_NEAR(critical * critical, 4 * kTop.mass * 9.81 * 0.5 * transverse_inertia_at_pivot(kTop) / (0.02 * 0.02),
              1e-9);
  const auto lowest = [](double spin) {
    BodyState s = tilted(Vec3(1e-6, 0, 0), Vec3::Zero());
    s.w_WB = spin * (s.q_WB * Vec3::UnitZ());
    return LagrangeTop(kTop, s).lowest_cosine();
  };
  // Small tilts swing between 1 and 1/sqrt(1 - (critical/spin)^2) times the start: 7.1e-6 rad here, 1 - 2.5e-11.
  EXPECT_GT(lowest(1.01 * critical), 1 - 3e-11);
  EXPECT_LT(lowest(1.01 * critical), 1 - 2e-11);
  EXPECT_LT(lowest(0.99 * critical), 0.99);
}

TEST(LagrangeTop, IsAPlanePendulumWithoutSpin) {
  const double w0 = std::sqrt(kTop.mass * 9.81 * 0.5 / transverse_inertia_at_pivot(kTop));
  for (const double rate : {0.0, 3.0, 20.0}) {
    const PlanarPendulum pendulum(w0, {kPi - 1, -rate});  // tilt 1 from upright about x
    const LagrangeTop top(kTop, tilted(Vec3(1, 0, 0), Vec3(rate, 0, 0)));
    for (const double t : {0.3, 1.1, 4.0}) {
      const double tilt = kPi - pendulum.at(t).angle;
      const Vec3 axis(0, -std::sin(tilt), std::cos(tilt));
      EXPECT_LT((top.at(t).q_WB * Vec3::UnitZ() - axis).norm(), 2e-13) << rate << " " << t;
    }
  }
}

TEST(LagrangeTop, StandsStillUprightAndHanging) {
  const LagrangeTop sleeping(kTop, tilted(Vec3(0, 0, 0), Vec3(0, 0, 5)));
  EXPECT_LT(geodesic_angle(sleeping.at(2).q_WB, rotation_by(Vec3(0, 0, 10))), 16 * kEps);
  EXPECT_TRUE(std::isinf(sleeping.nutation_period()));
}

TEST(LagrangeTop, RefusesWhatIsNoTop) {
  TopBody weightless = kTop;
  weightless.gravity = 0;
  EXPECT_THROW(LagrangeTop(weightless, BodyState{}), std::invalid_argument);
  TopBody armless = kTop;
  armless.arm_B.setZero();
  EXPECT_THROW(LagrangeTop(armless, BodyState{}), std::invalid_argument);
  BodyState lost;
  lost.w_WB.x() = std::nan("");
  EXPECT_THROW(LagrangeTop(kTop, lost), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
