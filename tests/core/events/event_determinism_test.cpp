// Which changes of a run change nothing, and how fast chaos finds the rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "plumbline/core/events/event_driven_simulator.hpp"

namespace plumbline {
namespace {

EventScene gas_scene() { return hard_sphere_scene(hard_sphere_crystal(3, 0.5, 42)); }

// The largest distance between balls of two runs, in the periodic box.
double strayed(const EventDrivenSimulator& a, const EventDrivenSimulator& b, double box) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    Vec3 d = a.ball(k).p_WB - b.ball(k).p_WB;
    d -= box * (d / box).array().round().matrix();
    largest = std::max(largest, d.norm());
  }
  return largest;
}

TEST(EventDeterminism, SameRunTwiceIsTheSameBits) {
  EventDrivenSimulator a(gas_scene()), b(gas_scene());
  for (int k = 0; k < 20000; ++k) {
    const auto x = a.next_impact(1e9), y = b.next_impact(1e9);
    ASSERT_EQ(x->time, y->time);
    ASSERT_EQ(x->ball, y->ball);
    ASSERT_EQ(x->impulse_W, y->impulse_W);
  }
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(a.ball(k).p_WB, b.ball(k).p_WB);
}

TEST(EventDeterminism, StopsInBetweenDoNotMatter) {
  EventDrivenSimulator a(gas_scene()), b(gas_scene());
  for (int k = 1; k <= 1000; ++k) a.run_until(k * 1e-3);
  b.run_until(1);
  EXPECT_EQ(a.counts().impacts, b.counts().impacts);
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(a.ball(k).p_WB, b.ball(k).p_WB);
}

// Another order of the balls changes the order of additions here and there, so roundings, so in the end everything. A
// ball moved by 1e-12 m shows how fast; roundings, 1e-15 each and some hundred of them, must stay below it.
TEST(EventDeterminism, OrderOfInsertionChangesRoundingsOnly) {
  const EventScene scene = gas_scene();
  std::vector<std::size_t> order(scene.balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 bits(1);
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[bits() % k]);
  EventScene shuffled = scene, moved = scene;
  for (std::size_t k = 0; k < order.size(); ++k) shuffled.balls[k] = scene.balls[order[k]];
  moved.balls[0].p_WB.x() += 1e-12;
  EventDrivenSimulator a(scene), b(shuffled), c(moved);
  double yardstick = 1e-13;
  for (int k = 0; k < 400; ++k) {
    const auto x = a.next_impact(1e9), y = b.next_impact(1e9), z = c.next_impact(1e9);
    ASSERT_EQ(std::minmax(x->ball, x->partner), std::minmax(order[y->ball], order[y->partner])) << k;
    yardstick = std::max(yardstick, std::abs(x->time - z->time));
    ASSERT_LE(std::abs(x->time - y->time), yardstick) << k;
  }
  EXPECT_LT(yardstick, 1e-6);
}

// Far from the origin the same things happen, to the rounding of coordinates there: 1e6 m away they have 1e-10 m.
TEST(EventDeterminism, FarFromTheOriginOnlyDigitsAreLost) {
  EventScene near = gas_scene();
  near.period.reset();
  EventScene far = near;
  const Vec3 away(1e6, -2e6, 3e6);
  for (Ball& b : far.balls) b.p_WB += away;
  EventDrivenSimulator a(near), b(far);
  for (int k = 0; k < 60; ++k) {
    const auto x = a.next_impact(1e9), y = b.next_impact(1e9);
    ASSERT_EQ(x->ball, y->ball);
    ASSERT_EQ(x->partner, y->partner);
    // 4.7e-10 m is one unit in the last place of 3e6 m; chaos has not begun within the first impact of most balls, and
    // a grazing impact multiplies by the ratio of free path to the cosine: allow 1000 units.
    ASSERT_NEAR(x->time, y->time, 1000 * 4.7e-10) << k;
  }
}

// All velocities reversed, an elastic gas runs back to where it came from. Roundings on the way out and back grow like
// any small difference: the gas moved by 1e-12 m and carried through the same way is the yardstick, and the error of
// roundings, 1e-16 to 1e-15 for each event, must stay below it.
TEST(EventDeterminism, ReversedGasReturnsToItsStart) {
  const EventScene scene = gas_scene();
  EventScene moved = scene;
  moved.balls[0].p_WB.x() += 1e-12;
  EventDrivenSimulator start(scene), out(scene), nearby(moved);
  const double box = scene.period->x();
  const std::uint64_t impacts = out.run_until(1.2);
  nearby.run_until(1.2);
  EXPECT_GT(impacts, 300u);
  EventScene back = scene;
  back.balls = out.balls();
  for (Ball& b : back.balls) b.v_WB = -b.v_WB;
  EventDrivenSimulator returned(back);
  EXPECT_EQ(returned.run_until(1.2), impacts);
  const double yardstick = strayed(out, nearby, box), error = strayed(returned, start, box);
  EXPECT_LT(yardstick, 1e-6);
  EXPECT_LE(error, yardstick);
  EXPECT_GT(yardstick, 1e-12);  // it is chaotic
  RecordProperty("impacts", std::to_string(impacts));
  RecordProperty("returned_within", std::to_string(error * 1e12) + "e-12");
}

}  // namespace
}  // namespace plumbline
