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

// Bodies that fall, touch and rest: whatever an engine keeps between steps is in use. First all kinds together, then
// simpler scenes for an engine that lacks some pair of shapes.
std::vector<Scenario> busy_scenes(double shift) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{0.3, 0.4};
  const std::vector<Body> ground = {half_space(Vec3::UnitZ())};
  const std::vector<Body> balls = {ball("ball", 0.2, 1, Vec3(shift, 0, 0.5), Vec3(1, 0, 0)),
                                   ball("other", 0.3, 3, Vec3(shift + 0.6, 0, 0.5), Vec3(-1, 0, 0))};
  const std::vector<Body> boxes = {box("low", Vec3(1, 1, 1), 10, Vec3(3 + shift, 0, 0.6)),
                                   box("high", Vec3(0.8, 0.8, 0.8), 5, Vec3(3.1 + shift, 0, 1.7))};
  const auto with = [&](std::initializer_list<std::vector<Body>> groups) {
    Scenario s = scenario;
    for (const auto& group : groups) s.bodies.insert(s.bodies.end(), group.begin(), group.end());
    return s;
  };
  return {with({ground, balls, boxes}), with({ground, balls}), with({ground, {boxes[0]}})};
}

TEST_P(Contact, SameRunTwiceGivesTheSameBits) {
  int ran = 0;
  for (const Scenario& scenario : busy_scenes(0)) {
    if (!missing(scenario).empty()) continue;
    const auto first = run(*build(scenario), scenario, kStep, 128);
    const auto again = run(*build(scenario), scenario, kStep, 128);
    EXPECT_TRUE(same_bits(first, again));
    ++ran;
  }
  if (ran == 0) GTEST_SKIP() << "lacks " << missing(busy_scenes(0).back());
}

TEST_P(Contact, TwoWorldsDoNotMix) {
  const auto ones = busy_scenes(0), twos = busy_scenes(0.07);
  int ran = 0;
  for (std::size_t i = 0; i < ones.size(); ++i) {
    const Scenario &one = ones[i], &two = twos[i];
    if (!missing(one).empty()) continue;
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
    ++ran;
  }
  if (ran == 0) GTEST_SKIP() << "lacks " << missing(ones.back());
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

// Ties the sign of rotation to the directions of the plane: a mirrored one would agree with itself everywhere else.
TEST_P(Contact, BallThatSpinsAboutYRollsTowardsX) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{0, 0.5};
  scenario.bodies = {half_space(Vec3::UnitZ()), ball("ball", 0.2, 1, Vec3(0, 0, 0.201))};
  scenario.bodies[1].initial.w_WB = Vec3(0, 10, 0);
  if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  const BodyState s = run(*build(scenario), scenario, kStep, 32)[1];
  EXPECT_GT(s.v_WB.x(), 0.01);
  EXPECT_LT(s.w_WB.y(), 10);
  EXPECT_GT(s.w_WB.y(), 0);
}

TEST_P(ContactLaw, RestitutionOfThePairActsBetweenBallsAtEverySpeed) {
  // Engines like to take slow impacts for e = 0; the scenario states no such speed.
  for (double pace : {1.0, 0.01}) {
    for (double e : {0.0, 0.5, 1.0}) {
      Scenario scenario;
      scenario.contact = ContactMaterial{e, 0};
      scenario.bodies = {ball("a", 0.1, 2, Vec3(0, 0, 0), Vec3(3 * pace, 0, 0)),
                         ball("b", 0.2, 5, Vec3(0.3 + 0.42 * pace, 0, 0), Vec3(-pace, 0, 0))};
      if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
      const auto s = run(*build(scenario), scenario, kStep, 32);
      const double approach = 4 * pace;
      EXPECT_NEAR(s[1].v_WB.x() - s[0].v_WB.x(), e * approach, kSoftness * approach) << "e = " << e << ", " << approach;
      // Momentum: 2 * 3 - 5 * 1; each of 32 steps may round both velocities.
      EXPECT_NEAR(2 * s[0].v_WB.x() + 5 * s[1].v_WB.x(), pace, 64 * roundoff() * 11 * pace) << "e = " << e;
    }
  }
}

