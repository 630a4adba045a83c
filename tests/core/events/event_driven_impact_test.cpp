// Single impacts and exact paths: what one ball, or two, do.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "plumbline/core/events/event_driven_simulator.hpp"

namespace plumbline {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kEps = std::numeric_limits<double>::epsilon();

EventScene two_balls(const Vec3& d, const Vec3& v, double e) {
  EventScene scene;
  scene.restitution = e;
  scene.balls = {{Vec3::Zero(), v, 0.3, 2.0}, {d, Vec3::Zero(), 0.2, 5.0}};
  return scene;
}

// Head on, masses m and M: v' = (m - e M) v / (m + M), V' = (1 + e) m v / (m + M); met after (distance - R) / v.
TEST(EventDrivenImpact, HeadOnFollowsTheTextbook) {
  for (const double e : {0.0, 0.3, 1.0}) {
    EventDrivenSimulator simulator(two_balls(Vec3(2, 0, 0), Vec3(3, 0, 0), e));
    const auto impact = simulator.next_impact(kInf);
    ASSERT_TRUE(impact.has_value());
    EXPECT_NEAR(impact->time, 0.5, 4 * kEps);
    EXPECT_NEAR(simulator.ball(0).v_WB.x(), (2 - e * 5) * 3 / 7, 1e-14);
    EXPECT_NEAR(simulator.ball(1).v_WB.x(), (1 + e) * 2 * 3 / 7, 1e-14);
    EXPECT_NEAR(impact->impulse_W.x(), -(1 + e) * 10.0 / 7 * 3, 1e-14 * 10);
    EXPECT_FALSE(simulator.next_impact(kInf).has_value()) << "e = " << e;
  }
}

// Met with the line of centres at the angle phi to the velocity: sin phi = b / R, after (s - R cos phi) / v. Only the
// part v cos phi along that line takes part. Then the energy lost is (1 - e^2) mu (v cos phi)^2 / 2 (course slide 18).
TEST(EventDrivenImpact, ObliqueFollowsTheTextbook) {
  for (const double b : {0.0, 0.1, 0.4, 0.499}) {
    for (const double e : {0.0, 0.6, 1.0}) {
      EventDrivenSimulator simulator(two_balls(Vec3(2, b, 0), Vec3(3, 0, 0), e));
      const auto impact = simulator.next_impact(kInf);
      ASSERT_TRUE(impact.has_value());
      const double sine = b / 0.5, cosine = std::sqrt((1 - sine) * (1 + sine)), mu = 10.0 / 7;
      const double impulse = (1 + e) * mu * 3 * cosine;
      // The cosine carries the roundings of positions of 2 m over reach and slope: eps 2/(0.5 cos phi).
      const double tolerance = 16 * kEps * 2 / (0.5 * cosine);
      EXPECT_NEAR(impact->time, (2 - 0.5 * cosine) / 3, tolerance);
      const Vec3 n(cosine, sine, 0);
      EXPECT_NEAR((simulator.ball(0).v_WB - (Vec3(3, 0, 0) - impulse / 2 * n)).norm(), 0, 10 * tolerance);
      EXPECT_NEAR((simulator.ball(1).v_WB - impulse / 5 * n).norm(), 0, 10 * tolerance);
      const double lost = 9 - simulator.kinetic_energy();
      EXPECT_NEAR(lost, 0.5 * (1 - e * e) * mu * 9 * cosine * cosine, 100 * tolerance);
      EXPECT_NEAR((simulator.momentum() - Vec3(6, 0, 0)).norm(), 0, 8 * kEps * 6);
    }
  }
}

TEST(EventDrivenImpact, BallsInFreeFallMeetAsWithoutGravity) {
  EventScene scene = two_balls(Vec3(2, 0.1, 0.2), Vec3(3, 0, 0), 1);
  const double without = EventDrivenSimulator(scene).next_impact(kInf)->time;
  scene.gravity_W = Vec3(0.5, 0, -9.81);
  EXPECT_EQ(EventDrivenSimulator(scene).next_impact(kInf)->time, without);
}

// A ball falls on an obstacle, off centre by b: z of its centre over the obstacle's at impact is sqrt(R^2 - b^2), so
// the time is sqrt(2 (h - sqrt(R^2 - b^2)) / g). Relative motion is a parabola here, not a line.
TEST(EventDrivenImpact, BallFallsOnAnObstacleAtTheExactTime) {
  const double g = 9.81, h = 2, reach = 0.8;
  for (const double b : {0.0, 0.3, 0.7, 0.79}) {
    EventScene scene;
    scene.gravity_W = Vec3(0, 0, -g);
    scene.balls = {{Vec3(b, 0, h), Vec3::Zero(), 0.3, 1}, {Vec3::Zero(), Vec3::Zero(), 0.5, kInf}};
    EventDrivenSimulator simulator(scene);
    const auto impact = simulator.next_impact(10);
    ASSERT_TRUE(impact.has_value()) << b;
    const double z = std::sqrt(reach * reach - b * b), t = std::sqrt(2 * (h - z) / g);
    // Roundings of 2 m, turned into time by the slope g t z/R of the distance.
    EXPECT_NEAR(impact->time, t, 16 * kEps * h / (g * t * z / reach)) << b;
    // The obstacle is a wall at that point: the ball's energy is kept, and its height is what the fall left.
    EXPECT_NEAR(simulator.ball(0).v_WB.norm(), g * t, 1e-13 * g * t);
    EXPECT_EQ(simulator.ball(1).p_WB, Vec3::Zero());
  }
}

// A box with elastic walls, unfolded: each coordinate runs on a straight line in a hall of mirrors.
TEST(EventDrivenImpact, BallInABoxMovesAsInAHallOfMirrors) {
  const Vec3 low(-1, 2, -0.5), high(1.3, 3.1, 0.9), p(0.1, 2.6, 0.2), v(std::numbers::sqrt3, -0.9, std::numbers::sqrt2);
  const double r = 0.1, t = 1000;
  EventScene scene;
  scene.walls = box_walls(low, high);
  scene.balls = {{p, v, r, 1}};
  EventDrivenSimulator simulator(scene);
  const auto impacts = static_cast<double>(simulator.run_until(t));
  double expected_impacts = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = low[axis] + r, width = high[axis] - low[axis] - 2 * r;
    const double line = (p[axis] - a + v[axis] * t) / width, whole = std::floor(line), part = line - whole;
    const bool mirrored = std::fmod(std::abs(whole), 2) == 1;
    expected_impacts += std::abs(whole);
    // An impact is early or late by half a unit in the last place of the clock, which shifts the path by twice the way
    // gone in it; and each of some 6000 events rounds a coordinate of up to 3 m.
    const double tolerance = std::abs(whole) * 2 * std::abs(v[axis]) * kEps * t / 2 + 6000 * kEps * 3 / 2;
    EXPECT_NEAR(simulator.ball(0).p_WB[axis], a + width * (mirrored ? 1 - part : part), tolerance);
    EXPECT_EQ(simulator.ball(0).v_WB[axis], mirrored ? -v[axis] : v[axis]);
  }
  EXPECT_EQ(impacts, expected_impacts);
}

