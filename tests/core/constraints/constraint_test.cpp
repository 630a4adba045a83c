#include "plumbline/core/constraints/constraint.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "particle_scenes.hpp"
#include "plumbline/core/constraints/angle_range.hpp"
#include "plumbline/core/constraints/coordinate_range.hpp"
#include "plumbline/core/constraints/keep_out.hpp"
#include "plumbline/core/constraints/link_constraint.hpp"

namespace plumbline {
namespace {

using namespace particles;
constexpr double kPi = std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::array<double, 3> kEqual{1, 1, 1};

// Every kind of constraint, each of particles 0, 1, 2 as far as it needs them.
ConstraintList all_kinds() {
  ConstraintList list;
  list.add(CoordinateRange(0, Vec3(1, 2, 2), -0.3, 0.4));
  list.add(LinkConstraint(0, 1, 1.2));
  list.add(LinkConstraint(0, 1, 0.5, 0.7));
  list.add(AngleRange(0, 1, 2, 0.8, 1.1));
  list.add(AngleRange(0, 1, 2, -0.4, 0.3, Vec3(1, -1, 3)));
  list.add(ParticleKeepOut(0, {HalfSpace{Vec3(1, 1, 2).normalized()}, Vec3(0.1, 0, 0), Quat::Identity()}));
  list.add(ParticleKeepOut(0, {Sphere{1.5}, Vec3(0.2, 0.1, 0), Quat::Identity()}));
  list.add(ParticleKeepOut(0, {Box{Vec3(2, 3, 1.8)}, Vec3(0.2, 0.1, 0), rotation_by(Vec3(0.3, 0.5, -0.2))}));
  list.add(LinkKeepOut(0, 1, {Sphere{0.9}, Vec3(0.2, 0.1, 0), Quat::Identity()}));
  list.add(LinkKeepOut(0, 1, {HalfSpace{Vec3::UnitZ()}, Vec3(0, 0, 0.1), Quat::Identity()}));
  list.add(LinkKeepOut(0, 1, {Box{Vec3(1, 1.5, 0.8)}, Vec3(0.2, 0.1, 0), rotation_by(Vec3(0.3, 0.5, -0.2))}));
  return list;
}

// Three particles not too close to each other, where angles and distances have no singularity.
std::array<Vec3, 3> random_places(Random& random) {
  for (;;) {
    const std::array<Vec3, 3> p{random.vector(1), random.vector(1), random.vector(1)};
    const Vec3 u = p[0] - p[1], v = p[2] - p[1];
    if (u.norm() > 0.4 && v.norm() > 0.4 && u.normalized().cross(v.normalized()).norm() > 0.2) return p;
  }
}

TEST(ConstraintGradient, IsTheSlopeOfTheViolation) {
  const ConstraintList kinds = all_kinds();
  Random random(1);
  std::vector<int> checked(kinds.size(), 0);
  for (int trial = 0; trial < 400; ++trial) {
    const auto p = random_places(random);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::size_t count = kinds[k].particles().size();
      const PerParticle gradient = kinds[k].gradient({p.data(), count});
      PerParticle d;
      double slope = 0;
      for (std::size_t i = 0; i < count; ++i) {
        d[i] = random.direction();
        slope += gradient[i].dot(d[i]);
      }
      // Central differences over h and 2 h: the error of the first is a third of what they differ by, to next order,
      // plus the rounding of C over h. Places where C changes its formula within 2 h are left out.
      const double h = 1e-5;
      const auto shifted = [&](double step) {
        std::array<Vec3, 3> q = p;
        for (std::size_t i = 0; i < count; ++i) q[i] += step * d[i];
        return kinds[k].violation({q.data(), count});
      };
      const double here = kinds[k].violation({p.data(), count});
      const double up = shifted(h), down = shifted(-h), up2 = shifted(2 * h), down2 = shifted(-2 * h);
      if (here == 0 || up2 == 0 || down2 == 0 || std::abs(up2 - 2 * here + down2) > 1e-7) continue;
      const double narrow = (up - down) / (2 * h), wide = (up2 - down2) / (4 * h);
      EXPECT_NEAR(narrow, slope, std::abs(wide - narrow) + 20 * kEps / h) << "constraint " << k << ", trial " << trial;
      ++checked[k];
    }
  }
  for (const int count : checked) EXPECT_GT(count, 30);
}

TEST(MinimalMotion, MeetsTheConstraintAndIsTheSmallestThatDoes) {
  const ConstraintList kinds = all_kinds();
  Random random(2);
  std::vector<int> checked(kinds.size(), 0);
  for (int trial = 0; trial < 300; ++trial) {
    const auto p = random_places(random);
    const std::array<double, 3> w{random.in(0.2, 3), random.in(0.2, 3), random.in(0.2, 3)};
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::size_t count = kinds[k].particles().size();
      const std::span<const Vec3> here(p.data(), count);
      const std::span<const double> masses(w.data(), count);
      // A link in a box has edges and corners in its way, where no smooth condition finds the smallest motion, and an
      // angle too far off has no smallest one.
      const bool angle = k == 3 || k == 4;
      const bool smooth = k != 10 && !(angle && std::abs(kinds[k].violation(here)) > 0.5);
      if (kinds[k].violation(here) == 0) continue;
      if (kinds[k].gradient(here)[0].norm() > 2.5) continue;  // an arm below 0.4 m in the plane
      const MinimalMotion motion = kinds[k].minimal_motion(here, masses);
      const std::vector<Vec3> end = moved(here, motion.d_W);
      // Positions of size 2 are rounded to 4e-16; gradients are below 1/0.4 and there are up to three of them.
      EXPECT_NEAR(kinds[k].violation(end), 0, 20 * kEps) << "constraint " << k << ", trial " << trial;
      // No other motion that meets it costs less: from a random place nearby, restored.
      for (int other = 0; smooth && other < 3; ++other) {
        PerParticle aside = motion.d_W;
        for (std::size_t i = 0; i < count; ++i) aside[i] += random.vector(0.05);
        const std::vector<Vec3> from = moved(here, aside);
        const MinimalMotion back = kinds[k].minimal_motion(from, masses);
        for (std::size_t i = 0; i < count; ++i) aside[i] += back.d_W[i];
        // d is the smallest to first order already; a rounding of it shows only in second order.
        EXPECT_GE(cost(aside, masses), cost(motion.d_W, masses) * (1 - 1e-12)) << "constraint " << k;
      }
      ++checked[k];
    }
  }
  for (const int count : checked) EXPECT_GT(count, 30);
}

