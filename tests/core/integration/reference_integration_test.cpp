// The reference integrator against what is exact: 1e-10 over 10 s.
#include "plumbline/core/integration/reference_integration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "known_motions.hpp"
#include "plumbline/core/exact/lagrange_top.hpp"
#include "plumbline/core/exact/torque_free_top.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace testing;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRequired = 1e-10;  // asked of a reference, over 10 s

std::vector<double> times_up_to(double end, int samples) {
  std::vector<double> times;
  for (int k = 1; k <= samples; ++k) times.push_back(end * k / samples);
  return times;
}

struct Errors {
  double attitude = 0;  // [rad]
  double position = 0;  // [m]
  double w = 0;         // relative to the largest
};

// Along the whole way, against the series.
Errors errors(const ReferenceRun& run, const std::vector<double>& times, TopSeries exact, double series_step) {
  Errors e;
  for (std::size_t k = 0; k < times.size(); ++k) {
    exact.advance_to(times[k], series_step);
    const BodyState s = exact.state();
    e.attitude = max_or_nan(e.attitude, geodesic_angle(run.states[k].q_WB, s.q_WB));
    e.position = max_or_nan(e.position, (run.states[k].p_WB - s.p_WB).norm());
    e.w = max_or_nan(e.w, (run.states[k].w_WB - s.w_WB).norm() / s.w_WB.norm());
  }
  return e;
}

const Vec3 kNoArm = Vec3::Zero();
const Vec3 kFlip(0.1, 5, 0.1);  // about the middle axis of the box, nearly: Dzhanibekov's nut

TEST(ReferenceIntegration, FollowsTheFlippingBoxToTheSeries) {
  const std::vector<double> times = times_up_to(10, 50);
  const BodyState initial = top_state(kNoArm, Quat::Identity(), kFlip);
  const ReferenceRun run = integrate_reference(top_field(box_inertia(), kNoArm, 0), 0, {&initial, 1}, times);
  const Errors e = errors(run, times, TopSeries(box_inertia(), kNoArm, 0, Quat::Identity(), kFlip), 0.02);
  EXPECT_LT(e.attitude, kRequired);
  EXPECT_LT(e.w, kRequired);
  EXPECT_LT(run.attitude_uncertainty, 20 * kRequired);
  RecordProperty("attitude", std::to_string(e.attitude * 1e15));
  RecordProperty("evaluations", std::to_string(run.effort.evaluations));
}

TEST(ReferenceIntegration, FollowsTheFlippingBoxToJacobisFunctions) {
  const std::vector<double> times = times_up_to(10, 50);
  const BodyState initial = top_state(kNoArm, Quat::Identity(), kFlip);
  const ReferenceRun run = integrate_reference(top_field(box_inertia(), kNoArm, 0), 0, {&initial, 1}, times);
  const TorqueFreeTop exact(box_inertia(), initial);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const BodyState s = exact.at(times[k]);
    EXPECT_LT(geodesic_angle(run.states[k].q_WB, s.q_WB), kRequired) << times[k];
    EXPECT_LT((run.states[k].w_WB - s.w_WB).norm(), kRequired * kFlip.norm()) << times[k];
  }
  // Published to 8 decimals, for t = 1 s.
  const BodyState& s = run.states[4];
  ASSERT_DOUBLE_EQ(times[4], 1);
  EXPECT_LT(geodesic_angle(s.q_WB, Quat(-0.71311, 0.35235939, 0.52518419, -0.30248729).normalized()), 1e-5);
  EXPECT_LT((s.q_WB.conjugate() * s.w_WB - Vec3(3.42379844, 2.81918544, 3.92838445)).norm(), 1e-8);
}

// The heavy top of Terze, Mueller, Zlatar, Multibody Syst. Dyn. 38 (2016) 201: 15 kg, centre of mass 1 m from the
// pivot.
const Vec3 kArm(0, 1, 0);
const Vec3 kTopInertia(15.234375, 0.46875, 15.234375);
const double kWeight = 15 * 9.81;
const Vec3 kTopSpin(0, 150, -4.61538);

