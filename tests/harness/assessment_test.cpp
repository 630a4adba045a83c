#include "plumbline/harness/assessment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plumbline/harness/explanation.hpp"
#include "plumbline/harness/recording.hpp"

namespace plumbline {
namespace {

// A ball that moves along x; `error` is added to its place at the samples of the trajectory.
Scenario moving_ball(double v_y) {
  Scenario s;
  s.id = "test/moving_ball";
  s.duration = 1;
  s.bodies = {{"ball", Sphere{0.1}, false, 1.0, Vec3::Constant(0.004), {}}};
  s.bodies[0].initial.v_WB = Vec3(1, v_y, 0);
  s.gates = {{"position.max", [](const GateContext& c) { return c.dt; }, "dt", "a reason", {"file.toml", 3, 7}}};
  return s;
}

Trajectory straight(const Scenario& s, double dt, double error, Vec3 direction = Vec3::UnitX()) {
  Trajectory t(dt, 1);
  for (std::size_t k = 0; k <= s.step_count(dt); ++k) {
    BodyState state = s.bodies[0].initial;
    state.p_WB = state.v_WB * t.time(k);
    if (k == 57) state.p_WB += error * direction;
    t.append()[0] = state;
  }
  return t;
}

RunResult assessed(const Scenario& s, const Trajectory& actual, const EngineInfo& engine) {
  const double dt = actual.dt();
  RunResult result = begin_result(s, engine, Profile::kMatched, dt);
  assess(result, {s, actual, straight(s, dt, 0), measured_in_plane(s, engine)}, engine, std::nullopt, {{}, true});
  return result;
}

TEST(Assessment, ChecksEveryGateWithItsPlaceAndReason) {
  const Scenario s = moving_ball(0);
  const RunResult good = assessed(s, straight(s, 0.01, 0.0099), {});
  EXPECT_EQ(good.verdict, Verdict::kPass);
  const RunResult bad = assessed(s, straight(s, 0.01, 0.0101), {});
  EXPECT_EQ(bad.verdict, Verdict::kFail);
  EXPECT_EQ(bad.reason, "position.max = 0.0101 exceeds its limit 0.01");
  ASSERT_EQ(bad.gates.size(), 1u);
  EXPECT_EQ(bad.gates[0].reason, "a reason");
  EXPECT_EQ(bad.gates[0].place.line, 3);
}

TEST(Assessment, NaNFails) {
  const Scenario s = moving_ball(0);
  EXPECT_EQ(assessed(s, straight(s, 0.01, std::nan("")), {}).verdict, Verdict::kFail);
}

TEST(Assessment, MeasuresAProjectionInItsPlaneAndSaysSo) {
  const Scenario s = moving_ball(3);
  EngineInfo planar;
  planar.dimension = 2;
  const Trajectory off_along_y = straight(s, 0.01, 0.5, Vec3::UnitY());
  const RunResult result = assessed(s, off_along_y, planar);
  EXPECT_EQ(result.verdict, Verdict::kPass) << result.reason;
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_EQ(result.notes[0].find("planar projection"), 0u);
  EXPECT_EQ(assessed(s, off_along_y, {}).verdict, Verdict::kFail);
}

TEST(Assessment, ThinsTheErrorCurveButKeepsItsPeak) {
  Scenario s = moving_ball(0);
  s.duration = 50;
  const RunResult result = assessed(s, straight(s, 0.01, 0.25), {});
  EXPECT_LE(result.curve.size(), 200u);
  double peak = 0, at = 0;
  for (const CurvePoint& p : result.curve) {
    if (p.error > peak) peak = p.error, at = p.t;
  }
  EXPECT_NEAR(peak, 0.25, 1e-12);  // 0.57 + 0.25 - 0.57 rounds by less than 1e-15
  EXPECT_NEAR(at, 0.57, 1e-12);
}

TEST(Explanation, IsSilentBelowTheRoundingFloor) {
  const Scenario s = moving_ball(0);
  const Trajectory t = straight(s, 0.01, 0);
  EXPECT_EQ(explain(t, {{"scheme", t}}, 1e-15, 1e-14, false).scheme, "");
  EXPECT_EQ(explain(t, {{"scheme", t}}, 1e-3, 1e-14, false).scheme, "scheme");
  EXPECT_EQ(explain(t, {{"scheme", t}}, 1e-3, 1e-14, false).share, 1.0);
  EXPECT_EQ(explain(t, {}, 1e-3, 1e-14, false).scheme, "");
}

TEST(Plan, StepsThatMissTheDurationByRoundingCount) {
  Scenario s;
  s.duration = 2;
  EXPECT_EQ(s.step_count(1.0 / 60), 120u);
  EXPECT_EQ(s.step_count(0.02), 100u);
  EXPECT_EQ(s.step_count(0.3), 6u);
}

}  // namespace
}  // namespace plumbline
