// Contacts of convex polyhedra, of spheres with boxes, and the order of pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetic_scenes.hpp"
#include "manifold_oracles.hpp"

namespace plumbline {
namespace {

using namespace oracles;
using namespace scenes;

// The general code with the box's polyhedron, and with solids that have no box's symmetry.
TEST(ConvexManifold, OfABoxsPolyhedronIsTheBoxs) {
  Random random(16);
  for (int k = 0; k < 300; ++k) {
    const auto [a, b] = near_touch(random, 1e-6);
    const auto boxes = contacts_of(a, b);
    const auto hulls = convex_contacts(box_polyhedron(a.size), a.state, box_polyhedron(b.size), b.state);
    ASSERT_EQ(boxes.size(), hulls.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ASSERT_LT((boxes[i].point_W - hulls[i].point_W).norm(), 1e-14);
      ASSERT_LT((boxes[i].normal_W - hulls[i].normal_W).norm(), 1e-14);
    }
  }
}

TEST(ConvexManifold, OfAPyramidUponAPrismIsItsBase) {
  const std::vector<Vec3> pyramid = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  const std::vector<Vec3> prism = {{-3, -3, -1}, {3, -3, -1}, {0, 3, -1}, {-3, -3, 0}, {3, -3, 0}, {0, 3, 0}};
  BodyState low, high;
  high.p_WB = Vec3(0, -1.5, 2);
  low.p_WB = Vec3(0, 0, 2);
  expect_points(convex_contacts(convex_hull(pyramid), high, convex_hull(prism), low),
                {{-1, -2.5, 2}, {1, -2.5, 2}, {1, -0.5, 2}, {-1, -0.5, 2}}, Vec3::UnitZ(), 0);
  // On its tip: one contact.
  high.q_WB = rotation_by(Vec3(kPi, 0, 0));
  high.p_WB.z() = 3;
  const auto contacts = convex_contacts(convex_hull(pyramid), high, convex_hull(prism), low);
  EXPECT_EQ(std::count_if(contacts.begin(), contacts.end(), [](const Contact& c) { return c.gap < 1e-12; }), 1);
  EXPECT_NEAR(nearest_gap(contacts), 0, 1e-15);
}

struct PlacedHull {
  ConvexPolyhedron shape;
  BodyState state;
  Vec3 corner(std::size_t k) const { return state.p_WB + state.q_WB * shape.vertices_B()[k]; }
};

// Corners over faces, one way.
double corner_to_face(const PlacedHull& a, const PlacedHull& b) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.shape.vertices_B().size(); ++k) {
    const Vec3 x = b.state.q_WB.conjugate() * (a.corner(k) - b.state.p_WB);
    for (const auto& face : b.shape.faces()) {
      bool over = true;
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const Vec3 &tail = b.shape.vertices_B()[face.corners[i]],
                   &head = b.shape.vertices_B()[face.corners[(i + 1) % face.corners.size()]];
        over = over && face.normal_B.cross(head - tail).dot(x - tail) >= 0;
      }
      const double height = face.normal_B.dot(x) - face.offset;
      if (over && height >= 0) best = std::min(best, height);
    }
  }
  return best;
}

// Of hulls that do not overlap, feature by feature: corners over faces, and edges to edges, which covers the rest.
double distance(const PlacedHull& a, const PlacedHull& b) {
  double best = std::min(corner_to_face(a, b), corner_to_face(b, a));
  for (const auto& e : a.shape.edges()) {
    for (const auto& f : b.shape.edges()) {
      best = std::min(best, segment_distance(a.corner(e.tail), a.corner(e.head) - a.corner(e.tail), b.corner(f.tail),
                                             b.corner(f.head) - b.corner(f.tail)));
    }
  }
  return best;
}