TEST(MinimalMotion, LeavesHeldParticlesAndMetConstraintsAlone) {
  const ConstraintList kinds = all_kinds();
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = random_places(random);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::size_t count = kinds[k].particles().size();
      const std::array<double, 3> none{0, 0, 0}, first_held{0, 1, 1};
      const MinimalMotion still = kinds[k].minimal_motion({p.data(), count}, {none.data(), count});
      for (const Vec3& d : still.d_W) EXPECT_EQ(d, Vec3(Vec3::Zero()));
      EXPECT_EQ(kinds[k].minimal_motion({p.data(), count}, {first_held.data(), count}).d_W[0], Vec3(Vec3::Zero()));
      if (kinds[k].violation({p.data(), count}) != 0) continue;
      EXPECT_EQ(cost(kinds[k].minimal_motion({p.data(), count}, {kEqual.data(), count}).d_W, kEqual), 0);
    }
  }
}

TEST(MinimalMotion, OfLinksAndAnglesKeepsCentreOfMassAndDoesNotTurn) {
  Random random(4);
  const LinkConstraint link(0, 1, 1.2);
  const AngleRange in_space(0, 1, 2, 0.8, 1.1);
  int checked = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto p = random_places(random);
    const std::array<double, 3> w{random.in(0.2, 3), random.in(0.2, 3), random.in(0.2, 3)};
    // In the plane through the three particles the signed angle is one of particles in a plane.
    const Vec3 axis = (p[0] - p[1]).cross(p[2] - p[1]);
    const AngleRange in_plane(0, 1, 2, -0.4, 0.3, axis);
    for (const Constraint* constraint :
         {static_cast<const Constraint*>(&link), static_cast<const Constraint*>(&in_space),
          static_cast<const Constraint*>(&in_plane)}) {
      const std::size_t count = constraint->particles().size();
      const std::span<const double> masses(w.data(), count);
      const MinimalMotion motion = constraint->minimal_motion({p.data(), count}, masses);
      // Masses up to 5, positions and motions up to 3: products of 45, of which each rounding keeps 1e-16. The motion
      // of an angle is repeated until it changes by 1e-15 of itself.
      EXPECT_LE(shift(motion.d_W, masses).norm(), 1e-14);
      if (std::abs(constraint->violation({p.data(), count})) > 0.5) continue;
      EXPECT_LE(turn({p.data(), count}, motion.d_W, masses).norm(), 5e-14) << trial;
      checked += motion.multiplier != 0;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(CoordinateRange, ClampsLikeSlide34) {
  const CoordinateRange range(0, Vec3::UnitX(), 0, 100);
  const auto clamped = [&](double x) {
    const std::array<Vec3, 1> p{Vec3(x, 5, -7)};
    return moved(p, range.minimal_motion(p, std::array{0.5}).d_W)[0];
  };
  EXPECT_EQ(clamped(-3), Vec3(0, 5, -7));
  EXPECT_EQ(clamped(130), Vec3(100, 5, -7));
  EXPECT_EQ(clamped(42), Vec3(42, 5, -7));
  EXPECT_TRUE(clamped(kNaN).hasNaN());
}

TEST(LinkConstraint, IsRestoredByTheSlidesMotionOnlyWithItsSignsTurnedRound) {
  const std::array<Vec3, 2> p{Vec3(1, 2, 3), Vec3(1, 5, 7)};  // 5 apart
  for (const double d : {3.0, 4.0, 6.0, 9.0}) {
    const LinkConstraint link(0, 1, d);
    const Vec3 v = p[1] - p[0];
    const double gamma = (v.norm() - d) / (2 * v.norm());
    const std::array<Vec3, 2> slide{p[0] - gamma * v, p[1] + gamma * v};
    const std::array<Vec3, 2> ours{p[0] + gamma * v, p[1] - gamma * v};
    const double before = link.violation(p);
    EXPECT_EQ(before, 5 - d);
    // As printed on slide 34: twice as wrong as before.
    EXPECT_NEAR(link.violation(slide), 2 * before, 20 * kEps);
    EXPECT_NEAR(link.violation(ours), 0, 20 * kEps);
    const auto restored = moved(p, link.minimal_motion(p, std::array{1.0, 1.0}).d_W);
    EXPECT_LE((restored[0] - ours[0]).norm() + (restored[1] - ours[1]).norm(), 20 * kEps);
    EXPECT_NEAR(link.violation(restored), 0, 20 * kEps);
  }
}

TEST(LinkConstraint, MovesTheLighterEndMore) {
  const LinkConstraint rod(0, 1, 1);
  const std::array<Vec3, 2> p{Vec3(0, 0, 0), Vec3(5, 0, 0)};
  const MinimalMotion motion = rod.minimal_motion(p, std::array{1.0, 3.0});
  EXPECT_EQ(motion.d_W[0], Vec3(1, 0, 0));
  EXPECT_EQ(motion.d_W[1], Vec3(-3, 0, 0));
  EXPECT_EQ(motion.multiplier, 1);
}

TEST(LinkConstraint, WithARangeActsOnlyOutsideIt) {
  const LinkConstraint string(0, 1, 0, 2), apart(0, 1, 2, kInfinity);
  const std::array<Vec3, 2> near{Vec3(0, 0, 0), Vec3(1, 0, 0)}, far{Vec3(0, 0, 0), Vec3(3, 0, 0)};
  EXPECT_EQ(string.violation(near), 0);
  EXPECT_EQ(string.violation(far), 1);
  EXPECT_EQ(apart.violation(near), -1);
  EXPECT_EQ(apart.violation(far), 0);
  const std::array<Vec3, 2> same{Vec3(1, 1, 1), Vec3(1, 1, 1)};
  EXPECT_EQ(apart.violation(moved(same, apart.minimal_motion(same, std::array{1.0, 1.0}).d_W)), 0);
}

TEST(AngleRange, KnowsInAPlaneToWhichSideTheLimbBends) {
  const AngleRange elbow(0, 1, 2, 0, 2.5, Vec3::UnitZ());
  const auto places = [](double angle) {
    return std::array<Vec3, 3>{Vec3(1, 0, 0.3), Vec3(0, 0, 0), Vec3(std::cos(angle), std::sin(angle), -0.2)};
  };
  for (const double angle : {-3.0, -1.0, 0.0, 1.0, 3.0}) EXPECT_NEAR(elbow.angle(places(angle)), angle, 4 * kEps);
  EXPECT_EQ(elbow.violation(places(1)), 0);
  EXPECT_NEAR(elbow.violation(places(-0.5)), -0.5, 4 * kEps);
  EXPECT_NEAR(elbow.violation(places(3)), 0.5, 4 * kEps);
  // -3 is 3.283 the other way round: 0.783 beyond the upper end, 3 below the lower one.
  EXPECT_NEAR(elbow.violation(places(-3)), 2 * kPi - 3 - 2.5, 8 * kEps);
}

TEST(AngleRange, RestoresLimbsThatAreExactlyStretchedOrFolded) {
  for (const double x : {-1.0, 1.0}) {
    const std::array<Vec3, 3> p{Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(2 * x, 0, 0)};
    const AngleRange range(0, 1, 2, 1, 2);
    const auto end = moved(p, range.minimal_motion(p, kEqual).d_W);
    EXPECT_NEAR(range.violation(end), 0, 20 * kEps) << x;
  }
}

TEST(Constraint, ShowsNaN) {
  const ConstraintList kinds = all_kinds();
  const std::array<Vec3, 3> p{Vec3(kNaN, 0, 0), Vec3(kNaN, 1, 0), Vec3(1, 1, kNaN)};
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::size_t count = kinds[k].particles().size();
    if (k == 9) continue;  // a half-space along z does not see x
    EXPECT_TRUE(std::isnan(kinds[k].violation({p.data(), count}))) << k;
    EXPECT_TRUE(kinds[k].minimal_motion({p.data(), count}, {kEqual.data(), count}).d_W[0].hasNaN()) << k;
  }
}

TEST(Constraint, RefusesWhatCannotBe) {
  EXPECT_THROW(LinkConstraint(1, 1, 1), std::invalid_argument);
  EXPECT_THROW(LinkConstraint(0, 1, 0), std::invalid_argument);
  EXPECT_THROW(LinkConstraint(0, 1, 2, 1), std::invalid_argument);
  EXPECT_THROW(LinkConstraint(0, 1, kNaN), std::invalid_argument);
  EXPECT_THROW(CoordinateRange(0, Vec3::Zero(), 0, 1), std::invalid_argument);
  EXPECT_THROW(CoordinateRange(0, Vec3::UnitX(), 1, 0), std::invalid_argument);
  EXPECT_THROW(AngleRange(0, 1, 2, 1, 4), std::invalid_argument);
  EXPECT_THROW(AngleRange(0, 1, 0, 1, 2), std::invalid_argument);
  EXPECT_THROW(AngleRange(0, 1, 2, 0, 7, Vec3::UnitZ()), std::invalid_argument);
  EXPECT_THROW(AngleRange(0, 1, 2, 0, 1, Vec3::Zero()), std::invalid_argument);
  EXPECT_THROW(ParticleKeepOut(0, {Sphere{0}}), std::invalid_argument);
  EXPECT_THROW(LinkKeepOut(0, 1, {Box{Vec3(1, 0, 1)}}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
