#include "plumbline/core/constraints/tethered_particle.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "particle_scenes.hpp"

namespace plumbline {
namespace {

using namespace particles;
constexpr double kG = 9.81;
const Vec3 kGravity(0, 0, -kG);
using Kind = TetherEvent::Kind;

double energy(const TetheredParticle& particle) {
  return 0.5 * particle.velocity().squaredNorm() - kGravity.dot(particle.position());
}

// Let go level with the anchor: sin(theta/2) = k sn(K - w0 t, k), k = sin 45 degrees.
TEST(TetheredParticle, SwingsLikeTheExactPendulum) {
  TetheredParticle pendulum({}, kGravity, Vec3(-1, 0, 0), Vec3::Zero());
  EXPECT_TRUE(pendulum.is_taut());
  pendulum.advance_to(1);
  // Published (IFToMM benchmark A01): 0.98629175, -0.16501086. A Taylor series of 30 terms in 40 decimals says more.
  EXPECT_NEAR(pendulum.position().x(), 0.98629175, 1e-8);
  EXPECT_NEAR(pendulum.position().z(), -0.16501086, 1e-8);
  EXPECT_NEAR(pendulum.position().x(), 0.98629175113187531, 1e-14);
  EXPECT_NEAR(pendulum.position().z(), -0.16501085312554116, 1e-14);
  const double period = 4 * std::comp_ellint_1(std::sqrt(0.5)) / std::sqrt(kG);
  pendulum.advance_to(10 * period);
  // Ten periods; near the turning point the height follows time in second order, the speed in first: g dt.
  EXPECT_LE((pendulum.position() - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LE(pendulum.velocity().norm(), 1e-12);
  EXPECT_NEAR(energy(pendulum), 0, 1e-13);
  EXPECT_TRUE(pendulum.events().empty());
  // At the bottom: T = m (g + v^2/l) = 3 m g.
  pendulum.advance_to(10.25 * period);
  EXPECT_NEAR(pendulum.tension_per_mass(), 3 * kG, 1e-11);
}

TEST(TetheredParticle, ReachesAnglesAtTheTimesOfTheEllipticIntegral) {
  // From the bottom with v0 < 2 sqrt(g l): sin(phi) = sin(theta/2)/k, k = v0/(2 sqrt(g l)), t = F(phi, k)/sqrt(g/l).
  const double length = 2, v0 = 4, w0 = std::sqrt(kG / length), k = v0 / (2 * std::sqrt(kG * length));
  TetheredParticle pendulum({Vec3::Zero(), length, 0}, kGravity, Vec3(0, 0, -length), Vec3(v0, 0, 0));
  for (const double theta : {0.1, 0.3, 0.5, 0.9}) {
    pendulum.advance_to(std::ellint_1(k, std::asin(std::sin(theta / 2) / k)) / w0);
    const Vec3 expected(length * std::sin(theta), 0, -length * std::cos(theta));
    EXPECT_LE((pendulum.position() - expected).norm(), 2e-14) << theta;  // ellint_1's own 1e-15, times v
  }
}

TEST(TetheredParticle, KeepsEnergyAndSpinAsASphericalPendulum) {
  const Vec3 p = Vec3(1, 2, -2) / 3, v = Vec3(2, 0, 1) * 1.5;  // v . p = 0
  TetheredParticle pendulum({}, kGravity, p, v);
  const double e0 = energy(pendulum), spin0 = p.x() * v.y() - p.y() * v.x();
  for (int k = 1; k <= 100; ++k) {
    pendulum.advance_to(0.1 * k);
    const Vec3 &r = pendulum.position(), &u = pendulum.velocity();
    EXPECT_NEAR(r.norm(), 1, 2 * kEps);
    EXPECT_NEAR(energy(pendulum), e0, 1e-12);  // some 300 Taylor steps, each of a few roundings of 20 J/kg
    EXPECT_NEAR(r.x() * u.y() - r.y() * u.x(), spin0, 1e-13);
  }
  // The conical pendulum goes round at constant height: w^2 = g/(l cos).
  const double cone = 0.7, w = std::sqrt(kG / std::cos(cone));
  TetheredParticle conical({}, kGravity, Vec3(std::sin(cone), 0, -std::cos(cone)), Vec3(0, w * std::sin(cone), 0));
  conical.advance_to(10);
  const Vec3 expected(std::sin(cone) * std::cos(10 * w), std::sin(cone) * std::sin(10 * w), -std::cos(cone));
  EXPECT_LE((conical.position() - expected).norm(), 1e-12);  // 36 radians to a few hundred roundings
}

// From the bottom with 2 g l < v0^2 < 5 g l it cannot get round: slack at cos(theta) = -(v0^2/(g l) - 2)/3.
TEST(TetheredParticle, GoesSlackAndTautAgainAtTheExactTimes) {
  const double length = 1, v0 = 6.5, w0 = std::sqrt(kG),
               k = 2 * w0 / v0;  // k < 1: fast enough to pass the top, if a rod
  TetheredParticle particle({Vec3::Zero(), length, 0}, kGravity, Vec3(0, 0, -length), Vec3(v0, 0, 0));
  particle.advance_to(1.3);
  ASSERT_GE(particle.events().size(), 2u);
  const double cosine = -(v0 * v0 / kG - 2) / 3, theta = std::acos(cosine);
  ASSERT_LT(k, 1);
  // theta' = v0/l sqrt(1 - k^2 sin^2(theta/2)): t = 2 l/v0 F(theta/2, k).
  const double slack = 2 * length / v0 * std::ellint_1(k, theta / 2);
  EXPECT_EQ(particle.events()[0].kind, Kind::kSlack);
  EXPECT_NEAR(particle.events()[0].time, slack, 1e-14);
  // The flight has a triple zero at its start: it ends after -4 v.g/g^2, v the speed along the circle.
  const double speed = std::sqrt(-kG * length * cosine);
  const double flight = 4 * speed * std::sin(theta) / kG;  // v points up by sin(theta)
  EXPECT_EQ(particle.events()[1].kind, Kind::kTaut);
  EXPECT_NEAR(particle.events()[1].time, slack + flight, 1e-13);
  // A second check of that formula: the end of the parabola is on the circle again.
  const Vec3 p(std::sin(theta), 0, -cosine), v = speed * Vec3(cosine, 0, std::sin(theta));
  EXPECT_NEAR(after({p, v, kGravity}, flight).p_W.norm(), length, 1e-14);
}

TEST(TetheredParticle, ThatDropsOnItsStringLosesTheSpeedAlongIt) {
  // Dropped 0.6 m beside the anchor: taut after falling 0.8 m, at (0.6, -0.8); what is left of v is its part across.
  TetheredParticle stone({}, kGravity, Vec3(0.6, 0, 0), Vec3::Zero());
  EXPECT_FALSE(stone.is_taut());
  const double taut = std::sqrt(2 * 0.8 / kG), speed = kG * taut;
  stone.advance_to(taut + 1e-13);
  ASSERT_EQ(stone.events().size(), 1u);
  EXPECT_EQ(stone.events()[0].kind, Kind::kTaut);
  EXPECT_NEAR(stone.events()[0].time, taut, 4 * kEps);
  EXPECT_LE((stone.velocity() - 0.6 * speed * Vec3(-0.8, 0, -0.6)).norm(), 1e-11);  // 1e-13 s later
  stone.advance_to(5);
  EXPECT_EQ(stone.events().size(), 1u);  // swings on, never above its start
  EXPECT_NEAR(energy(stone), 0.5 * 0.36 * speed * speed - kG * 0.8, 1e-12);
}

TEST(TetheredParticle, OnAnElasticStringBouncesAndKeepsItsEnergy) {
  TetheredParticle stone({Vec3::Zero(), 1, 1}, kGravity, Vec3(0.6, 0, 0), Vec3::Zero());
  stone.advance_to(20);
  EXPECT_GT(stone.events().size(), 20u);
  for (const TetherEvent& event : stone.events()) EXPECT_EQ(event.kind, Kind::kBounce);
  EXPECT_NEAR(energy(stone), 0, 1e-12);
  // Straight below the anchor, a bouncing ball hung upside down: falls for t0, and each return takes 2 v/g.
  TetheredParticle ball({Vec3::Zero(), 1, 1}, kGravity, Vec3::Zero(), Vec3::Zero());
  ball.advance_to(2);
  const double t0 = std::sqrt(2 / kG);
  for (std::size_t k = 0; k < ball.events().size(); ++k)
    EXPECT_NEAR(ball.events()[k].time, (2 * static_cast<double>(k) + 1) * t0, 1e-14);
  EXPECT_EQ(ball.events().size(), 2u);
}

TEST(TetheredParticle, WhoseBouncesDieOutEndsTaut) {
  // Straight down with e = 1/2: it bounces up from the string's end like a ball from the floor, and the series ends.
  const double e = 0.5, t0 = std::sqrt(2 / kG);
  TetheredParticle stone({Vec3::Zero(), 1, e}, kGravity, Vec3::Zero(), Vec3::Zero());
  stone.advance_to(3);
  EXPECT_TRUE(stone.is_taut());
  EXPECT_EQ(stone.events().back().kind, Kind::kTaut);
  // The rule leaves out bounces slower than 1e-7 of about 4.4 m/s, that is 2e-7 s.
  EXPECT_NEAR(stone.events().back().time, t0 * (1 + e) / (1 - e), 4e-7);
  EXPECT_LE((stone.position() - Vec3(0, 0, -1)).norm(), 1e-13);
  EXPECT_NEAR(stone.tension_per_mass(), kG, 1e-12);
}

TEST(TetheredParticle, WithoutGravityGoesStraightAndThenRound) {
  TetheredParticle stone({Vec3::Zero(), 1, 0}, Vec3::Zero(), Vec3(0.6, 0, 0), Vec3(0, 2, 0));
  stone.advance_to(0.4 + std::numbers::pi / 1.2);  // taut at (0.6, 0.8), then 1.2 m/s round half the circle
  EXPECT_EQ(stone.events().size(), 1u);
  EXPECT_NEAR(stone.events()[0].time, 0.4, 4 * kEps);
  EXPECT_LE((stone.position() - Vec3(-0.6, -0.8, 0)).norm(), 1e-13);
}

TEST(TetheredParticle, RefusesNonsense) {
  const auto make = [](const Tether& tether, const Vec3& p) { TetheredParticle(tether, kGravity, p, Vec3::Zero()); };
  EXPECT_THROW(make({Vec3::Zero(), 0, 0}, Vec3::Zero()), std::invalid_argument);
  EXPECT_THROW(make({Vec3::Zero(), 1, 2}, Vec3::Zero()), std::invalid_argument);
  EXPECT_THROW(make({}, Vec3(2, 0, 0)), std::invalid_argument);
  EXPECT_THROW(make({}, Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)), std::invalid_argument);
  TetheredParticle stone({}, kGravity, Vec3::Zero(), Vec3::Zero());
  stone.advance_to(1);
  EXPECT_THROW(stone.advance_to(0.5), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
