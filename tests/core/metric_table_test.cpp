#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "plumbline/core/gate.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// One moving body of 2 kg beside a fixed one, three samples 1 s apart, gravity 10 m/s^2. The reference stays at the
// origin; energy scale 2 (2/1)^2 = 8 J, momentum scale 2 * 2/1 = 4 kg m/s.
class MetricTable : public ::testing::Test {
 protected:
  MetricTable() : actual(1, 2), expected(1, 2) {
    scenario.gravity = Vec3(0, 0, -10);
    scenario.duration = 2;
    scenario.scales = {2, 1, 2};
    scenario.bodies.resize(2);
    scenario.bodies[0].fixed = true;
    scenario.bodies[1].mass = 2;
    scenario.bodies[1].shape = Sphere{1};
    scenario.bodies[1].inertia = Vec3(2, 2, 4);
    scenario.joints = {joint_at(JointKind::kBall, kWorld, 1, {BodyState(), BodyState()}, Vec3::Zero())};
    for (int k = 0; k < 3; ++k) {
      actual.append();
      expected.append();
    }
    // The fixed body must not count, however far it is off.
    for (std::size_t k = 0; k < 3; ++k) actual.at(k, 0).p_WB = Vec3(100, 0, 0);
    BodyState& one = actual.at(1, 1);
    one.p_WB = Vec3(3, 0, -4);
    one.v_WB = Vec3(0, 0, 2);
    one.q_WB = rotation_by(Vec3(0, 0, 0.3));
    one.w_WB = Vec3(0, 0.5, 0);
    BodyState& two = actual.at(2, 1);
    two.p_WB = Vec3(0, 0, 1);
    two.v_WB = Vec3(1, 0, 0);
    two.q_WB = rotation_by(Vec3(0, 0, -0.1));
    two.q_WB.coeffs() *= -1;
    two.w_WB = Vec3(0, 0, 0.25);
  }
  Comparison comparison(bool in_plane = false) const { return {scenario, actual, expected, in_plane}; }
  double measure(const std::string& name, bool in_plane = false) const {
    return find_metric(name)->measure(comparison(in_plane));
  }

  Scenario scenario;
  Trajectory actual, expected;
};

TEST_F(MetricTable, EachMetricHasItsHandComputedValue) {
  // Energies: 1/2*2*4 + 1/2*2*0.25 - 2*10*4 = -75.75 J and 1/2*2*1 + 1/2*4*0.0625 + 2*10*1 = 21.125 J.
  // Angular momenta: (3,0,-4) x (0,0,4) + (0,1,0) = (0,-11,0) and (0,0,1) x (2,0,0) + (0,0,1) = (0,2,1).
  const std::map<std::string, double> by_hand = {
      {"position.max", 5},
      {"position.rms", std::sqrt(26.0 / 3)},
      {"position.final", 1},
      {"velocity.max", 2},
      {"velocity.rms", std::sqrt(5.0 / 3)},
      {"velocity.final", 1},
      {"attitude.max", 0.3},
      {"attitude.rms", std::sqrt(0.10 / 3)},
      {"attitude.final", 0.1},
      {"angular_velocity.max", 0.5},
      {"angular_velocity.rms", std::sqrt(0.3125 / 3)},
      {"angular_velocity.final", 0.25},
      {"energy.max", -75.75 / 8},
      {"energy.final", 21.125 / 8},
      {"momentum.max", 1},
      {"momentum.final", 0.5},
      {"angular_momentum.max", 11.0 / 8},
      {"angular_momentum.final", std::sqrt(5.0) / 8},
      {"joint_gap.max", 4},
  };
  for (const auto& [name, value] : by_hand) {
    ASSERT_NE(find_metric(name), nullptr) << name;
    EXPECT_NEAR(measure(name), value, 16 * kEps * std::abs(value)) << name;
  }
  for (const Metric& metric : metrics()) {
    if (metric.applies(scenario)) {
      EXPECT_TRUE(by_hand.count(std::string(metric.name)) == 1) << metric.name;
    }
  }
}

TEST_F(MetricTable, PointwiseMetricsLookNoFurtherThanTheTimeOfValidity) {
  scenario.t_valid = 1;
  EXPECT_EQ(measure("position.max"), 5);
  EXPECT_EQ(measure("position.final"), 5);
  EXPECT_NEAR(measure("energy.final"), 21.125 / 8, 1e-14) << "what is conserved stays so";
  scenario.t_valid = 0.5;
  EXPECT_EQ(measure("position.max"), 0);
}

TEST_F(MetricTable, ATableIsComparedAtItsOwnTimesOnly) {
  scenario.known_at = {2};
  EXPECT_EQ(measure("position.max"), 1);
  EXPECT_EQ(measure("position.rms"), 1);
  EXPECT_FALSE(find_metric("energy.max")->applies(scenario));
  scenario.known_at = {0.5};  // at no sample: there is nothing to say
  EXPECT_TRUE(std::isnan(measure("position.final")));
}

