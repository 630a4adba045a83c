#include "plumbline/core/response/impulse.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "kinetic_scenes.hpp"
#include "plumbline/core/invariant.hpp"

namespace plumbline {
namespace {

using namespace scenes;

constexpr double kEps = std::numeric_limits<double>::epsilon();

struct Scene {
  std::vector<Body> bodies;
  std::vector<BodyState> states;
  std::vector<Inertness> inertness;
  std::vector<Contact> contacts;

  explicit Scene(std::vector<Body> all) : bodies(std::move(all)) {
    for (const Body& b : bodies) {
      states.push_back(b.initial);
      inertness.push_back(inertness_of(b, b.initial.q_WB));
    }
    for (const Pair pair : contact_pairs(bodies)) append_contacts(bodies, states, pair, contacts);
    std::erase_if(contacts, [](const Contact& c) { return c.gap > 1e-9; });
  }
  std::vector<ImpactPoint> points(double restitution, double friction) const {
    std::vector<ImpactPoint> result;
    for (const Contact& c : contacts) {
      const double u = approach_speed(c, states);
      result.push_back({c, u > 0 ? restitution * u : 0, friction});
    }
    return result;
  }
  ImpulseReport collide(double restitution, double friction) {
    return apply_impulses(points(restitution, friction), inertness, states);
  }
};

// A ball of radius 0.5 m and 2 kg that touches the ground.
Scene ball_on_ground(const Vec3& v_WB) { return Scene({ground(), ball("ball", 0.5, 2, Vec3(1, 2, 0.5), v_WB)}); }

TEST(Impulse, OfTwoSpheresHeadOnIsNewtons) {
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double m2 : {1.0, 3.0, 1e4}) {
      const double m1 = 1, u1 = 2, u2 = -1;
      Scene s(
          {ball("a", 0.5, m1, Vec3(-0.5, 0, 0), Vec3(u1, 0, 0)), ball("b", 0.5, m2, Vec3(0.5, 0, 0), Vec3(u2, 0, 0))});
      const ImpulseReport report = s.collide(e, 0);
      EXPECT_TRUE(report.converged);
      // v1' = (m1 u1 + m2 u2 - e m2 (u1 - u2)) / (m1 + m2), v2' with the indices exchanged.
      const double p = m1 * u1 + m2 * u2, mass = m1 + m2;
      EXPECT_NEAR(s.states[0].v_WB.x(), (p - e * m2 * (u1 - u2)) / mass, 1e-12);
      EXPECT_NEAR(s.states[1].v_WB.x(), (p + e * m1 * (u1 - u2)) / mass, 1e-12);
    }
  }
}

TEST(Impulse, OfObliqueSmoothSpheresActsAlongTheLineOfContactOnly) {
  const Vec3 n = Vec3(0.6, 0, 0.8), u1(-3, 1, -2);
  Scene s({ball("a", 1, 2, 3 * n, u1), ball("b", 2, 5, Vec3::Zero(), Vec3::Zero())});
  const double e = 0.7, reduced = 2.0 * 5 / 7, un = n.dot(u1);
  s.collide(e, 0);
  EXPECT_LT((s.states[0].v_WB - (u1 - (1 + e) * reduced / 2 * un * n)).norm(), 1e-12);
  EXPECT_LT((s.states[1].v_WB - (1 + e) * reduced / 5 * un * n).norm(), 1e-12);
  EXPECT_LT(s.states[0].w_WB.norm() + s.states[1].w_WB.norm(), 1e-14);
}

TEST(Impulse, LosesEnergyByTheOneMinusESquaredLaw) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 n = Vec3(in(random), in(random), 1.5 + in(random)).normalized();
    const double e = 0.5 + 0.5 * in(random), m1 = 2 + in(random), m2 = 2 + in(random);
    Scene s({ball("a", 1, m1, 2 * n, Vec3(in(random), in(random), -2)),
             ball("b", 1, m2, Vec3::Zero(), Vec3(in(random), 0, 0))});
    Scenario scenario;
    scenario.bodies = s.bodies;
    const double u = approach_speed(s.contacts.at(0), s.states), before = energy(scenario, s.states);
    ASSERT_EQ(u, u);
    s.collide(e, 0);
    const double lost = u > 0 ? 0.5 * (m1 * m2 / (m1 + m2)) * (1 - e * e) * u * u : 0;
    EXPECT_NEAR(before - energy(scenario, s.states), lost, 64 * kEps * before) << k;
  }
}

