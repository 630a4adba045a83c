// Contacts as the scenario states them: which coefficients act, where surfaces stand, what stays apart.
#include <cmath>
#include <cstring>

#include "conformance_row.hpp"

namespace plumbline {
namespace {

// Every profile must get these right; ContactLaw below asks only the matched one.
using Contact = ConformanceCase;
INSTANTIATE_TEST_SUITE_P(Rows, Contact, testing::ValuesIn(conformance_rows({Profile::kDefault, Profile::kMatched})),
                         [](const auto& row) { return row_name(row.param); });
using ContactLaw = ConformanceCase;
INSTANTIATE_TEST_SUITE_P(Rows, ContactLaw, testing::ValuesIn(conformance_rows({Profile::kMatched})),
                         [](const auto& row) { return row_name(row.param); });

// Engines soften contacts a little, so that their equations stay solvable (1e-7 of the speed is seen); a coefficient
// that was combined by another rule (product, root) is off by a fifth at least. In between, near the first.
constexpr double kSoftness = 1e-5;

bool same_bits(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(BodyState)) == 0;
}

// Balls and boxes that fall, touch and rest: whatever an engine keeps between steps is in use.
Scenario busy_scene(double shift) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{0.3, 0.4};
  scenario.bodies = {half_space(Vec3::UnitZ()), ball("ball", 0.2, 1, Vec3(shift, 0, 0.5), Vec3(1, 0, 0)),
                     ball("other", 0.3, 3, Vec3(shift + 0.6, 0, 0.5), Vec3(-1, 0, 0)),
                     box("low", Vec3(1, 1, 1), 10, Vec3(3 + shift, 0, 0.6)),
                     box("high", Vec3(0.8, 0.8, 0.8), 5, Vec3(3.1 + shift, 0, 1.7))};
  return scenario;
}

TEST_P(Contact, SameRunTwiceGivesTheSameBits) {
  const Scenario scenario = busy_scene(0);
  if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  const auto first = run(*build(scenario), scenario, kStep, 128);
  const auto again = run(*build(scenario), scenario, kStep, 128);
  EXPECT_TRUE(same_bits(first, again));
}

TEST_P(Contact, TwoWorldsDoNotMix) {
  const Scenario one = busy_scene(0), two = busy_scene(0.07);
  if (const std::string lack = missing(one); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  const auto one_alone = run(*build(one), one, kStep, 128);
  const auto two_alone = run(*build(two), two, kStep, 128);
  ASSERT_FALSE(same_bits(one_alone, two_alone));
  const auto one_world = build(one), two_world = build(two);
  for (int k = 0; k < 128; ++k) {
    one_world->step(kStep);
    two_world->step(kStep);
  }
  EXPECT_TRUE(same_bits(states_of(*one_world, one), one_alone));
  EXPECT_TRUE(same_bits(states_of(*two_world, two), two_alone));
}

TEST_P(Contact, WithoutMaterialBodiesPassThroughEachOther) {
  Scenario scenario;
  scenario.bodies = {half_space(Vec3::UnitX(), Vec3(0, 0, 0)), ball("ball", 0.1, 1, Vec3(-0.5, 0, 0), Vec3(2, 0, 0)),
                     ball("other", 0.1, 1, Vec3(0.5, 0, 0), Vec3(-2, 0, 0)),
                     box("box", Vec3(0.2, 0.2, 0.2), 1, Vec3(0, 0, 0.3), Vec3(0, 0, -2))};
  const auto s = run(*build(scenario), scenario, kStep, 32);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(s[i].v_WB, scenario.bodies[i].initial.v_WB) << scenario.bodies[i].name;
  }
}

TEST_P(Contact, BoxCollidesInTheAttitudeItIsStatedIn) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{0, 0};
  scenario.bodies = {half_space(Vec3::UnitZ()), box("plank", Vec3(2, 0.5, 0.5), 1, Vec3(0, 0, 1))};
  scenario.bodies[1].initial.q_WB = quarter_turn_about_y();
  if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  // It stands on end, 2 m high, and stays. Lying flat it would fall 0.44 m in this time; shells and the depths that
  // solvers leave alone are some centimetres at most.
  const auto s = run(*build(scenario), scenario, kStep, 19);
  EXPECT_NEAR(s[1].p_WB.z(), 1, 0.1);
}

