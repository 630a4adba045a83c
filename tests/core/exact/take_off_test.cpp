// Motions in contact that ends or dies out: a body that leaves a ball, a ladder that leaves a wall, a curling disc.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "independent_check.hpp"
#include "plumbline/core/exact/curling_disc.hpp"
#include "plumbline/core/exact/falling_ladder.hpp"
#include "plumbline/core/exact/leaving_sphere.hpp"

namespace plumbline {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(LeavingSphere, TakesOffAtThePublishedAngles) {
  // From near the top, where 1 - cos(0.001) = 5e-7.
  EXPECT_NEAR(std::cos(LeavingSphere(1, 0.3, 0, 9.81, 1e-3, 0).leaving_angle()), 2.0 / 3, 5e-7);
  EXPECT_NEAR(std::cos(LeavingSphere(1, 0.3, 0.4, 9.81, 1e-3, 0).leaving_angle()), 10.0 / 17, 5e-7);
}

TEST(LeavingSphere, RunsOnTheSphereByItsEquationAndThenFalls) {
  const double path = 1.2, r = 0.2, g = 9.81, start = 0.3;
  for (const double k : {0.0, 0.4}) {
    const LeavingSphere motion(path, r, k, g, start, 0.1);
    const auto place = [&](double t) {
      const LeavingState s = motion.at(t);
      return Eigen::Vector3d(s.across, s.up, s.turn);
    };
    const auto speed = [&](double t) {
      const LeavingState s = motion.at(t);
      return Eigen::Vector3d(s.v_across, s.v_up, s.spin);
    };
    for (const double share : {0.3, 0.8, 0.95, 1.05, 1.3}) {
      const double t = share * motion.leaving_time(), h = 0.005;
      const Eigen::Vector3d p = place(t), v = speed(t), a = derivative(speed, t, h);
      EXPECT_LT((derivative(place, t, h) - v).norm(), 1e-11) << k << ' ' << share;
      if (share > 1) {
        EXPECT_LT((a - Eigen::Vector3d(0, -g, 0)).norm(), 1e-10);
        continue;
      }
      // m a = pressure + friction + weight: along the tangent the weight less k r alpha, r alpha = a when it rolls.
      const Eigen::Vector2d out = p.head<2>() / path, along(out.y(), -out.x());
      EXPECT_NEAR(p.head<2>().norm(), path, 1e-14);
      EXPECT_NEAR((1 + k) * a.head<2>().dot(along), g * out.x(), 1e-10);
      EXPECT_GT(a.head<2>().dot(out) + g * out.y(), 0) << "the sphere would have to pull";
      EXPECT_NEAR(r * v.z(), k > 0 ? v.head<2>().dot(along) : 0, 1e-13);
    }
    const double end = motion.leaving_time();
    const Eigen::Vector3d v = speed(end), p = place(end);
    EXPECT_NEAR(v.head<2>().squaredNorm() / path, g * p.y() / path, 1e-12) << "the pressure does not vanish";
    const double potential = g * (p.y() - path * std::cos(start)), kinetic = v.head<2>().squaredNorm() / 2;
    EXPECT_NEAR((1 + k) * (kinetic - path * path * 0.01 / 2) + potential, 0, 1e-12);
  }
}

TEST(LeavingSphere, KnowsWhatAFiniteFrictionCosts) {
  const LeavingSphere motion(1, 0.2, 0.4, 9.81, 0.3, 0);
  EXPECT_EQ(LeavingSphere(1, 0.2, 0, 9.81, 0.3, 0).slip_bound(0), 0);
  EXPECT_NEAR(motion.slip_bound(10) / motion.slip_bound(1000), 100, 1e-9);
  EXPECT_LT(motion.slip_bound(1000), 2e-4);
  EXPECT_THROW(motion.slip_bound(0), std::invalid_argument);
  EXPECT_THROW(LeavingSphere(1, 0.2, 0, 9.81, 0, 0), std::invalid_argument);
  EXPECT_THROW(LeavingSphere(1, 0.2, 0, 9.81, 0.3, 4), std::invalid_argument);
}

TEST(FallingLadder, LeavesTheWallAtTwoThirdsOfItsHeight) {
  const double starts[] = {0.2, 0.5, 1.0}, durations[] = {0.9, 0.6, 0.38};  // beyond the wall, before it lies flat
  for (int i = 0; i < 3; ++i) {
    const double start = starts[i];
    const FallingLadder ladder(2, 0, 1.0 / 3, 9.81, start, durations[i]);
    const LadderState s = ladder.at(ladder.leaving_time());
    EXPECT_NEAR(std::cos(s.angle), 2 * std::cos(start) / 3, 1e-13);
  }
}

TEST(FallingLadder, SatisfiesNewtonsLawsAndKeepsItsEnergy) {
  const double L = 2, d = 0.1, inertia = (L * L + d * d) / 12, g = 9.81, start = 0.4, duration = 0.75;
  const FallingLadder ladder(L, d, inertia, g, start, duration);
  ASSERT_LT(ladder.leaving_time(), duration);
  const auto place = [&](double t) {
    const LadderState s = ladder.at(t);
    return Eigen::Vector3d(s.x, s.z, s.angle);
  };
  const auto speed = [&](double t) {
    const LadderState s = ladder.at(t);
    return Eigen::Vector3d(s.vx, s.vz, s.rate);
  };
  const double top = g * ladder.at(0).z;
  for (const double t : {0.1, 0.3, 0.9 * ladder.leaving_time(), ladder.leaving_time() + 0.03, 0.7}) {
    const double h = 0.004;
    const Eigen::Vector3d p = place(t), v = speed(t), a = derivative(speed, t, h);
    EXPECT_LT((derivative(place, t, h) - v).norm(), 1e-10) << t;
    EXPECT_NEAR(v.head<2>().squaredNorm() / 2 + inertia * v.z() * v.z() / 2 + g * p.y(), top, 1e-12) << t;
    // Forces over the mass: the wall's push at the upper edge, the ground's at the lower; their moments turn the
    // ladder.
    const double push = a.x(), bears = a.y() + g;
    EXPECT_GT(bears, 0);
    if (t < ladder.leaving_time()) {
      EXPECT_GT(push, 0);
    } else {
      EXPECT_NEAR(push, 0, 1e-10);
    }
    const Eigen::Vector2d up(-std::sin(p.z()), std::cos(p.z())), across(std::cos(p.z()), std::sin(p.z()));
    const Eigen::Vector2d foot = -L / 2 * up - d / 2 * across, head = L / 2 * up - d / 2 * across;
    EXPECT_NEAR(p.y() + foot.y(), 0, 1e-13) << "the foot leaves the ground";
    if (t < ladder.leaving_time()) {
      EXPECT_NEAR(p.x() + head.x(), 0, 1e-13) << "the head leaves the wall";
    }
    // Falling is a turn about -y: its moment is that of -(r x F) about y, r_x F_z - r_z F_x.
    EXPECT_NEAR(inertia * a.z(), foot.x() * bears - head.y() * push, 1e-9) << t;
  }
  EXPECT_THROW(FallingLadder(2, 0, 1.0 / 3, 9.81, 0.4, 5), std::invalid_argument);
  EXPECT_THROW(FallingLadder(2, 0, 1.0 / 3, 9.81, 0, 1), std::invalid_argument);
}

// The sums over the disc by the midpoint rule in polar coordinates about the point that does not move: there the
// velocity is w times the distance from it, along the circle, and the integrand has no singularity left.
Eigen::Vector2d friction_by_quadrature(double e) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const int rays = 4000, cells = 400;
  for (int i = 0; i < rays; ++i) {
    // The resting point of the disc is at y = e: v - w y = 0. A ray from it, in units of R.
    const double angle = 2 * kPi * (i + 0.5) / rays, c = std::cos(angle), s = std::sin(angle);
    const double middle = -e * s, under = 1 - e * e * c * c;
    if (under <= 0) continue;
    const double from = std::max(0.0, middle - std::sqrt(under)), to = middle + std::sqrt(under);
    if (to <= from) continue;
    const double width = (to - from) / cells;
    for (int j = 0; j < cells; ++j) {
      const double r = from + (j + 0.5) * width, x = r * c, y = e + r * s;
      const double area = r * width * 2 * kPi / rays / kPi;  // over that of the disc
      sum += area * Eigen::Vector2d(-s, x * c + y * s);      // the direction of motion is (-s, c)
    }
  }
  return sum;
}

