// Contact manifolds of boxes against distances that know nothing of axes or clipping, and where the answer is plain.
#include "plumbline/core/collision/contact_manifold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "manifold_oracles.hpp"

namespace plumbline {
namespace {

using namespace oracles;

// Corner on face and edge on edge are what two boxes at random meet with; at a gap of g other features are nearest in a
// share of about g/size of all pairs. The oracle's error is that of coordinates of a few metres.
TEST(BoxManifold, HasTheDistanceOfBoxesThatNearlyTouch) {
  Random random(11);
  int face = 0, edge = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto [a, b] = near_touch(random, 1e-7);
    const double exact = distance(a, b);
    const auto contacts = contacts_of(a, b);
    ASSERT_FALSE(contacts.empty()) << k;
    const auto nearest = *std::min_element(contacts.begin(), contacts.end(),
                                           [](const Contact& x, const Contact& y) { return x.gap < y.gap; });
    ASSERT_NEAR(nearest.gap, exact, 64 * kEps * 8) << k;
    ASSERT_NEAR(nearest.normal_W.norm(), 1, 8 * kEps) << k;
    // Halfway between the surfaces; where edges cross above a face that is tilted by up to kLyingAngle, halfway along
    // the face's normal, which is longer by kLyingAngle^2/2.
    ASSERT_NEAR(distance_to_box(nearest.point_W, a), 0.5 * exact, 0.01 * exact) << k;
    ASSERT_NEAR(distance_to_box(nearest.point_W, b), 0.5 * exact, 0.01 * exact) << k;
    // Moved by d along the normal, a is at d more: the normal is the right one, to sqrt(2 * 1e-15/d) and better.
    PlacedBox moved = a;
    moved.state.p_WB += 1e-3 * nearest.normal_W;
    ASSERT_NEAR(distance(moved, b), exact + 1e-3, 64 * kEps * 8) << k;
    ++(contacts.size() == 1 ? edge : face);
  }
  EXPECT_GT(std::min(face, edge), 200);
}

TEST(BoxManifold, HasTheDepthOfBoxesThatOverlap) {
  Random random(12);
  int same = 0;
  for (int k = 0; k < 1000; ++k) {
    auto [a, b] = near_touch(random, 1e-7);
    const double depth = 1e-4;
    a.state.p_WB -= depth * contacts_of(a, b).front().normal_W;
    const double exact = separation(a, b), found = nearest_gap(contacts_of(a, b));
    ASSERT_LT(exact, 0);
    // A deepest corner may lie beyond the rim of the face by about the depth: then what is left is less deep.
    ASSERT_GE(found, exact - 64 * kEps * 8) << k;
    same += std::abs(found - exact) < 64 * kEps * 8;
  }
  EXPECT_GE(same, 990);
}

// Whichever box is called a: the same points, the opposite normals.
TEST(BoxManifold, IsTheSameFromBothSides) {
  Random random(13);
  for (int k = 0; k < 1000; ++k) {
    const auto [a, b] = near_touch(random, 1e-6);
    const auto there = contacts_of(a, b), back = contacts_of(b, a);
    ASSERT_EQ(there.size(), back.size()) << k;
    for (const Contact& c : there) {
      const bool found = std::any_of(back.begin(), back.end(), [&](const Contact& d) {
        return (c.point_W - d.point_W).norm() < 1e-14 * 8 && (c.normal_W + d.normal_W).norm() < 1e-14 &&
               std::abs(c.gap - d.gap) < 1e-14 * 8;
      });
      ASSERT_TRUE(found) << k;
    }
  }
}

// A contact is a fact of the bodies, not of the frame that they are described in.
TEST(BoxManifold, MovesWithTheFrame) {
  Random random(14);
  for (int k = 0; k < 300; ++k) {
    const auto [a, b] = near_touch(random, 1e-6);
    const Quat turn = random.attitude();
    const Vec3 shift = random.vector(5);
    auto moved_a = a, moved_b = b;
    for (PlacedBox* x : {&moved_a, &moved_b}) {
      x->state.p_WB = turn * x->state.p_WB + shift;
      x->state.q_WB = turn * x->state.q_WB;
    }
    const auto here = contacts_of(a, b), there = contacts_of(moved_a, moved_b);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      ASSERT_LT((turn * here[i].point_W + shift - there[i].point_W).norm(), 1e-13) << k;
      ASSERT_LT((turn * here[i].normal_W - there[i].normal_W).norm(), 1e-13) << k;
      ASSERT_NEAR(here[i].gap, there[i].gap, 1e-14) << k;
    }
  }
}