TEST(Impulse, LetsASlippingSphereSlide) {
  // mu (1+e) v_n < 2/7 v_t: friction is mu times the normal impulse all through, v_t' = v_t - mu (1+e) v_n, and the
  // torque gives it R w = 5/2 mu (1+e) v_n.
  const double e = 0.5, mu = 0.1, vt = 3, vn = 2;
  Scene s = ball_on_ground(Vec3(vt * 0.6, vt * 0.8, -vn));
  s.collide(e, mu);
  const double change = mu * (1 + e) * vn;
  ASSERT_LT(change, 2.0 / 7 * vt);
  const BodyState& b = s.states[1];
  EXPECT_LT((b.v_WB - Vec3((vt - change) * 0.6, (vt - change) * 0.8, e * vn)).norm(), 16 * kEps * 3);
  EXPECT_LT((b.w_WB - 2.5 * change / 0.5 * Vec3(-0.8, 0.6, 0)).norm(), 16 * kEps * 10);
}

TEST(Impulse, LetsAGrippingSphereRoll) {
  // mu (1+e) v_n > 2/7 v_t: the contact point stops, v_t' = 5/7 v_t = R w.
  const double e = 0.5, mu = 0.6, vt = 3, vn = 2;
  Scene s = ball_on_ground(Vec3(vt, 0, -vn));
  s.collide(e, mu);
  ASSERT_GT(mu * (1 + e) * vn, 2.0 / 7 * vt);
  EXPECT_LT((s.states[1].v_WB - Vec3(5.0 / 7 * vt, 0, e * vn)).norm(), 16 * kEps * 3);
  EXPECT_LT((s.states[1].w_WB - Vec3(0, 5.0 / 7 * vt / 0.5, 0)).norm(), 16 * kEps * 10);
}

TEST(Impulse, ChangesFromStickToSlipAtTheCone) {
  const double e = 0.5, vn = 2, mu = 0.2, limit = 3.5 * mu * (1 + e) * vn;
  for (const double side : {0.999, 1.001}) {
    Scene s = ball_on_ground(Vec3(side * limit, 0, -vn));
    s.collide(e, mu);
    const double slip = contact_velocity(s.contacts.at(0), s.states).x();
    // Beyond the limit the rest of the tangential speed remains: v_t - 7/2 mu (1+e) v_n.
    EXPECT_NEAR(slip, side < 1 ? 0 : (side - 1) * limit, 64 * kEps * limit) << side;
  }
}

TEST(Impulse, IsTheSameInEveryDirectionOfTheGround) {
  for (const double angle : {0.0, 0.4, 0.785, 1.5, 3.0}) {
    Scene s = ball_on_ground(Vec3(3 * std::cos(angle), 3 * std::sin(angle), -1));
    s.collide(0, 0.3);
    EXPECT_NEAR(s.states[1].v_WB.norm(), 3 - 0.3, 32 * kEps) << angle;
  }
}