// G. Galperin, Playing pool with pi, Regul. Chaotic Dyn. 8, 375 (2003): a ball of mass 100^k that comes towards one of
// mass 1 before a wall makes them collide, wall included, as often as the first k + 1 digits of pi say.
TEST(EventDrivenImpact, CountsTheDigitsOfPi) {
  const int digits[] = {3, 31, 314, 3141, 31415};
  for (int k = 0; k < 5; ++k) {
    EventScene scene;
    scene.walls = {{{Vec3::UnitX(), 0}, 1}};
    scene.balls = {{Vec3(1, 0, 0), Vec3::Zero(), 0.1, 1}, {Vec3(2, 0, 0), Vec3(-1, 0, 0), 0.1, std::pow(100.0, k)}};
    EventDrivenSimulator simulator(scene);
    EXPECT_EQ(simulator.run_until(kInf), static_cast<std::uint64_t>(digits[k]));
    // Each impact rounds two velocities, by half an eps of a share of the energy that is at most all of it.
    EXPECT_NEAR(simulator.kinetic_energy() / (0.5 * std::pow(100.0, k)), 1, 2 * kEps * digits[k]);
  }
}

TEST(EventDrivenImpact, LogExplainsEveryChangeOfMomentum) {
  EventScene scene = two_balls(Vec3(2, 0.1, 0), Vec3(3, 0.2, 0), 0.7);
  scene.walls = box_walls(Vec3(-1, -1, -1), Vec3(3, 1, 1), 0.9);
  scene.gravity_W = Vec3(0, 0, -1);
  EventDrivenSimulator simulator(scene);
  Vec3 change[2] = {Vec3::Zero(), Vec3::Zero()};
  double last = 0;
  const auto impacts = simulator.record_until(4);
  for (const Impact& impact : impacts) {
    change[impact.ball] += impact.impulse_W;
    if (!impact.with_wall) change[impact.partner] -= impact.impulse_W;
    EXPECT_GE(impact.time, last);
    last = impact.time;
  }
  EXPECT_GT(impacts.size(), 5u);
  for (std::size_t k = 0; k < 2; ++k) {
    const Ball& start = scene.balls[k];
    const Vec3 expected = start.mass * (start.v_WB + 4 * scene.gravity_W) + change[k];
    EXPECT_NEAR((start.mass * simulator.ball(k).v_WB - expected).norm(), 0, 1e-13);
  }
}