TEST_F(MetricTable, InvariantsSayNothingAboutPlaces) {
  scenario.pointwise = false;
  EXPECT_FALSE(find_metric("position.max")->applies(scenario));
  EXPECT_FALSE(find_metric("angular_velocity.rms")->applies(scenario));
  EXPECT_TRUE(find_metric("energy.max")->applies(scenario));
  EXPECT_TRUE(find_metric("angular_momentum.max")->applies(scenario));
}

TEST_F(MetricTable, AThresholdIsMeasuredByItsBracketAndNothingElse) {
  scenario.threshold.emplace();
  scenario.threshold->exact = 20;
  for (const Metric& metric : metrics()) {
    EXPECT_EQ(metric.applies(scenario), metric.name.starts_with("threshold.")) << metric.name;
  }
  Comparison c = comparison();
  EXPECT_TRUE(std::isnan(find_metric("threshold.error")->measure(c))) << "no search, no value";
  c.critical = Bracket{20.5, 21.5};
  EXPECT_EQ(find_metric("threshold.value")->measure(c), 21);
  EXPECT_EQ(find_metric("threshold.error")->measure(c), 1);
}

TEST_F(MetricTable, JointGapIsHowFarTheAnchorsArePartedAtMost) {
  EXPECT_EQ(measure("joint_gap.max"), 4);  // of the gap (3, 0, -4) the largest component along an axis of W
  scenario.joints.clear();
  EXPECT_FALSE(find_metric("joint_gap.max")->applies(scenario));
}

TEST_F(MetricTable, IsZeroForTheReferenceItself) {
  const Comparison same{scenario, expected, expected};
  for (const Metric& metric : metrics()) {
    if (metric.applies(scenario)) {
      EXPECT_EQ(metric.measure(same), 0) << metric.name;
    }
  }
}

TEST_F(MetricTable, InThePlaneOnlyThePlaneCounts) {
  actual.at(1, 1).p_WB.y() = 77;
  actual.at(1, 1).v_WB.y() = 77;
  EXPECT_EQ(measure("position.max", true), 5);
  EXPECT_EQ(measure("velocity.max", true), 2);
  EXPECT_EQ(measure("angular_velocity.final", true), 0);  // the last spin is about z, out of the plane
  EXPECT_NEAR(measure("energy.final", true), 21.0 / 8, 16 * kEps * 21.0 / 8);
  EXPECT_GT(measure("position.max"), 77);
}

TEST_F(MetricTable, NanSticksInEveryMetric) {
  scenario.bodies[1].name = "ball";
  scenario.events = {{"impact", 1, 0, 0.5}};
  expected.at(0, 1).v_WB = Vec3(0, 0, -1);
  expected.at(1, 1).v_WB = Vec3(0, 0, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    BodyState& s = actual.at(k, 1);
    s.p_WB.x() = s.v_WB.x() = s.w_WB.x() = kNan;
    s.q_WB.x() = kNan;
  }
  for (const Metric& metric : metrics()) {
    if (metric.name.starts_with("threshold.")) continue;  // not of a trajectory: a search gives a number or fails
    ASSERT_TRUE(metric.applies(scenario)) << metric.name;
    const double value = metric.measure(comparison());
    if (metric.name == "events.missed") {
      EXPECT_EQ(value, 1);  // a number that is not one shows no event
    } else {
      EXPECT_FALSE(within(value, std::numeric_limits<double>::max())) << metric.name << " = " << value;
    }
  }
}

TEST_F(MetricTable, AnEarlyNanIsNotForgottenLater) {
  actual.at(1, 1).p_WB.z() = actual.at(1, 1).v_WB.z() = actual.at(1, 1).w_WB.z() = actual.at(1, 1).q_WB.z() = kNan;
  for (const Metric& metric : metrics()) {
    if (!metric.applies(scenario)) continue;
    const bool final_sample = metric.name.ends_with(".final");
    EXPECT_EQ(std::isnan(metric.measure(comparison())), !final_sample) << metric.name;
  }
  EXPECT_TRUE(std::isnan(position_distance(actual, expected)));
  EXPECT_TRUE(std::isnan(position_distance(expected, actual)));
}

TEST_F(MetricTable, NamesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const Metric& metric : metrics()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    EXPECT_EQ(find_metric(metric.name), &metric);
    EXPECT_NE(metric.name.find('.'), std::string_view::npos);
  }
  EXPECT_EQ(find_metric("position"), nullptr);
}

TEST_F(MetricTable, PositionDistanceIsTheLargestOverBodiesAndSamples) {
  EXPECT_EQ(position_distance_at(actual, expected, 1), 100);  // between engines a fixed body counts as well
  actual.at(1, 0).p_WB = Vec3(0, 7, 0);
  EXPECT_EQ(position_distance_at(actual, expected, 1), 7);
  EXPECT_EQ(position_distance_at(actual, expected, 1, true), 5);
  EXPECT_EQ(position_distance(actual, expected), 100);
}

}  // namespace
}  // namespace plumbline