// A tilted box that hits the ground with one corner, spinning: the answer of the corner depends on the direction.
TEST(Impulse, OfATumblingBoxObeysCoulombsLaw) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> in(-1, 1);
  int slides = 0, sticks = 0;
  for (int k = 0; k < 300; ++k) {
    Body box = solid("box", Box{Vec3(1, 0.6, 0.3)}, 2, Vec3::Zero(), Vec3(2 * in(random), 2 * in(random), -2));
    box.initial.q_WB = rotation_by(Vec3(in(random), in(random), in(random)));
    box.initial.w_WB = Vec3(in(random), in(random), in(random));
    double lowest = 0;
    for (const Contact& c : box_half_space_contacts(box.initial, Vec3(1, 0.6, 0.3), BodyState{}, Vec3::UnitZ())) {
      lowest = std::min(lowest, c.gap);
    }
    box.initial.p_WB.z() = -lowest;
    Scene s({ground(), box});
    ASSERT_FALSE(s.contacts.empty());
    const double mu = 0.5 + 0.5 * in(random), e = 0.5, u = approach_speed(s.contacts[0], s.states);
    if (s.contacts.size() > 1 || u <= 0) continue;
    const ImpulseReport report = s.collide(e, mu);
    ASSERT_TRUE(report.converged) << k;
    const double normal = report.impulses_W[0].z();
    const Vec3 friction(report.impulses_W[0].x(), report.impulses_W[0].y(), 0);
    Vec3 slip = contact_velocity(s.contacts[0], s.states);
    // A change of an impulse by 1e-14 of itself leaves that much of the speeds of the impact, a few m/s; sweeps that
    // contract slowly (the answers along the two axes differ up to tenfold) stop ten to a hundred times further off.
    const double left = 1e-11;
    EXPECT_NEAR(slip.z(), e * u, left) << k;
    slip.z() = 0;
    EXPECT_LE(friction.norm(), mu * normal * (1 + 4 * kEps)) << k;
    if (slip.norm() > 1e-6) {
      ++slides;
      EXPECT_NEAR(friction.norm(), mu * normal, left) << k;
      EXPECT_NEAR(friction.dot(slip), -friction.norm() * slip.norm(), left) << k;
    } else {
      ++sticks;
      EXPECT_LT(slip.norm(), left) << k;
    }
  }
  EXPECT_GT(slides, 20);
  EXPECT_GT(sticks, 20);
}

TEST(Impulse, KeepsTheMomentumOfAClusterToRounding) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  for (int k = 0; k < 200; ++k) {
    // A ball amid six that touch it, thrown together at random.
    std::vector<Body> bodies = {
        ball("middle", 1, 1 + 0.5 * in(random), Vec3::Zero(), Vec3(in(random), in(random), in(random)))};
    for (int j = 0; j < 6; ++j) {
      Vec3 side = Vec3::Zero();
      side(j / 2) = j % 2 == 0 ? 2 : -2;
      bodies.push_back(ball("outer", 1, 1 + 0.5 * in(random), side, Vec3(in(random), in(random), in(random)) - side));
      bodies.back().initial.w_WB = Vec3(in(random), in(random), in(random));
    }
    Scene s(bodies);
    Scenario scenario;
    scenario.bodies = s.bodies;
    const Vec3 p = momentum(scenario, s.states), l = angular_momentum(scenario, s.states);
    const double before = energy(scenario, s.states);
    const ImpulseReport report = s.collide(0.3, 0.4);
    double scale = 0;  // all the impulses that must cancel [N s]
    for (const Vec3& j : report.impulses_W) scale += j.norm();
    EXPECT_EQ(report.impulses_W.size(), 6u);
    EXPECT_LT((momentum(scenario, s.states) - p).norm(), 32 * kEps * (scale + p.norm() + 20)) << k;
    EXPECT_LT((angular_momentum(scenario, s.states) - l).norm(), 64 * kEps * (scale + l.norm() + 40)) << k;
    EXPECT_LT(energy(scenario, s.states), before) << k;
  }
}

TEST(Impulse, OfAFlatBoxIsSharedByFourCorners) {
  Scene s({ground(), solid("box", Box{Vec3(1, 2, 0.5)}, 3, Vec3(0, 0, 0.25), Vec3(0, 0, -2))});
  ASSERT_EQ(s.contacts.size(), 4u);
  const ImpulseReport report = s.collide(0.5, 0.3);
  double sum = 0;
  for (const Vec3& j : report.impulses_W) {
    EXPECT_GE(j.z(), 0);
    sum += j.z();
  }
  EXPECT_NEAR(sum, 3 * 2 * 1.5, 1e-12);
  EXPECT_LT((s.states[1].v_WB - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT(s.states[1].w_WB.norm(), 1e-12);
}

TEST(Impulse, NeverPulls) {
  Scene s = ball_on_ground(Vec3(1, 0, 2));
  const ImpulseReport report = s.collide(0.5, 0.5);
  EXPECT_EQ(report.impulses_W.at(0).norm(), 0);
  EXPECT_EQ(s.states[1].v_WB, Vec3(1, 0, 2));
}

TEST(Impulse, IsNanWhenAVelocityIs) {
  Scene s = ball_on_ground(Vec3(0, 0, std::numeric_limits<double>::quiet_NaN()));
  const ImpulseReport report = s.collide(0.5, 0.5);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(is_finite(s.states[1]));
}

}  // namespace
}  // namespace plumbline