TEST(ConvexManifold, HasTheDistanceOfRandomHullsThatNearlyTouch) {
  Random random(17);
  int face = 0, edge = 0;
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec3> cloud_a, cloud_b;
    for (int i = 0; i < 10; ++i) {
      cloud_a.push_back(random.attitude() * Vec3::UnitX());
      cloud_b.push_back(random.attitude() * Vec3(0.7, 0, 0));
    }
    const PlacedHull a{convex_hull(cloud_a), {random.vector(1), random.attitude()}};
    PlacedHull b{convex_hull(cloud_b), {Vec3::Zero(), random.attitude()}};
    const Vec3 line = random.attitude() * Vec3::UnitX();
    b.state.p_WB = a.state.p_WB + 3 * line;
    // A step as long as the gap that is too much never leads into an overlap.
    for (double d = 1; d > 5e-7; b.state.p_WB -= (d - 1e-7) * line) d = distance(a, b);
    const double exact = distance(a, b);
    ASSERT_LT(exact, 1e-6);
    const auto contacts = convex_contacts(a.shape, a.state, b.shape, b.state);
    ASSERT_NEAR(nearest_gap(contacts), exact, 64 * kEps * 4) << k;
    ++(contacts.size() == 1 ? edge : face);
  }
  EXPECT_GT(std::min(face, edge), 10);
}

TEST(SphereBoxContact, IsTheNearestPointOfTheBox) {
  Random random(18);
  int face = 0, edge = 0, corner = 0;
  for (int k = 0; k < 3000; ++k) {
    const PlacedBox box{Vec3(random.in(0.2, 2), random.in(0.2, 2), random.in(0.2, 2)),
                        {random.vector(2), random.attitude()}};
    BodyState sphere;
    sphere.p_WB = box.state.p_WB + random.vector(2);
    const double radius = random.in(0.1, 1), exact = distance_to_box(sphere.p_WB, box);
    if (exact < 1e-3) continue;
    const Contact c = sphere_box_contact(sphere, radius, box.state, box.size);
    ASSERT_NEAR(c.gap, exact - radius, 32 * kEps * 4);
    // The foot of the perpendicular lies on the box, and nothing of the box is nearer: it is on the far side of the
    // plane through the foot.
    const Vec3 foot = sphere.p_WB - exact * c.normal_W;
    ASSERT_LT(distance_to_box(foot, box), 32 * kEps * 4);
    int level = 0;
    for (int i = 0; i < 8; ++i) {
      const double height = c.normal_W.dot(box.state.p_WB + box.state.q_WB * box_corner(box.size, i) - foot);
      ASSERT_LT(height, 64 * kEps * 4 / exact);
      level += height > -1e-6;
    }
    ++(level >= 4 ? face : level >= 2 ? edge : corner);
    ASSERT_LT((c.point_W - (foot + 0.5 * c.gap * c.normal_W)).norm(), 64 * kEps * 4);
  }
  EXPECT_GT(std::min({face, edge, corner}), 200);
}

TEST(SphereBoxContact, LeavesABoxThroughItsNearestFace) {
  BodyState sphere, box;
  box.p_WB = Vec3(1, 1, 1);
  sphere.p_WB = Vec3(1, 1, 0.25);  // a quarter above the bottom of a box of 2
  const Contact c = sphere_box_contact(sphere, 0.5, box, Vec3(2, 2, 2));
  EXPECT_EQ(c.normal_W, Vec3(0, 0, -1));
  EXPECT_NEAR(c.gap, -0.75, 1e-15);
}

TEST(ContactPairs, NameSpheresFirstAndHalfSpacesLast) {
  const Vec3 o = Vec3::Zero();
  std::vector<Body> bodies = {ground(), solid("box", Box{Vec3::Ones()}, 1, o, o), ball("ball", 1, 1, o, o),
                              solid("box2", Box{Vec3::Ones()}, 1, o, o)};
  std::vector<BodyState> states(4);
  std::vector<Contact> contacts;
  for (const Pair p : contact_pairs(bodies)) {
    EXPECT_LE(bodies[p.a].shape.index(), bodies[p.b].shape.index());
    contacts.clear();
    append_contacts(bodies, states, p, contacts);
    ASSERT_FALSE(contacts.empty());
    for (const Contact& c : contacts) {
      EXPECT_EQ(c.body_a, p.a);
      EXPECT_EQ(c.body_b, p.b);
    }
  }
  EXPECT_EQ(contact_pairs(bodies).size(), 6u);
  bodies = {ground(), ground()};
  EXPECT_TRUE(contact_pairs(bodies).empty());
  bodies[0].fixed = false;
  EXPECT_THROW(contact_pairs(bodies), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