TEST_P(ContactLaw, RestitutionOfThePairActsBetweenBalls) {
  for (double e : {0.0, 0.5, 1.0}) {
    Scenario scenario;
    scenario.contact = ContactMaterial{e, 0};
    scenario.bodies = {ball("a", 0.1, 2, Vec3(0, 0, 0), Vec3(3, 0, 0)),
                       ball("b", 0.2, 5, Vec3(0.72, 0, 0), Vec3(-1, 0, 0))};
    if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
    const auto s = run(*build(scenario), scenario, kStep, 32);
    const double approach = 4;
    EXPECT_NEAR(s[1].v_WB.x() - s[0].v_WB.x(), e * approach, kSoftness * approach) << "e = " << e;
    // Momentum: 2 * 3 - 5 * 1.
    EXPECT_NEAR(2 * s[0].v_WB.x() + 5 * s[1].v_WB.x(), 1, 64 * roundoff() * 11) << "e = " << e;
  }
}

TEST_P(ContactLaw, HalfSpaceStandsWhereItIsStatedWhateverItsAttitude) {
  for (double e : {0.5, 0.9}) {
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(-1, 0, 0)}) {
      const Vec3 foot(1, 0, -2);
      const double radius = 0.25, speed = 2, gap = 0.53;
      Scenario scenario;
      scenario.contact = ContactMaterial{e, 0};
      // Off to the side by half a metre, so that the position of the half-space along its surface does not matter.
      const Vec3 along(-n.z(), 0, n.x());
      scenario.bodies = {half_space(n, foot),
                         ball("ball", radius, 3, foot + 0.5 * along + (radius + gap) * n, -speed * n)};
      scenario.bodies[0].initial.q_WB = quarter_turn_about_y();
      if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
      const int steps = 40;
      const BodyState s = run(*build(scenario), scenario, kStep, steps)[1];
      EXPECT_LE((s.v_WB - e * speed * n).norm(), kSoftness * speed) << n.transpose() << " e = " << e;
      const double rise = e * (speed * kStep * steps - gap);
      // A stepping engine sees the impact up to one step late, and may handle it one step after that.
      EXPECT_NEAR((s.p_WB - foot).dot(n) - radius, rise, 2 * speed * kStep * (1 + e)) << n.transpose();
    }
  }
}

TEST_P(ContactLaw, FixedBodiesStayAndSendOthersBack) {
  Scenario scenario;
  scenario.contact = ContactMaterial{1, 0};
  scenario.bodies = {ball("post", 0.3, 1, Vec3(0, 0, 0)), ball("ball", 0.1, 1, Vec3(0.93, 0, 0), Vec3(-2, 0, 0))};
  scenario.bodies[0].fixed = true;
  if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  const auto s = run(*build(scenario), scenario, kStep, 32);
  EXPECT_EQ(s[0].p_WB, scenario.bodies[0].initial.p_WB);
  EXPECT_LE((s[1].v_WB - Vec3(2, 0, 0)).norm(), 2 * kSoftness);
}

TEST_P(ContactLaw, SlidingIsBrakedByTheFrictionOfThePair) {
  for (double mu : {0.2, 0.5}) {
    Scenario scenario;
    scenario.gravity = Vec3(0, 0, -9.81);
    scenario.contact = ContactMaterial{0, mu};
    scenario.bodies = {half_space(Vec3::UnitZ()), box("sled", Vec3(1, 1, 0.5), 20, Vec3(0, 0, 0.25), Vec3(3, 0, 0))};
    if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
    const double dt = 1.0 / 256;
    const int steps = 64;
    const BodyState s = run(*build(scenario), scenario, dt, steps)[1];
    // Friction of two steps may be missing or double while the contact settles; the product of two coefficients or
    // the root of one would be off by half of mu and more.
    const double loss = mu * 9.81 * dt * steps;
    EXPECT_NEAR(3 - s.v_WB.x(), loss, 2.0 / steps * loss) << "mu = " << mu;
  }
}

TEST_P(ContactLaw, BoxLandsAndRestsAtHalfItsHeight) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{0, 0};
  scenario.bodies = {half_space(Vec3::UnitZ()), box("crate", Vec3(1, 1, 1), 1000, Vec3(0, 0, 2.5))};
  if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  const auto world = build(scenario);
  const BodyState s = run(*world, scenario, kStep, 256)[1];
  // The deepest and the thickest that engines leave alone for good is a centimetre.
  EXPECT_NEAR(s.p_WB.z(), 0.5, 0.01);
  // At rest: slower than gravity makes it within one step.
  EXPECT_LE(s.v_WB.norm(), 9.81 * kStep);
  EXPECT_LE(geodesic_angle(s.q_WB, Quat::Identity()), 0.01);
}

}  // namespace
}  // namespace plumbline
