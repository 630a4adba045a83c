#include "plumbline/core/event_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

struct Flight {
  double z, v;
};
using Path = std::function<Flight(double)>;

// Body 1 moves along z above body 0, which stays.
Trajectory sampled(const Path& path, double dt, std::size_t samples) {
  Trajectory t(dt, 2);
  for (std::size_t k = 0; k < samples; ++k) {
    const auto states = t.append();
    const Flight f = path(static_cast<double>(k) * dt);
    states[1].p_WB.z() = f.z;
    states[1].v_WB.z() = f.v;
  }
  return t;
}

Scenario with_events(std::initializer_list<double> times) {
  Scenario s;
  s.bodies.resize(2);
  s.bodies[0].fixed = true;
  s.bodies[1].mass = 1;
  for (const double t : times) s.events.push_back({"impact", 1, 0, t});
  return s;
}

// Falls with 2 m/s from 1 m, touches at 0.5 s, flies back with 2 m/s.
Flight mirror(double t) { return t < 0.5 ? Flight{1 - 2 * t, -2} : Flight{2 * t - 1, 2}; }

TEST(EventTimes, FindAnImpactInsideAStep) {
  const Scenario s = with_events({0.5});
  const Trajectory path = sampled(mirror, 0.2, 10);
  const auto found = event_times({s, path, path});
  ASSERT_TRUE(found.at(0).has_value());
  EXPECT_NEAR(*found[0], 0.5, 8 * kEps);
}

TEST(EventTimes, FollowTheParabolaUnderGravity) {
  const double g = 9.81, hit = std::sqrt(2 / g), up = 0.8 * g * hit;
  const Path bounce = [=](double t) {
    if (t < hit) return Flight{1 - g * t * t / 2, -g * t};
    return Flight{up * (t - hit) - g * (t - hit) * (t - hit) / 2, up - g * (t - hit)};
  };
  const Scenario s = with_events({hit});
  const Trajectory path = sampled(bounce, 0.06, 15);
  const auto found = event_times({s, path, path});
  ASSERT_TRUE(found.at(0).has_value());
  // The acceleration is read out of velocities, with an error of some roundings over dt.
  EXPECT_NEAR(*found[0], hit, 100 * kEps / 0.06);
}

TEST(EventTimes, PutTogetherWhatBrakesOverSeveralSteps) {
  // Slows down over 0.4 .. 1.0 s; afterwards it is on the line 2 (t - 0.55). The flights 1 - 2t and 2t - 1.1 meet at
  // 0.525 s.
  const Path soft = [](double t) {
    if (t < 0.5) return Flight{1 - 2 * t, -2};
    if (t < 0.7) return Flight{0.06, -0.7};
    if (t < 0.9) return Flight{0.2, 1};
    return Flight{2 * t - 1.1, 2};
  };
  const Scenario s = with_events({0.5});
  const Trajectory actual = sampled(soft, 0.2, 10), expected = sampled(mirror, 0.2, 10);
  const auto found = event_times({s, actual, expected});
  ASSERT_TRUE(found.at(0).has_value());
  EXPECT_NEAR(*found[0], 0.525, 8 * kEps);
  EXPECT_NEAR(find_metric("event_time.max")->measure({s, actual, expected}), 0.025, 8 * kEps);
}

TEST(EventTimes, FindAnImpactThatFallsOnASample) {
  const Scenario s = with_events({0.5});
  const Trajectory path = sampled(mirror, 0.25, 8);
  const auto found = event_times({s, path, path});
  ASSERT_TRUE(found.at(0).has_value());
  EXPECT_NEAR(*found[0], 0.5, 8 * kEps);
}

TEST(EventTimes, EndWhereABodyComesToRest) {
  // Falls from 0.2 m and lies: a step of gravity is a tenth of the impact's speed, and the fall's acceleration must not
  // be missed at every later step.
  const double g = 9.81, hit = std::sqrt(0.4 / g);
  const Path drop = [=](double t) { return t < hit ? Flight{0.2 - g * t * t / 2, -g * t} : Flight{0, 0}; };
  const Scenario s = with_events({hit});
  const Trajectory path = sampled(drop, 0.018, 100);
  const auto found = event_times({s, path, path});
  ASSERT_TRUE(found.at(0).has_value());
  EXPECT_NEAR(*found[0], hit, 100 * kEps / 0.018);
}

TEST(EventTimes, MissAnImpactThatDoesNotHappen) {
  const Scenario s = with_events({0.5});
  const Trajectory through = sampled([](double t) { return Flight{1 - 2 * t, -2}; }, 0.2, 10);
  const Trajectory expected = sampled(mirror, 0.2, 10);
  const Comparison c{s, through, expected};
  EXPECT_FALSE(event_times(c).at(0).has_value());
  EXPECT_EQ(find_metric("events.missed")->measure(c), 1);
  EXPECT_EQ(find_metric("event_time.max")->measure(c), std::numeric_limits<double>::infinity());
}

TEST(EventTimes, TakeImpactsOfOnePairInOrder) {
  // Between a floor at 0 and a lid at 1 m, both of body 0: touches at 0.5, 1.0 and 1.5 s.
  const Path between = [](double t) {
    const double phase = std::fmod(t, 1.0);
    return phase < 0.5 ? Flight{1 - 2 * phase, -2} : Flight{2 * phase - 1, 2};
  };
  const Scenario s = with_events({0.5, 1.0, 1.5});
  const Trajectory path = sampled(between, 0.07, 26);
  const auto found = event_times({s, path, path});
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_TRUE(found.at(k).has_value()) << k;
    EXPECT_NEAR(*found[k], 0.5 * static_cast<double>(k + 1), 32 * kEps);
  }
}

}  // namespace
}  // namespace plumbline