TEST(CurlingDisc, SumsFrictionOverTheDisc) {
  for (const double e : {0.02, 0.09, 0.11, 0.5, 0.653, 0.98}) {
    const Eigen::Vector2d sums = friction_by_quadrature(e);  // second order: 400 cells, 4000 rays, below 1e-5
    EXPECT_NEAR(disc_friction_force(e), sums(0), 1e-5) << e;
    EXPECT_NEAR(disc_friction_moment(e), sums(1), 1e-5) << e;
  }
  for (const double e : {1.05, 2.0, 9.0, 11.0}) {
    const Eigen::Vector2d sums = friction_by_quadrature(e);  // rays graze the disc: root singularities
    EXPECT_NEAR(disc_friction_force(e), sums(0), 1e-3) << e;
    EXPECT_NEAR(disc_friction_moment(e), sums(1), 1e-3) << e;
  }
  EXPECT_NEAR(disc_friction_moment(0), 2.0 / 3, 1e-15);
  EXPECT_EQ(disc_friction_force(0), 0);
  // Series and brackets meet at a tenth.
  for (const double e : {0.1, 10.0}) {
    EXPECT_NEAR(disc_friction_force(e * (1 - 1e-12)), disc_friction_force(e * (1 + 1e-12)), 1e-11);
    EXPECT_NEAR(disc_friction_moment(e * (1 - 1e-12)), disc_friction_moment(e * (1 + 1e-12)), 1e-11);
  }
}

TEST(CurlingDisc, StopsSlidingAndSpinningTogetherAtThePublishedRatio) {
  for (const double spin : {1.0, 10.0, 40.0}) {
    EXPECT_NEAR(CurlingDisc(0.5, 0.5, 2, 2, spin).final_ratio(), 0.653002, 1e-6) << spin;
  }
}

TEST(CurlingDisc, SatisfiesItsEquations) {
  const double R = 0.5, k = 0.5, brake = 2;
  const CurlingDisc disc(R, k, brake, 2, 6);
  const auto all = [&](double t) {
    const DiscState s = disc.at(t);
    return Eigen::Vector4d(s.way, s.speed, s.turn, s.spin);
  };
  for (const double share : {0.1, 0.5, 0.9}) {
    const double t = share * disc.stop_time();
    const Eigen::Vector4d now = all(t), slope = derivative(all, t, 0.004);
    const double e = now(1) / (R * now(3));
    EXPECT_NEAR(slope(0), now(1), 1e-10);
    EXPECT_NEAR(slope(1), -brake * disc_friction_force(e), 1e-9);
    EXPECT_NEAR(slope(2), now(3), 1e-10);
    EXPECT_NEAR(slope(3), -brake / (k * R) * disc_friction_moment(e), 1e-8);
  }
  EXPECT_EQ(disc.at(2 * disc.stop_time()).speed, 0);
  EXPECT_THROW(CurlingDisc(0, k, brake, 2, 6), std::invalid_argument);
  EXPECT_THROW(disc.at(-1), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
