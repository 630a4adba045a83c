// Infinitely many bounces in a finite time, rest, and how balls wake from it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "plumbline/core/events/event_driven_simulator.hpp"

namespace plumbline {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kG = 9.81;

EventScene floor_scene(double e) {
  EventScene scene;
  scene.gravity_W = Vec3(0, 0, -kG);
  scene.walls = {{{Vec3::UnitZ(), 0}, e}};
  scene.restitution = e;
  return scene;
}

// A ball of radius r whose lowest point is h above the floor.
Ball above(double h, double r, double x = 0) { return {Vec3(x, 0, h + r), Vec3::Zero(), r, 1}; }

double stop_time(double h, double e) { return std::sqrt(2 * h / kG) * (1 + e) / (1 - e); }

std::optional<Impact> until_rest(EventDrivenSimulator& simulator, double until = 1e4) {
  for (;;) {
    const auto impact = simulator.next_impact(until);
    if (!impact || impact->comes_to_rest) return impact;
  }
}

TEST(ZenoRule, BallStopsAtTheEndOfTheSeries) {
  for (const double train_time : {0.0, 1e-6, 1e-3, 1e4}) {
    for (const double e : {0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      EventScene scene = floor_scene(e);
      scene.balls = {above(1, 0.1)};
      EventRules rules;
      rules.train_time = train_time;
      EventDrivenSimulator simulator(scene, rules);
      double impulse = 0, stopped = 0;
      while (const auto impact = simulator.next_impact(1e4)) {
        impulse += impact->impulse_W.z();
        if (impact->comes_to_rest) stopped = impact->time;
      }
      // The first impact has a few roundings of a fall of 1 m; (1 + e)/(1 - e) of them are left at the end. Without
      // trains the hops below 4 eps |p| are cut off, which last 2u/(g (1 - e)) with u^2 = 8 g eps |p|.
      const double series = 16 * kEps * (1 + e) / (1 - e) * stop_time(1, e);
      const double cut = 2 * std::sqrt(8 * kG * kEps * 0.2) / (kG * (1 - e));
      const double tolerance = train_time > 0 ? 1e-13 + series : cut + series;
      EXPECT_NEAR(stopped, stop_time(1, e), tolerance) << "e = " << e << ", train time " << train_time;
      // A second, independent check: from rest to rest, the floor has carried the weight the whole time.
      EXPECT_NEAR(impulse, kG * stopped, kG * 2 * (tolerance + series));
      EXPECT_TRUE(simulator.rests(0));
      EXPECT_EQ(simulator.ball(0).v_WB, Vec3::Zero());
      EXPECT_NEAR(simulator.ball(0).p_WB.z(), 0.1, kEps);
    }
  }
  EXPECT_NEAR(stop_time(1, 0.5), 1.354570923, 5e-10);  // the published value
}

TEST(ZenoRule, TrainIsTheSameMotionAsItsBounces) {
  for (const double e : {0.2, 0.5, 0.9}) {
    EventScene scene = floor_scene(e);
    scene.balls = {above(4e-4, 0.5)};
    EventRules whole, single;
    whole.train_time = 1e4;
    single.train_time = 0;
    EventDrivenSimulator train(scene, whole), bounces(scene, single);
    for (int k = 1; k <= 997; ++k) {
      const double t = stop_time(4e-4, e) * k / 1000;
      train.run_until(t);
      bounces.run_until(t);
      // Velocities jump at a bounce; heights do not, and differ by roundings of 0.5 m for each bounce.
      ASSERT_NEAR(train.ball(0).p_WB.z(), bounces.ball(0).p_WB.z(), 100 * kEps) << "e = " << e << ", " << k;
    }
    EXPECT_LE(train.counts().impacts, 2u);
    EXPECT_GT(bounces.counts().impacts, train.counts().impacts);
  }
}

// On a slope the motion along it knows nothing of the bounces: s = g sin(theta) t^2/2 before, in and after the train.
TEST(ZenoRule, BallOnASlopeSlidesOn) {
  const double theta = 0.4, h = 0.3, e = 0.6, r = 0.1;
  const Vec3 normal(std::sin(theta), 0, std::cos(theta)), along(std::cos(theta), 0, -std::sin(theta));
  EventScene scene = floor_scene(e);
  scene.walls[0].plane.normal_W = normal;
  scene.balls = {{(h + r) * normal, Vec3::Zero(), r, 1}};
  EventDrivenSimulator simulator(scene);
  const auto rest = until_rest(simulator);
  ASSERT_TRUE(rest.has_value());
  const double stop = std::sqrt(2 * h / (kG * std::cos(theta))) * (1 + e) / (1 - e);
  EXPECT_NEAR(rest->time, stop, 1e-13);
  for (const double t : {stop, 1.5 * stop, 10 * stop}) {
    simulator.run_until(std::max(t, rest->time));
    const double s = 0.5 * kG * std::sin(theta) * t * t;
    EXPECT_NEAR(simulator.ball(0).p_WB.dot(along), s, 1e-12 * (1 + s));
    EXPECT_NEAR(simulator.ball(0).p_WB.dot(normal), r, 8 * kEps * (1 + s));
  }
  EXPECT_TRUE(simulator.rests(0));
}

TEST(ZenoRule, TwoBallsStopEachAtItsOwnTime) {
  const double e = 0.5;
  EventScene scene = floor_scene(e);
  scene.balls = {above(1, 0.1, 0), above(0.4, 0.2, 0.30000001)};  // they all but touch
  EventDrivenSimulator simulator(scene);
  const auto first = until_rest(simulator), second = until_rest(simulator);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->ball, 1u);
  EXPECT_NEAR(first->time, stop_time(0.4, e), 1e-12);
  EXPECT_EQ(second->ball, 0u);
  EXPECT_NEAR(second->time, stop_time(1, e), 1e-12);
}

TEST(ZenoRule, ElasticBallNeverRests) {
  EventScene scene = floor_scene(1);
  scene.balls = {above(1, 0.1)};
  EventDrivenSimulator simulator(scene);
  const double t0 = std::sqrt(2 / kG);
  for (int k = 0; k < 1000; ++k) {
    const auto impact = simulator.next_impact(kInf);
    ASSERT_TRUE(impact && !impact->comes_to_rest);
    // Each bounce rounds the clock, up to 900 s, and the speed, which scales the next period.
    EXPECT_NEAR(impact->time, t0 * (2 * k + 1), (k + 1) * kEps * (900 + 4 * t0 * (k + 1)));
  }
  simulator.run_until(t0 * 2000);
  EXPECT_NEAR(simulator.ball(0).p_WB.z(), 1.1, 1e-9);  // the apex, flat in time
}

TEST(ZenoRule, BallLaidOnTheFloorRestsAtOnce) {
  for (const double e : {0.0, 0.5, 1.0}) {
    EventScene scene = floor_scene(e);
    scene.balls = {above(0, 0.1)};
    EventDrivenSimulator simulator(scene);
    const auto impact = simulator.next_impact(1);
    ASSERT_TRUE(impact && impact->comes_to_rest) << e;
    EXPECT_EQ(impact->time, 0);
    EXPECT_FALSE(simulator.next_impact(1e6).has_value());
  }
}

// A ball that slides strikes one that rests: they exchange velocities and both stay on the floor. Then one falls from
// above, is thrown off, and the ball below bounces: it is awake.
TEST(ZenoRule, RestingBallWakes) {
  EventScene scene = floor_scene(0.5);
  scene.restitution = 1;
  scene.balls = {above(0, 0.25, 0), above(0, 0.25, 2)};
  scene.balls[1].v_WB = Vec3(-1, 0, 0);
  EventDrivenSimulator slide(scene);
  slide.run_until(3);
  EXPECT_NEAR((slide.ball(0).v_WB - Vec3(-1, 0, 0)).norm(), 0, 4 * kEps);
  EXPECT_NEAR(slide.ball(0).p_WB.x(), -1.5, 16 * kEps);
  EXPECT_TRUE(slide.rests(0) && slide.rests(1));

  scene.balls[1] = above(1, 0.25, 0.3);
  EventDrivenSimulator drop(scene);
  EXPECT_TRUE(until_rest(drop).has_value());  // ball 0, at time 0
  const auto hit = drop.next_impact(1);
  ASSERT_TRUE(hit.has_value());
  EXPECT_FALSE(hit->with_wall);
  const double z = std::sqrt(0.25 - 0.09);  // of the centre over that of the ball below
  const double t = std::sqrt(2 * (1 - z) / kG);
  EXPECT_NEAR(hit->time, t, 1e-14);
  const auto floor = drop.next_impact(1);  // pressed into the floor, it rebounds in the same instant
  ASSERT_TRUE(floor && floor->with_wall);
  EXPECT_EQ(floor->time, hit->time);
  const double taken = kG * t * (z / 0.5);  // equal masses: the part along the line of centres changes hands
  EXPECT_NEAR(drop.ball(0).v_WB.z(), 0.5 * taken * z / 0.5, 1e-13);
  EXPECT_FALSE(drop.rests(0));
  const auto again = until_rest(drop);
  ASSERT_TRUE(again.has_value());
  EXPECT_GT(again->time, t);
}

// A ball comes sliding while another is in its train: the train is taken back and everything is as if each bounce had
// been followed.
TEST(ZenoRule, TrainIsTakenBackWhenSomebodyComes) {
  EventScene scene = floor_scene(0.8);
  scene.balls = {above(2e-5, 0.1, 0), above(0, 0.1, 0.3), {Vec3(0.8, 0, 0.1), Vec3(-20, 0, 0), 0.1, 1}};
  EventRules whole, single;
  whole.train_time = 1;
  single.train_time = 0;
  EventDrivenSimulator train(scene, whole), bounces(scene, single);
  // The third strikes the second at 0.015 s, which strikes the first at 0.02 s, before its end at 0.018 s (0.8 ...).
  ASSERT_NEAR(stop_time(2e-5, 0.8), 0.0182, 1e-4);
  scene.balls[2].p_WB.x() = 0.7;
  EventDrivenSimulator train_early(scene, whole), bounces_early(scene, single);
  for (auto [a, b] : {std::pair{&train, &bounces}, std::pair{&train_early, &bounces_early}}) {
    Vec3 given = Vec3::Zero();
    double rested = 0.05;
    for (const Impact& impact : a->record_until(0.05)) {
      if (impact.ball == 0 && impact.comes_to_rest) rested = impact.time;
      if (impact.ball == 0) given += impact.impulse_W;  // the ball with the smallest index is never the partner
    }
    b->run_until(0.05);
    for (std::size_t k = 0; k < 3; ++k) {
      // Without trains the ball rests some 1e-8 s early, and what strikes it then finds it 1e-15 m lower.
      EXPECT_NEAR((a->ball(k).p_WB - b->ball(k).p_WB).norm(), 0, 1e-11) << k;
      EXPECT_NEAR((a->ball(k).v_WB - b->ball(k).v_WB).norm(), 0, 1e-7) << k;
    }
    // The log has all that the ball got, the part of the train that was cut short included; from rest on the floor
    // holds the weight, which is no impact.
    given.z() += kG * (0.05 - rested);
    EXPECT_NEAR((given - (a->ball(0).v_WB + 0.05 * Vec3(0, 0, kG))).norm(), 0, 1e-13);
  }
  EXPECT_LT(train.counts().impacts, bounces.counts().impacts);
}

TEST(ZenoRule, BallComesToRestInAValleyAndInACorner) {
  for (const double theta : {0.3, 0.8}) {
    EventScene scene;
    scene.gravity_W = Vec3(0, 0, -kG);
    scene.walls = {{{Vec3(std::sin(theta), 0, std::cos(theta)), 0}, 0.5},
                   {{Vec3(-std::sin(theta), 0, std::cos(theta)), 0}, 0.5}};
    scene.balls = {{Vec3(0.3, 0, 2), Vec3(0.1, 0, 0), 0.1, 1}};
    EventDrivenSimulator simulator(scene);
    simulator.run_until(100);
    EXPECT_TRUE(simulator.rests(0)) << theta;
    EXPECT_NEAR((simulator.ball(0).p_WB - Vec3(0, 0, 0.1 / std::cos(theta))).norm(), 0, 1e-8) << theta;
  }
  EventScene scene;
  scene.gravity_W = Vec3(-1, -2, -kG);
  scene.walls = box_walls(Vec3(0, 0, 0), Vec3(1, 1, 1), 0.7);
  scene.balls = {{Vec3(0.5, 0.6, 0.7), Vec3(1, 2, 3), 0.1, 1}};
  EventDrivenSimulator simulator(scene);
  simulator.run_until(100);
  EXPECT_NEAR((simulator.ball(0).p_WB - Vec3(0.1, 0.1, 0.1)).norm(), 0, 4 * kEps);
  EXPECT_EQ(simulator.ball(0).v_WB, Vec3::Zero());
}

// Three equal balls in a line collapse if e < 7 - 4 sqrt 3 = 0.0718 (McNamara and Young, Phys. Fluids A 4, 496 (1992)):
// the outer ones squeeze the middle one, infinitely often in a finite time. Above that they part after a few impacts.
TEST(ZenoRule, ThreeBallsCollapseBelowThePublishedRestitution) {
  const double critical = 7 - 4 * std::sqrt(3.0);
  const auto line = [](double e) {
    EventScene scene;
    scene.restitution = e;
    scene.balls = {{Vec3(-1.5, 0, 0), Vec3(1, 0, 0), 0.5, 1},
                   {Vec3(0, 0, 0), Vec3::Zero(), 0.5, 1},
                   {Vec3(1.9, 0, 0), Vec3(-1, 0, 0), 0.5, 1}};
    return scene;
  };
  EventRules never;  // without the rule for collapse
  never.collapse_impacts = std::numeric_limits<int>::max();
  EventDrivenSimulator parts(line(1.05 * critical), never);
  EXPECT_LT(parts.run_until(1e3), 100u);
  EventDrivenSimulator collapses(line(0.95 * critical), never);
  std::vector<Impact> impacts;
  while (impacts.size() < 25) impacts.push_back(*collapses.next_impact(1e3));
  // Intervals shrink to nothing.
  EXPECT_LT(impacts[24].time - impacts[22].time, 1e-6 * (impacts[4].time - impacts[2].time));
  // With the rule they part after a finite number of impacts, and no momentum is lost by it.
  EventDrivenSimulator ruled(line(0.95 * critical));
  EXPECT_LT(ruled.run_until(1e3), 100u);
  EXPECT_NEAR(ruled.momentum().norm(), 0, 16 * kEps);
  EXPECT_GE(ruled.ball(2).v_WB.x(), ruled.ball(1).v_WB.x());
  EXPECT_GE(ruled.ball(1).v_WB.x(), ruled.ball(0).v_WB.x());
}

// A ball on a ball has no series: it goes on hopping, lower than can be seen, and the run ends.
TEST(ZenoRule, StackKeepsHoppingOutOfSight) {
  EventScene scene = floor_scene(0.5);
  scene.balls = {above(0, 0.1), above(0.25, 0.1)};
  EventDrivenSimulator simulator(scene);
  simulator.run_until(0.4);  // 60,000 impacts after it has settled at 0.27 s
  EXPECT_NEAR(simulator.ball(0).p_WB.z(), 0.1, 1e-8);
  EXPECT_NEAR(simulator.ball(1).p_WB.z(), 0.3, 1e-8);
}

}  // namespace
}  // namespace plumbline