TEST(ReferenceIntegration, FollowsTheHeavyTopThroughFifteenHundredRadians) {
  const std::vector<double> times = times_up_to(10, 50);
  const BodyState initial = top_state(kArm, Quat::Identity(), kTopSpin);
  const ReferenceRun run = integrate_reference(top_field(kTopInertia, kArm, kWeight), 0, {&initial, 1}, times);
  const Errors e = errors(run, times, TopSeries(kTopInertia, kArm, kWeight, Quat::Identity(), kTopSpin), 0.02);
  EXPECT_LT(e.attitude, kRequired);
  EXPECT_LT(e.position, kRequired);
  EXPECT_LT(e.w, kRequired);
  EXPECT_LT(run.attitude_uncertainty, kRequired);
  ASSERT_DOUBLE_EQ(times[0], 0.2);
  // Published to 8 decimals.
  EXPECT_LT((run.states[0].p_WB - Vec3(0.60555056, 0.59895768, -0.52398303)).norm(), 1e-8);
  for (const BodyState& s : run.states) {
    const Vec3 w_B = s.q_WB.conjugate() * s.w_WB;
    const double energy = 0.5 * w_B.dot(kTopInertia.cwiseProduct(w_B)) + kWeight * s.p_WB.z();
    EXPECT_NEAR(energy, 5435.69679, 1e-5);
    EXPECT_LT(std::abs(s.p_WB.norm() - 1), kRequired);
  }
  RecordProperty("attitude", std::to_string(e.attitude * 1e15));
  RecordProperty("evaluations", std::to_string(run.effort.evaluations));
}

TEST(ReferenceIntegration, FollowsANutatingTop) {
  // 1 kg on an arm of 0.3 m along its axis, tilted by 0.6 rad and let go with 25 rad/s of spin: it nods.
  const Vec3 arm(0, 0, 0.3), inertia(0.1, 0.1, 0.02), spin(0, 0, 25);
  const Quat tilted = rotation_by(Vec3(0.6, 0, 0));
  const std::vector<double> times = times_up_to(10, 40);
  const BodyState initial = top_state(arm, tilted, spin);
  const ReferenceRun run = integrate_reference(top_field(inertia, arm, 9.81), 0, {&initial, 1}, times);
  const Errors e = errors(run, times, TopSeries(inertia, arm, 9.81, tilted, spin), 0.02);
  EXPECT_LT(e.attitude, kRequired);
  EXPECT_LT(e.position, kRequired);
  double lowest = 1, highest = 0;
  for (const BodyState& s : run.states) {
    lowest = std::min(lowest, s.p_WB.z());
    highest = std::max(highest, s.p_WB.z());
  }
  EXPECT_GT(highest - lowest, 0.05);  // it does nod
  RecordProperty("attitude", std::to_string(e.attitude * 1e15));
}

TEST(ReferenceIntegration, FollowsBothTopsToLagrangesSolution) {
  struct Case {
    TopBody top;
    Quat q_WB;
    Vec3 w_B;
  };
  const Case cases[] = {{{1, Vec3(0, 0, 0.3), 0.02, 0.1 - 0.09, 9.81}, rotation_by(Vec3(0.6, 0, 0)), Vec3(0, 0, 25)},
                        {{15, kArm, 0.46875, 0.234375, 9.81}, Quat::Identity(), kTopSpin}};
  const double times[] = {1, 4, 10};
  for (const Case& c : cases) {
    const double across = transverse_inertia_at_pivot(c.top);
    Vec3 inertia(across, across, across);
    (c.top.arm_B.z() != 0 ? inertia.z() : inertia.y()) = c.top.inertia_axial;
    const BodyState initial = top_state(c.top.arm_B, c.q_WB, c.w_B);
    const AccelerationField field = top_field(inertia, c.top.arm_B, c.top.mass * c.top.gravity);
    const ReferenceRun run = integrate_reference(field, 0, {&initial, 1}, times);
    const LagrangeTop exact(c.top, initial);
    for (std::size_t k = 0; k < 3; ++k) {
      const BodyState s = exact.at(times[k]);
      EXPECT_LT(geodesic_angle(run.states[k].q_WB, s.q_WB), kRequired) << times[k];
      EXPECT_LT((run.states[k].p_WB - s.p_WB).norm(), kRequired) << times[k];
    }
  }
}

