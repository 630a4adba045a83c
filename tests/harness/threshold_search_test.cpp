// The search for a critical value, on an engine that is known to answer wrongly by a known amount.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plumbline/harness/recording.hpp"

namespace plumbline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// One ball that stands where it is put; or is nowhere.
class StillWorld final : public World {
 public:
  explicit StillWorld(BodyState state) : state_(std::move(state)) {}
  void apply(std::span<const Wrench>) override {}
  void step(double) override {
    if (state_.p_WB.x() > 90) state_.p_WB.x() = kNan;
  }
  void read(std::span<BodyState> states) const override { states[0] = state_; }

 private:
  BodyState state_;
};

class StillEngine final : public Engine {
 public:
  const EngineInfo& info() const override { return info_; }
  int built() const { return built_; }

 protected:
  std::unique_ptr<World> create(const Scenario& scenario, const Settings&) const override {
    ++built_;
    return std::make_unique<StillWorld>(scenario.bodies[0].initial);
  }

 private:
  EngineInfo info_;
  mutable int built_ = 0;
};

Scenario ball_at(double x) {
  Scenario s;
  s.duration = 1;
  s.bodies.resize(1);
  s.bodies[0].name = "ball";
  s.bodies[0].shape = Sphere{1};
  s.bodies[0].mass = 1;
  s.bodies[0].inertia = Vec3::Ones();
  s.bodies[0].initial.p_WB.x() = x;
  return s;
}

// Asked is whether x is above `changes_at`; the truth says 20.
Scenario question(double changes_at, double high = 50) {
  Scenario s = ball_at(0);
  Threshold t;
  t.low = 10;
  t.high = high;
  t.exact = 20;
  t.resolution = 0.01;
  t.with = [](double x) { return std::make_shared<const Scenario>(ball_at(x)); };
  t.answer = [changes_at](const Trajectory& run) { return run.at(run.samples() - 1, 0).p_WB.x() > changes_at; };
  s.threshold = t;
  return s;
}

TEST(ThresholdSearch, FindsWhereTheAnswerChanges) {
  for (const double at : {20.0, 13.37, 49.99}) {
    const Recording found = record(StillEngine(), question(at), {}, 0.5);
    ASSERT_TRUE(found.critical);
    EXPECT_LE(found.critical->no, at);
    EXPECT_GT(found.critical->yes, at);
    EXPECT_LE(found.critical->yes - found.critical->no, 0.01);
    EXPECT_EQ(found.trajectory.samples(), 3u);
    EXPECT_GT(found.trajectory.at(2, 0).p_WB.x(), at) << "the motion that is kept is one whose answer is yes";
  }
}

TEST(ThresholdSearch, TakesTwelveHalvingsForTwelveBits) {
  const StillEngine engine;
  record(engine, question(20), {}, 0.5);
  EXPECT_EQ(engine.built(), 2 + 12);  // 40/2^12 < 0.01
}

TEST(ThresholdSearch, GoesTheOtherWayWhereYesLiesBelow) {
  Scenario s = question(20);
  s.threshold->exact_above = false;
  s.threshold->answer = [](const Trajectory& run) { return run.at(0, 0).p_WB.x() < 30; };
  const Recording found = record(StillEngine(), s, {}, 0.5);
  EXPECT_GE(found.critical->no, 30);
  EXPECT_LT(found.critical->yes, 30);
  EXPECT_LE(found.critical->no - found.critical->yes, 0.01);
}

TEST(ThresholdSearch, EndsAtTheEndOfTheRangeWhereTheAnswerNeverChanges) {
  const Bracket never = *record(StillEngine(), question(1000), {}, 0.5).critical;
  EXPECT_EQ(never.no, 50);
  EXPECT_EQ(never.yes, 50);
  const Bracket always = *record(StillEngine(), question(-1000), {}, 0.5).critical;
  EXPECT_EQ(always.no, 10);
  EXPECT_EQ(always.yes, 10);
}

TEST(ThresholdSearch, ARunThatLeavesTheNumbersIsNoAnswer) {
  const Recording found = record(StillEngine(), question(20, 100), {}, 0.5);
  EXPECT_TRUE(found.not_finite_at);
}

}  // namespace
}  // namespace plumbline
