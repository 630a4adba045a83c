#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "plumbline/core/mass/wrench_at_point.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(WrenchAtPoint, FollowsTheRightHandRule) {
  // Slide 3: the same pull on a spanner of twice the length turns twice as hard. Pulled along y at x: about +z.
  EXPECT_EQ(torque_about(Vec3::Zero(), {Vec3(0, 10, 0), Vec3(1, 0, 0)}), Vec3(0, 0, 10));
  EXPECT_EQ(torque_about(Vec3::Zero(), {Vec3(0, 10, 0), Vec3(2, 0, 0)}), Vec3(0, 0, 20));
  EXPECT_EQ(torque_about(Vec3(2, 0, 0), {Vec3(0, 10, 0), Vec3(1, 0, 0)}), Vec3(0, 0, -10));
  // A force slides along its line without effect.
  EXPECT_EQ(torque_about(Vec3::Zero(), {Vec3(0, 10, 0), Vec3(1, 7, 0)}), Vec3(0, 0, 10));
}

TEST(WrenchAtPoint, OfACoupleIsTheSameEverywhere) {
  const PointForce couple[] = {{Vec3(0, 3, 0), Vec3(1, 0, 0)}, {Vec3(0, -3, 0), Vec3(-1, 0, 0)}};
  for (const Vec3& centre : {Vec3(0, 0, 0), Vec3(5, 2, -1)}) {
    EXPECT_EQ(wrench_about(centre, couple).f_W, Vec3::Zero());
    EXPECT_EQ(wrench_about(centre, couple).tau_W, Vec3(0, 0, 6));
  }
}

TEST(WrenchAtPoint, MovesToAnyCentre) {
  std::mt19937_64 bits(1);
  const auto number = [&] { return 2 * static_cast<double>(bits() >> 11) * 0x1p-53 - 1; };
  const auto vector = [&] {
    const double x = number(), y = number(), z = number();
    return Vec3(x, y, z);
  };
  for (int k = 0; k < 200; ++k) {
    PointForce forces[4];
    for (PointForce& f : forces) f = {vector(), vector()};
    const Vec3 a = vector(), b = vector();
    const Wrench direct = wrench_about(b, forces), moved = moved_wrench(wrench_about(a, forces), a, b);
    EXPECT_EQ(direct.f_W, moved.f_W);
    EXPECT_LT((direct.tau_W - moved.tau_W).norm(), 64 * kEps);  // four products of numbers up to 3
  }
}

}  // namespace
}  // namespace plumbline