TEST(BoxManifold, OfABoxUponALargerOneIsItsFourCorners) {
  const PlacedBox low = flat(Vec3(4, 4, 1), Vec3::Zero());
  for (const double gap : {0.0, 0.25, -0.125}) {
    const PlacedBox high = flat(Vec3(1, 2, 0.5), Vec3(0.5, -0.25, 0.75 + gap));
    const double z = 0.5 + 0.5 * gap;
    expect_points(contacts_of(high, low), {{0, -1.25, z}, {1, -1.25, z}, {0, 0.75, z}, {1, 0.75, z}}, Vec3::UnitZ(),
                  gap);
    expect_points(contacts_of(low, high), {{0, -1.25, z}, {1, -1.25, z}, {0, 0.75, z}, {1, 0.75, z}}, -Vec3::UnitZ(),
                  gap);
  }
}

TEST(BoxManifold, OfEqualBoxesInAStackIsTheirCommonFace) {
  const std::vector<Vec3> square = {{-0.5, -0.5, 0.5}, {0.5, -0.5, 0.5}, {-0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  expect_points(contacts_of(flat(Vec3::Ones(), Vec3(0, 0, 1)), flat(Vec3::Ones(), Vec3::Zero())), square, Vec3::UnitZ(),
                0);
  // Shifted to the side: the common rectangle.
  const std::vector<Vec3> half = {{0.25, -0.5, 0.5}, {0.5, -0.5, 0.5}, {0.25, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  expect_points(contacts_of(flat(Vec3::Ones(), Vec3(0.75, 0, 1)), flat(Vec3::Ones(), Vec3::Zero())), half,
                Vec3::UnitZ(), 0);
}

TEST(BoxManifold, OfSquaresTurnedByAnEighthIsAnOctagon) {
  std::vector<Vec3> octagon;
  const double in = 0.5 * (std::sqrt(2.0) - 1);
  for (const double s : {-1.0, 1.0}) {
    for (const double r : {-1.0, 1.0}) {
      octagon.push_back({0.5 * s, in * r, 0.5});
      octagon.push_back({in * r, 0.5 * s, 0.5});
    }
  }
  expect_points(contacts_of(flat(Vec3::Ones(), Vec3(0, 0, 1), kPi / 4), flat(Vec3::Ones(), Vec3::Zero())), octagon,
                Vec3::UnitZ(), 0, 4e-16);
}

// Laid down with the error of many steps: every tilt that rounding makes keeps all the corners.
TEST(BoxManifold, KeepsItsCornersUnderTheTiltsThatRoundingMakes) {
  Random random(15);
  for (const double tilt : {1e-15, 1e-13, 1e-11, 1e-9, 1e-7}) {
    for (int k = 0; k < 100; ++k) {
      PlacedBox high = flat(Vec3::Ones(), Vec3(0.1, 0.2, 1), k % 2 == 0 ? 0 : random.in(0, kPi));
      high.state.q_WB = rotation_by(random.vector(tilt)) * high.state.q_WB;
      const auto contacts = contacts_of(high, flat(Vec3(2, 2, 1), Vec3::Zero()));
      ASSERT_EQ(contacts.size(), 4u) << tilt;
      const auto twin = contacts_of(high, flat(Vec3::Ones(), Vec3::Zero(), 0.3));
      ASSERT_GE(twin.size(), 4u) << tilt;
      for (const Contact& c : twin) ASSERT_LT(std::abs(c.gap), 2 * tilt + 1e-15);
    }
  }
}

TEST(BoxManifold, OfAnEdgeOnAFaceIsItsTwoEnds) {
  const double half = std::sqrt(0.5);
  PlacedBox wedge = flat(Vec3(1, 2, 1), Vec3(0, 0, 0.5 + half));
  wedge.state.q_WB = rotation_by(Vec3(0, kPi / 4, 0));
  const auto contacts = contacts_of(wedge, flat(Vec3(4, 4, 1), Vec3::Zero()));
  std::vector<Vec3> touching;
  for (const Contact& c : contacts) {
    EXPECT_LT((c.normal_W - Vec3::UnitZ()).norm(), 1e-15);
    if (c.gap < 1e-12) touching.push_back(c.point_W);
  }
  ASSERT_EQ(touching.size(), 2u);
  EXPECT_LT((touching[0] + touching[1] - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_NEAR(std::abs(touching[0].y()), 1, 1e-15);
}

TEST(BoxManifold, OfCrossedEdgesIsTheirCrossing) {
  const double half = std::sqrt(0.5);
  PlacedBox low = flat(Vec3(4, 1, 1), Vec3::Zero()), high = flat(Vec3(1, 4, 1), Vec3(0.3, 0.2, 2 * half));
  low.state.q_WB = rotation_by(Vec3(kPi / 4, 0, 0));
  high.state.q_WB = rotation_by(Vec3(0, kPi / 4, 0));
  expect_points(contacts_of(high, low), {{0.3, 0, half}}, Vec3::UnitZ(), 0);
}

}  // namespace
}  // namespace plumbline
