// Contact manifolds against distances that know nothing of axes or clipping, and where the answer is plain to see.
#include "plumbline/core/collision/contact_manifold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "kinetic_scenes.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {
namespace {

using namespace scenes;

constexpr double kEps = std::numeric_limits<double>::epsilon();
const double kPi = std::acos(-1.0);

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Quat attitude() {
    for (;;) {
      const Eigen::Vector4d x(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1));
      if (x.norm() > 0.1 && x.norm() <= 1) return Quat(x(0), x(1), x(2), x(3)).normalized();
    }
  }

 private:
  std::mt19937_64 bits_;
};

struct PlacedBox {
  Vec3 size;
  BodyState state;
};

double distance_to_box(const Vec3& x_W, const PlacedBox& b) {
  const Vec3 x = (b.state.q_WB.conjugate() * (x_W - b.state.p_WB)).cwiseAbs() - 0.5 * b.size;
  return x.cwiseMax(0.0).norm();
}

// Nearest points of two segments p + s u, q + t v with s, t in [0, 1], by minimising along one, then the other: each
// quadratic is solved with the other's end points too, so that no case is told apart.
double segment_distance(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const auto to_segment = [](const Vec3& x, const Vec3& at, const Vec3& d) {
    return (x - at - std::clamp(d.dot(x - at) / d.squaredNorm(), 0.0, 1.0) * d).norm();
  };
  double best = std::min({to_segment(p, q, v), to_segment(p + u, q, v), to_segment(q, p, u), to_segment(q + v, p, u)});
  const Vec3 n = u.cross(v);
  if (n.squaredNorm() > 0) {  // both interior: the lines' common perpendicular
    const double s = (q - p).cross(v).dot(n) / n.squaredNorm(), t = (q - p).cross(u).dot(n) / n.squaredNorm();
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, (p + s * u - q - t * v).norm());
  }
  return best;
}

// Distance of two boxes that do not overlap, feature by feature: corners to boxes and edges to edges.
double distance(const PlacedBox& a, const PlacedBox& b) {
  const auto corner = [](const PlacedBox& x, int k) -> Vec3 {
    return x.state.p_WB + x.state.q_WB * box_corner(x.size, k);
  };
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 8; ++k) {
    best = std::min({best, distance_to_box(corner(a, k), b), distance_to_box(corner(b, k), a)});
    for (int axis = 0; axis < 3; ++axis) {
      if ((k >> axis & 1) != 0) continue;
      const Vec3 p = corner(a, k), u = corner(a, k | 1 << axis) - p;
      for (int j = 0; j < 8; ++j) {
        for (int other = 0; other < 3; ++other) {
          if ((j >> other & 1) != 0) continue;
          const Vec3 q = corner(b, j);
          best = std::min(best, segment_distance(p, u, q, corner(b, j | 1 << other) - q));
        }
      }
    }
  }
  return best;
}

// The textbook's separation of two oriented boxes (Gottschalk et al. 1996): |T . L| less the two radii along L.
double separation(const PlacedBox& a, const PlacedBox& b) {
  const Mat3 ra = a.state.q_WB.toRotationMatrix(), rb = b.state.q_WB.toRotationMatrix();
  const Vec3 t = b.state.p_WB - a.state.p_WB;
  double best = -std::numeric_limits<double>::infinity();
  const auto along = [&](const Vec3& axis) {
    const Vec3 l = axis.normalized();
    const double reach =
        0.5 * (a.size.dot((ra.transpose() * l).cwiseAbs()) + b.size.dot((rb.transpose() * l).cwiseAbs()));
    best = std::max(best, std::abs(t.dot(l)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    along(ra.col(i));
    along(rb.col(i));
    for (int j = 0; j < 3; ++j) along(ra.col(i).cross(rb.col(j)));
  }
  return best;
}

std::vector<Contact> contacts_of(const PlacedBox& a, const PlacedBox& b) {
  return box_box_contacts(a.state, a.size, b.state, b.size);
}

double nearest_gap(const std::vector<Contact>& contacts) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Contact& c : contacts) gap = std::min(gap, c.gap);
  return gap;
}

// Two boxes of random size and attitude, brought to that distance along the line of their centres by bisection.
std::pair<PlacedBox, PlacedBox> near_touch(Random& random, double gap) {
  PlacedBox a{Vec3(random.in(0.2, 2), random.in(0.2, 2), random.in(0.2, 2)), {random.vector(1), random.attitude()}};
  PlacedBox b{Vec3(random.in(0.2, 2), random.in(0.2, 2), random.in(0.2, 2)), {Vec3::Zero(), random.attitude()}};
  const Vec3 line = random.attitude() * Vec3::UnitX();
  double near = 0, far = 4;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (near + far);
    b.state.p_WB = a.state.p_WB + middle * line;
    const double axes = separation(a, b);  // never more than the distance
    const bool apart = axes > gap || (axes > 0 && distance(a, b) > gap);
    (apart ? far : near) = middle;
  }
  b.state.p_WB = a.state.p_WB + far * line;
  return {a, b};
}

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

PlacedBox flat(const Vec3& size, const Vec3& p_WB, double turn = 0) {
  return {size, {p_WB, rotation_by(Vec3(0, 0, turn))}};
}

void expect_points(const std::vector<Contact>& contacts, std::vector<Vec3> expected, const Vec3& normal, double gap,
                   double left = 1e-15) {
  EXPECT_EQ(contacts.size(), expected.size());
  for (const Contact& c : contacts) {
    EXPECT_LT((c.normal_W - normal).norm(), left);
    EXPECT_NEAR(c.gap, gap, left);
    const auto at = std::find_if(expected.begin(), expected.end(),
                                 [&](const Vec3& x) { return (c.point_W - x).norm() < 8 * left; });
    ASSERT_NE(at, expected.end()) << c.point_W.transpose();
    expected.erase(at);
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