// `n` is the outward normal; the ball flies straight at the surface and back.
void expect_rebound(const Engine& engine, const Settings& settings, const Vec3& n, double e, double dt) {
  const Vec3 foot(1, 0, -2);
  const double radius = 0.25, speed = 2, gap = 0.53;
  Scenario scenario;
  scenario.contact = ContactMaterial{e, 0};
  // Off to the side, since the half-space has no end along its surface.
  const Vec3 start = foot + 0.5 * Vec3(-n.z(), 0, n.x()) + (radius + gap) * n;
  scenario.bodies = {half_space(n, foot), ball("ball", radius, 3, start, -speed * n)};
  scenario.bodies[0].initial.q_WB = quarter_turn_about_y();
  const double duration = 0.625;
  const auto world = engine.build(scenario, settings);
  const BodyState s = run(*world, scenario, dt, static_cast<int>(duration / dt))[1];
  EXPECT_LE((s.v_WB - e * speed * n).norm(), kSoftness * speed) << n.transpose() << ", e = " << e << ", dt = " << dt;
  // A stepping engine sees the impact up to one step late, and may answer one step after that.
  const double distance = (s.p_WB - foot).dot(n) - radius;
  EXPECT_NEAR(distance, e * (speed * duration - gap), 2 * speed * dt * (1 + e)) << n.transpose() << ", dt = " << dt;
}

TEST_P(ContactLaw, HalfSpaceStandsWhereItIsStatedWhateverItsAttitude) {
  if (!has(Feature::kSphereHalfSpace) || !has(Feature::kRestitution)) GTEST_SKIP() << "no rebound from a half-space";
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(-1, 0, 0)}) {
    // The small step: a contact that acts before the surfaces meet takes the speed away before e can return it.
    for (double dt : {kStep, kStep / 16}) {
      for (double e : {0.5, 0.9}) expect_rebound(engine(), settings(), n, e, dt);
    }
  }
}

TEST_P(ContactLaw, SlowBodiesStayAwake) {
  if (!has(Feature::kForce)) GTEST_SKIP() << "no forces";
  Scenario scenario;
  const double creep = 1e-3;
  scenario.bodies = {ball("ball", 0.1, 1, Vec3::Zero(), Vec3(creep, 0, 0))};
  const auto world = build(scenario);
  const double duration = 4;  // twice as long as the most patient engine waits
  const BodyState s = run(*world, scenario, kStep, static_cast<int>(duration / kStep))[0];
  EXPECT_NEAR(s.p_WB.x(), creep * duration, 2 * duration / kStep * roundoff() * creep * duration);
  const Wrench wrench{Vec3(0, 0, 1), Vec3::Zero()};
  world->apply({&wrench, 1});
  EXPECT_GT(run(*world, scenario, kStep, 1)[0].v_WB.z(), 0) << "a force on a body at rest was lost";
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

TEST_P(ContactLaw, BoxLandsFlatAndRestsAtHalfItsHeight) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -9.81);
  scenario.contact = ContactMaterial{0, 0};
  scenario.bodies = {half_space(Vec3::UnitZ()), box("crate", Vec3(1, 1, 1), 1000, Vec3(0, 0, 2.5))};
  if (const std::string lack = missing(scenario); !lack.empty()) GTEST_SKIP() << "lacks " << lack;
  const auto world = build(scenario);
  BodyState s;
  double tilt = 0;
  for (int k = 0; k < 256; ++k) {
    s = run(*world, scenario, kStep, 1)[1];
    tilt = std::max(tilt, geodesic_angle(s.q_WB, Quat::Identity()));
  }
  // Nothing in the problem turns the box: it lands on a whole face. An iterative solver leaves the corners' impulses
  // unequal by a small share; one that knows only some of the corners turns it by v/size times a step or more.
  EXPECT_LE(tilt, 0.1 * std::sqrt(2 * 9.81 * 2) * kStep / 1);
  // The deepest and the thickest that engines leave alone for good is a centimetre.
  EXPECT_NEAR(s.p_WB.z(), 0.5, 0.01);
  // At rest: slower than gravity makes it within one step.
  EXPECT_LE(s.v_WB.norm(), 9.81 * kStep);
}

}  // namespace
}  // namespace plumbline
