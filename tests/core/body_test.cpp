#include "plumbline/core/body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(SolidInertia, OfABoxIsTheIntegralOverItsVolume) {
  // Gauss-Legendre with two points per axis is exact for the integrand y^2 + z^2: any difference is rounding.
  const Vec3 size(0.1, 0.4, 0.9);
  const double mass = 10;
  Vec3 integral = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    const Vec3 r = (sign.cwiseProduct(size) / (2 * std::numbers::sqrt3));
    integral += mass / 8 * (Vec3::Constant(r.squaredNorm()) - r.cwiseAbs2());
  }
  EXPECT_LT((solid_inertia(Box{size}, mass) - integral).norm(), 16 * kEps * integral.norm());
}

TEST(SolidInertia, OfASphereIsAStackOfDiscs) {
  // A disc of radius s has 1/2 dm s^2 about its axis: the integrand (R^2 - z^2)^2 is a quartic, for which three
  // Gauss points are exact.
  const double radius = 0.7, mass = 3;
  const double density = mass / (4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3));
  const double nodes[] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weights[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  double integral = 0;
  for (int k = 0; k < 3; ++k) {
    const double z = radius * nodes[k], square = radius * radius - z * z;
    integral += radius * weights[k] * 0.5 * density * std::numbers::pi * square * square;
  }
  EXPECT_NEAR(solid_inertia(Sphere{radius}, mass).x(), integral, 16 * kEps * integral);
  EXPECT_EQ(solid_inertia(Sphere{radius}, mass).y(), solid_inertia(Sphere{radius}, mass).z());
}

TEST(SolidInertia, IsRefusedForAHalfSpace) {
  EXPECT_THROW(solid_inertia(HalfSpace{Vec3::UnitZ()}, 1), std::invalid_argument);
}

TEST(InertiaInWorld, TurnsWithTheBody) {
  Body body;
  body.inertia = Vec3(1, 2, 3);
  // A quarter turn about z exchanges the moments about x and y.
  const Mat3 turned = inertia_in_world(body, rotation_by(Vec3(0, 0, std::numbers::pi / 2)));
  EXPECT_LT((turned - Mat3(Vec3(2, 1, 3).asDiagonal())).norm(), 32 * kEps);
}

TEST(ShapeName, IsTheWordOfScenarioFiles) {
  EXPECT_EQ(shape_name(Sphere{1}), "sphere");
  EXPECT_EQ(shape_name(Box{Vec3(1, 1, 1)}), "box");
  EXPECT_EQ(shape_name(HalfSpace{Vec3::UnitZ()}), "half_space");
}

}  // namespace
}  // namespace plumbline
