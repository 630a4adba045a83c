#include "plumbline/core/collision/convex_polyhedron.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "random_scenes.hpp"

namespace plumbline {
namespace {

std::string complaint(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// Divergence theorem: three times the volume is the sum over the faces of offset times area.
double volume(const ConvexPolyhedron& solid) {
  double sum = 0;
  for (const auto& face : solid.faces()) {
    Vec3 twice_area = Vec3::Zero();
    const Vec3& first = solid.vertices_B()[face.corners[0]];
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
      twice_area +=
          (solid.vertices_B()[face.corners[k]] - first).cross(solid.vertices_B()[face.corners[k + 1]] - first);
    }
    sum += face.offset * 0.5 * twice_area.dot(face.normal_B);
  }
  return sum / 3;
}

TEST(ConvexPolyhedron, OfABoxHasItsFacesEdgesAndVolume) {
  const ConvexPolyhedron box = box_polyhedron(Vec3(1, 2, 4));
  EXPECT_EQ(box.vertices_B().size(), 8u);
  EXPECT_EQ(box.faces().size(), 6u);
  EXPECT_EQ(box.edges().size(), 12u);
  EXPECT_EQ(box.faces()[0].normal_B, Vec3(-1, 0, 0));
  EXPECT_EQ(box.faces()[5].normal_B, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(box.faces()[5].offset, 2);
  EXPECT_DOUBLE_EQ(box.radius(), 0.5 * std::sqrt(21.0));
  EXPECT_DOUBLE_EQ(volume(box), 8);
  for (const auto& edge : box.edges()) {
    // The left face is on the left of the edge, seen from outside.
    const Vec3 along = box.vertices_B()[edge.head] - box.vertices_B()[edge.tail];
    EXPECT_GT(box.faces()[edge.left].normal_B.cross(box.faces()[edge.right].normal_B).dot(along), 0);
  }
}

TEST(ConvexPolyhedron, HullHoldsAllPointsAndObeysEuler) {
  SceneRandom random(41);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Vec3> points;
    const int count = 4 + random.below(60);
    const Vec3 far = trial % 3 == 0 ? Vec3(100 * random.vector(1)) : Vec3(Vec3::Zero());
    for (int k = 0; k < count; ++k) points.push_back(far + random.vector(1));
    const ConvexPolyhedron hull = convex_hull(points);
    EXPECT_EQ(hull.vertices_B().size() + hull.faces().size(), hull.edges().size() + 2);
    for (const auto& face : hull.faces()) {
      double highest = -1e9;
      for (const Vec3& p : points) highest = std::max(highest, face.normal_B.dot(p) - face.offset);
      EXPECT_NEAR(highest, 0, ConvexPolyhedron::kFlatness * 4) << "trial " << trial;  // clouds of 4 m across at most
    }
    for (const Vec3& corner : hull.vertices_B())
      EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
  }
}

TEST(ConvexPolyhedron, HullOfAGridOfPointsIsABoxHoweverItIsTurned) {
  SceneRandom random(42);
  for (int trial = 0; trial < 50; ++trial) {
    const Quat turn = trial == 0 ? rotation_by(Vec3::Zero()) : random.attitude();
    std::vector<Vec3> points;
    for (int k = 0; k < 64; ++k) points.push_back(turn * Vec3(k % 4 - 1.5, k / 4 % 4 - 1.5, 2 * (k / 16) - 3));
    for (std::size_t k = points.size() - 1; k > 0; --k) {
      std::swap(points[k], points[static_cast<std::size_t>(random.below(static_cast<int>(k) + 1))]);
    }
    const ConvexPolyhedron hull = convex_hull(points);
    EXPECT_EQ(hull.vertices_B().size(), 8u) << "trial " << trial;
    EXPECT_EQ(hull.faces().size(), 6u);
    EXPECT_EQ(hull.edges().size(), 12u);
    EXPECT_NEAR(volume(hull), 3 * 3 * 6, 54 * 1e-14);  // some dozen roundings
  }
}

// The dodecahedron of edge a has the volume (15 + 7 sqrt 5)/4 a^3 (Euclid XIII; Coxeter, Regular Polytopes, table I).
TEST(ConvexPolyhedron, HullOfTheDodecahedronMergesItsPentagons) {
  const double phi = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> points;
  for (int k = 0; k < 8; ++k) {
    const double x = (k & 1) != 0 ? 1 : -1, y = (k & 2) != 0 ? 1 : -1;
    points.push_back(Vec3(x, y, (k & 4) != 0 ? 1 : -1));
    if (k >= 4) continue;
    points.push_back(Vec3(0, x / phi, y * phi));
    points.push_back(Vec3(x / phi, y * phi, 0));
    points.push_back(Vec3(x * phi, 0, y / phi));
  }
  const ConvexPolyhedron solid = convex_hull(points);
  EXPECT_EQ(solid.vertices_B().size(), 20u);
  EXPECT_EQ(solid.faces().size(), 12u);
  EXPECT_EQ(solid.edges().size(), 30u);
  const double edge = 2 / phi;
  EXPECT_NEAR(volume(solid), 0.25 * (15 + 7 * std::sqrt(5.0)) * edge * edge * edge, 1e-13);  // a volume of 14.5
}

TEST(ConvexPolyhedron, SaysWhatIsWrong) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto hull = [](std::vector<Vec3> points) { return [points] { convex_hull(points); }; };
  EXPECT_NE(complaint(hull({o, x, y})).find("at least four"), std::string::npos);
  EXPECT_NE(complaint(hull({o, x, y, x + y, 0.5 * x})).find("one plane"), std::string::npos);
  EXPECT_NE(complaint(hull({o, o, o, o, o})).find("one plane"), std::string::npos);
  EXPECT_NE(complaint(hull({o, x, y, z, Vec3(nan, 0, 0)})).find("finite"), std::string::npos);
  EXPECT_NE(complaint([] { box_polyhedron(Vec3(1, 0, 1)); }).find("edge lengths"), std::string::npos);
  EXPECT_NE(complaint([&] { box_polyhedron(Vec3(1, nan, 1)); }).find("edge lengths"), std::string::npos);

  const std::vector<Vec3> corners{o, x, y, z};
  const auto made = [&](std::vector<std::vector<std::size_t>> loops) {
    return [corners, loops] { ConvexPolyhedron(corners, loops); };
  };
  EXPECT_EQ(complaint(made({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})), "");
  EXPECT_NE(complaint(made({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}})).find("at least four"), std::string::npos);
  EXPECT_NE(complaint(made({{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})).find("turned round"), std::string::npos);
  EXPECT_NE(complaint(made({{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}})).find("in front of"), std::string::npos);
  EXPECT_NE(complaint(made({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3}})).find("fewer than three"), std::string::npos);
  EXPECT_NE(complaint(made({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 9}})).find("corner 9"), std::string::npos);
}

}  // namespace
}  // namespace plumbline
