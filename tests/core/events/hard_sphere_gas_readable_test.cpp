// The fast gas beside the simulator that people read: the same collisions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hard_sphere_scene.hpp"
#include "plumbline/core/events/event_driven_simulator.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

EventDrivenSimulator readable(const gas::Scene& scene) {
  EventScene s;
  s.period = scene.box;
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    s.balls.push_back({scene.positions[i], scene.velocities[i], scene.diameter / 2, 1});
  }
  return EventDrivenSimulator(s);
}

// Some four collisions a sphere, after which rounding has grown by three to five orders.
void expect_collisions_of_the_readable(const gas::Scene& scene) {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  HardSphereGas fast(scene.positions, scene.velocities, scene.diameter, scene.box);
  EventDrivenSimulator slow = readable(scene), shadow = readable(gas::disturbed(scene));
  double allowed = gas::kClockRounding, largest = 0;
  for (std::size_t k = 0; k < 2 * scene.positions.size(); ++k) {
    const auto expected = slow.next_impact(kForever), disturbed = shadow.next_impact(kForever);
    ASSERT_TRUE(expected && disturbed);
    const HardSphereCollision got = fast.collide_next();
    allowed = std::max(allowed, std::abs(disturbed->time - expected->time));
    ASSERT_EQ(got.a, expected->ball) << "collision " << k;
    ASSERT_EQ(got.b, expected->partner) << "collision " << k;
    ASSERT_NEAR(got.time, expected->time, allowed) << "collision " << k;
    largest = max_or_nan(largest, std::abs(got.time - expected->time));
  }
  ASSERT_LT(allowed, 1e-8);  // else the comparison would say nothing
  testing::Test::RecordProperty("largest_time_difference_in_1e-15", std::to_string(largest * 1e15));
}

TEST(HardSphereGasBesideTheReadable, HasItsCollisionsInAFluid) {
  expect_collisions_of_the_readable(gas::lattice_gas(5, 5, 5, 0.5, 31));
}

TEST(HardSphereGasBesideTheReadable, HasItsCollisionsNearFreezing) {
  expect_collisions_of_the_readable(gas::lattice_gas(5, 6, 4, 0.9, 32));
}

}  // namespace
}  // namespace plumbline
