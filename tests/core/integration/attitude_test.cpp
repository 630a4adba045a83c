#include "plumbline/core/integration/attitude.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(Turned, TurnsAboutTheWorldsAxesByTheRightHandRule) {
  const Quat q = rotation_by(Vec3(0, 0, std::numbers::pi / 2));
  const Quat after = turned(q, Vec3(std::numbers::pi / 2, 0, 0));
  // The body's x axis stood along y of the world and now stands along z.
  EXPECT_LT((after * Vec3::UnitX() - Vec3::UnitZ()).norm(), 8 * kEps);
}

TEST(Turned, StaysAUnitQuaternionForAMillionSteps) {
  Quat q = Quat::Identity();
  for (int n = 0; n < 1000000; ++n) q = turned(q, Vec3(0.01, -0.02, 0.013));
  EXPECT_NEAR(q.norm(), 1, 2 * kEps);
}

// The derivative of R(phi + s phi') at s = 0 as an angular velocity, by differences of order 4. Truncation is of the
// size s^4 |phi'|^5/30 and rounding 3 eps/s: near 1e-12 both for s = 1e-3.
Vec3 angular_velocity(const Vec3& phi, const Vec3& rate) {
  const double s = 1e-3;
  const auto turn = [&](double by) {
    const Quat d = rotation_by(phi + by * rate) * rotation_by(phi).conjugate();
    return Vec3(2 * std::atan2(d.vec().norm(), d.w()) * d.vec().normalized());
  };
  return (8 * (turn(s) - turn(-s)) - (turn(2 * s) - turn(-2 * s))) / (12 * s);
}

TEST(DexpInverse, TellsTheRateOfTheRotationVectorFromTheAngularVelocity) {
  for (const double angle : {0.0, 1e-6, 0.0499, 0.0501, 0.5, 2.0, 4.0}) {
    const Vec3 phi = angle / 3 * Vec3(1, -2, 2), rate(0.3, 0.8, -0.5);
    EXPECT_LT((dexp_inverse(phi, angular_velocity(phi, rate)) - rate).norm(), 1e-10) << angle;
  }
}

TEST(DexpInverse, AgreesOnBothSidesOfItsSeries) {
  const Vec3 axis(0.6, 0, 0.8), w(1, 2, 3);
  const Vec3 below = dexp_inverse(0.05 * (1 - 1e-12) * axis, w), above = dexp_inverse(0.05 * (1 + 1e-12) * axis, w);
  // They differ by the 1e-13 between the arguments times |w|/2, and by rounding.
  EXPECT_LT((below - above).norm(), 1e-13 * w.norm() + 8 * kEps * w.norm());
}

TEST(DexpInverse, IsTheIdentityAboutOneAxis) {
  const Vec3 phi(0.2, -0.4, 0.4);
  EXPECT_LT((dexp_inverse(phi, 3 * phi) - 3 * phi).norm(), 4 * kEps);
}

TEST(DexpInverse, KeepsNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(dexp_inverse(Vec3(nan, 0, 0), Vec3::UnitY()).allFinite());
  EXPECT_FALSE(dexp_inverse(Vec3::UnitX(), Vec3(0, nan, 0)).allFinite());
}

}  // namespace
}  // namespace plumbline