TEST(ReferenceIntegration, MovesSeveralBodiesThatActOnEachOther) {
  // Two particles of equal mass about their common centre, x_1'' = (x_2 - x_1)/|x_2 - x_1|^3: circles of radius 1/2 and
  // angular velocity sqrt(2) for a distance of 1.
  const AccelerationField gravity = [](double, std::span<const BodyState> s, std::span<Acceleration> a) {
    const Vec3 d = s[1].p_WB - s[0].p_WB;
    a[0] = {d / std::pow(d.norm(), 3), Vec3::Zero()};
    a[1] = {-d / std::pow(d.norm(), 3), Vec3::Zero()};
  };
  BodyState pair[2];
  const double rate = std::numbers::sqrt2;
  pair[0].p_WB = Vec3(0.5, 0, 0);
  pair[0].v_WB = Vec3(0, rate / 2, 0);
  pair[1].p_WB = -pair[0].p_WB;
  pair[1].v_WB = -pair[0].v_WB;
  const double times[] = {2, 10};
  const ReferenceRun run = integrate_reference(gravity, 0, pair, times);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 exact = 0.5 * Vec3(std::cos(rate * times[k]), std::sin(rate * times[k]), 0);
    EXPECT_LT((run.states[2 * k].p_WB - exact).norm(), kRequired);
    EXPECT_LT((run.states[2 * k + 1].p_WB + exact).norm(), kRequired);
    EXPECT_EQ(run.states[2 * k].q_WB.coeffs(), Quat::Identity().coeffs());
  }
}

TEST(ReferenceIntegration, StatesAnUncertaintyThatHoldsTheError) {
  const std::vector<double> times = times_up_to(10, 20);
  const BodyState initial = top_state(kNoArm, Quat::Identity(), kFlip);
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const ReferenceRun run =
        integrate_reference(top_field(box_inertia(), kNoArm, 0), 0, {&initial, 1}, times, tolerance);
    const Errors e = errors(run, times, TopSeries(box_inertia(), kNoArm, 0, Quat::Identity(), kFlip), 0.02);
    EXPECT_LT(e.attitude, run.attitude_uncertainty) << tolerance;
  }
}

TEST(ReferenceIntegration, SeesThroughAPoleInTheField) {
  const AccelerationField pole = [](double t, std::span<const BodyState>, std::span<Acceleration> a) {
    a[0] = {Vec3(1 / (t - 1), 0, 0), Vec3::Zero()};
  };
  const BodyState still;
  const double times[] = {2};
  EXPECT_THROW(integrate_reference(pole, 0, {&still, 1}, times), std::runtime_error);
}

TEST(ReferenceIntegration, RefusesWhatMakesNoSense) {
  const AccelerationField none = [](double, std::span<const BodyState>, std::span<Acceleration>) {};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BodyState body;
  const double falling[] = {2, 1}, early[] = {-1}, lost[] = {nan}, good[] = {0, 1, 1};
  EXPECT_THROW(integrate_reference(none, 0, {&body, 1}, falling), std::invalid_argument);
  EXPECT_THROW(integrate_reference(none, 0, {&body, 1}, early), std::invalid_argument);
  EXPECT_THROW(integrate_reference(none, 0, {&body, 1}, lost), std::invalid_argument);
  EXPECT_THROW(integrate_reference(none, 0, {}, good), std::invalid_argument);
  EXPECT_THROW(integrate_reference(none, 0, {&body, 1}, good, 1e-18), std::invalid_argument);
  EXPECT_THROW(integrate_reference(none, 0, {&body, 1}, good, nan), std::invalid_argument);
  EXPECT_EQ(integrate_reference(none, 0, {&body, 1}, good).states.size(), 3u);
  body.v_WB.x() = nan;
  EXPECT_THROW(integrate_reference(none, 0, {&body, 1}, good), std::invalid_argument);
}

// The series itself: halved steps agree to the rounding of long double, far below what is asked of it.
TEST(QuadraticTaylor, AgreesWithItselfAtHalfTheStep) {
  TopSeries a(kTopInertia, kArm, kWeight, Quat::Identity(), kTopSpin), b = a;
  a.advance_to(1, 0.02);
  b.advance_to(1, 0.01);
  EXPECT_LT(geodesic_angle(a.q_WB(), b.q_WB()), 4 * kEps);
}

}  // namespace
}  // namespace plumbline