TEST(EventDrivenImpact, RefusesWhatMakesNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const EventScene good = two_balls(Vec3(2, 0, 0), Vec3(1, 0, 0), 1);
  const auto refused = [&](auto change, const std::string& why) {
    EventScene scene = good;
    change(scene);
    try {
      EventDrivenSimulator simulator(scene);
      ADD_FAILURE() << "taken, though " << why;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused([](EventScene& s) { s.balls.clear(); }, "at least one ball");
  refused([&](EventScene& s) { s.balls[1].p_WB.y() = nan; }, "ball 1: position");
  refused([&](EventScene& s) { s.balls[0].v_WB.y() = nan; }, "ball 0: position");
  refused([&](EventScene& s) { s.balls[0].radius = nan; }, "ball 0: the radius");
  refused([](EventScene& s) { s.balls[0].mass = 0; }, "ball 0: the mass");
  refused([](EventScene& s) { s.balls[0].mass = kInf; }, "ball 0: one of infinite mass");
  refused([](EventScene& s) { s.balls[1].p_WB.x() = 0.4; }, "ball 0: overlaps ball 1");
  refused([](EventScene& s) { s.restitution = 1.1; }, "restitution");
  refused([&](EventScene& s) { s.gravity_W.x() = nan; }, "gravity");
  refused([](EventScene& s) { s.walls = {{{Vec3(0, 0, 2), 0}, 1}}; }, "wall 0: the normal");
  refused([&](EventScene& s) { s.walls = {{{Vec3::UnitZ(), nan}, 1}}; }, "wall 0: the offset");
  refused([](EventScene& s) { s.walls = {{{Vec3::UnitZ(), -5}, -0.1}}; }, "wall 0: the restitution");
  refused([](EventScene& s) { s.walls = {{{Vec3::UnitZ(), 0}, 1}}; }, "ball 0: overlaps wall 0");
  refused([](EventScene& s) { s.period = Vec3(1, 9, 9); }, "3.1 diameters");
  refused([&](EventScene& s) { s.period = Vec3(9, 9, nan); }, "edges of the periodic box");
  EventDrivenSimulator simulator(good);
  simulator.run_until(0.1);
  EXPECT_THROW(simulator.run_until(0.05), std::invalid_argument);
  EXPECT_THROW(simulator.run_until(nan), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
