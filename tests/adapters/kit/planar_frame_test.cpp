#include "plumbline/adapters/planar_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline {
namespace {

TEST(PlanarFrame, TurnsXTowardsZWhereTheScenarioTurnsItAway) {
  // A quarter turn about +y takes x to -z; the engine, which counts from x towards z, calls it minus a quarter.
  BodyState s;
  s.q_WB = rotation_by(Vec3(0, std::acos(0.0), 0));
  s.w_WB = Vec3(0, 3, 0);
  EXPECT_LE((s.q_WB * Vec3::UnitX() + Vec3::UnitZ()).norm(), 4e-16);
  EXPECT_NEAR(in_plane(s).angle, -std::acos(0.0), 4e-16);
  EXPECT_EQ(in_plane(s).w, -3);
  EXPECT_EQ(planar_torque(Vec3(1, 2, 3)), -2);
}

TEST(PlanarFrame, ComesBackFromThePlane) {
  for (const double angle : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const PlanarState stated{1, 2, angle, 3, 4, 5};
    const PlanarState back = in_plane(in_space(stated));
    EXPECT_EQ(back.x, 1);
    EXPECT_EQ(back.z, 2);
    EXPECT_NEAR(back.angle, angle, 1e-15 * (1 + std::abs(angle)));
    EXPECT_EQ(back.vx, 3);
    EXPECT_EQ(back.vz, 4);
    EXPECT_EQ(back.w, 5);
  }
}

TEST(PlanarFrame, KeepsWhatThePlaneDoesNotKnow) {
  // A disc: its axis is y, its moments are those about its own z.
  Body disc{"disc", Cylinder{0.5, 0.2}, false, 2, solid_inertia(Cylinder{0.5, 0.2}, 2), {}};
  const Quat upright(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);
  disc.initial.q_WB = rotation_by(Vec3(0, 0.7, 0)) * upright;
  disc.initial.p_WB = Vec3(1, 9, 2);
  EXPECT_NEAR(planar_inertia(disc), 0.5 * 2 * 0.25, 1e-15);
  PlanarState now = in_plane(disc.initial);
  EXPECT_NEAR(now.angle, -0.7, 1e-15);
  EXPECT_LE(geodesic_angle(in_space(now, disc.initial).q_WB, disc.initial.q_WB), 1e-15);
  now.angle += 0.4;  // which is 0.4 less about y
  const BodyState turned = in_space(now, disc.initial);
  EXPECT_LE(geodesic_angle(turned.q_WB, rotation_by(Vec3(0, 0.3, 0)) * upright), 1e-15);
  EXPECT_EQ(turned.p_WB, Vec3(1, 9, 2));
}

TEST(PlanarFrame, AddsNoRoundingToATurnInThePlane) {
  BodyState s;
  s.q_WB = rotation_by(Vec3(0, 0.7, 0));
  const PlanarState now = in_plane(s);
  EXPECT_EQ(in_space(now, s).q_WB.coeffs(), in_space(now).q_WB.coeffs());
}

TEST(PlanarFrame, DropsWhatLeavesThePlane) {
  BodyState s;
  s.p_WB = Vec3(1, 9, 2);
  s.v_WB = Vec3(3, 9, 4);
  s.w_WB = Vec3(9, 5, 9);
  const BodyState flat = in_space(in_plane(s));
  EXPECT_EQ(flat.p_WB, Vec3(1, 0, 2));
  EXPECT_EQ(flat.v_WB, Vec3(3, 0, 4));
  EXPECT_EQ(flat.w_WB, Vec3(0, 5, 0));
}

}  // namespace
}  // namespace plumbline
