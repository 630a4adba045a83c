#include "plumbline/core/spatial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

Quat about_z(double angle) { return Quat(std::cos(angle / 2), 0, 0, std::sin(angle / 2)); }

TEST(GeodesicAngle, IsTheAngleBetweenAttitudes) {
  for (const double angle : {0.0, 0.3, 1.0, 2.0, 3.0}) {
    const Quat a = about_z(0.7), b = about_z(0.7 + angle);
    // Four roundings of products of numbers up to 1 in each component.
    EXPECT_NEAR(geodesic_angle(a, b), angle, 16 * kEps);
  }
}

TEST(GeodesicAngle, KeepsItsDigitsForSmallAngles) {
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    // Against the identity no digit cancels, so that the relative error is that of sine and arc tangent.
    EXPECT_NEAR(geodesic_angle(Quat::Identity(), about_z(angle)) / angle, 1, 4 * kEps) << angle;
  }
}

TEST(GeodesicAngle, TakesBothQuaternionsOfAnAttitudeAsOne) {
  const Quat q = rotation_by(Vec3(0.1, -0.7, 0.4));
  const Quat minus(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_NEAR(geodesic_angle(q, minus), 0, 4 * kEps);
  EXPECT_DOUBLE_EQ(geodesic_angle(about_z(1.2), minus), geodesic_angle(about_z(1.2), q));
}

TEST(GeodesicAngle, NeverExceedsHalfATurn) {
  EXPECT_NEAR(geodesic_angle(Quat::Identity(), about_z(std::numbers::pi)), std::numbers::pi, 4 * kEps);
  EXPECT_NEAR(geodesic_angle(Quat::Identity(), about_z(4.0)), 2 * std::numbers::pi - 4.0, 16 * kEps);
}

TEST(GeodesicAngle, IsNanWhenAnAttitudeIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(geodesic_angle(Quat(nan, 0, 0, 0), Quat::Identity())));
  EXPECT_TRUE(std::isnan(geodesic_angle(Quat::Identity(), Quat(1, 0, nan, 0))));
}

TEST(RotationBy, TurnsByTheRightHandRule) {
  const Vec3 turned = rotation_by(Vec3(0, 0, std::numbers::pi / 2)) * Vec3::UnitX();
  EXPECT_LT((turned - Vec3::UnitY()).norm(), 8 * kEps);
}

TEST(RotationBy, HasUnitLengthForEveryAngle) {
  for (const double angle : {0.0, 1e-300, 1e-9, 0.99e-4, 1.01e-4, 1.0, 100.0}) {
    EXPECT_NEAR(rotation_by(angle * Vec3(2, -1, 2) / 3).norm(), 1, 4 * kEps) << angle;
  }
}

TEST(RotationBy, KeepsItsDigitsOnBothSidesOfTheSeries) {
  for (const double angle : {1e-12, 0.5e-4, 0.9999e-4, 1.0001e-4, 1e-2}) {
    EXPECT_NEAR(rotation_by(Vec3(0, angle, 0)).y() / std::sin(angle / 2), 1, 4 * kEps) << angle;
  }
}

TEST(RotationBy, AddsUpAboutOneAxis) {
  const Vec3 axis = Vec3(1, 2, 2) / 3;
  EXPECT_LT(geodesic_angle(rotation_by(0.4 * axis) * rotation_by(0.5 * axis), rotation_by(0.9 * axis)), 16 * kEps);
}

TEST(CrossMatrix, IsTheCrossProduct) {
  const Vec3 r(1, -2, 3), v(4, 5, -6);
  EXPECT_EQ(Vec3(cross_matrix(r) * v), r.cross(v));
}

}  // namespace
}  // namespace plumbline
