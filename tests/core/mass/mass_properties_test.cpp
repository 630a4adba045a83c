// Mass, centre of mass and inertia of solids, meshes and compounds, each against an integration of its own.
#include "plumbline/core/mass/mass_properties.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "plumbline/core/mass/mesh_mass.hpp"
#include "plumbline/core/mass/principal_axes.hpp"
#include "plumbline/core/mass/solids.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kPi = std::numbers::pi;

double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1p-53; }
Vec3 any_vector(std::mt19937_64& bits) {
  const double x = uniform(bits), y = uniform(bits), z = uniform(bits);
  return 2 * Vec3(x, y, z) - Vec3::Ones();
}

void expect_equal(const MassProperties& a, const MassProperties& b, double tolerance) {
  EXPECT_NEAR(a.mass, b.mass, tolerance * b.mass);
  const double size = std::sqrt(b.inertia_com.norm() / b.mass);
  EXPECT_LT((a.com - b.com).norm(), tolerance * (size + b.com.norm()));
  EXPECT_LT((a.inertia_com - b.inertia_com).norm(), tolerance * b.inertia_com.norm());
}

// A solid of revolution as a stack of discs of radius r(z): exact for r^2 of degree <= 2 in z, since five Gauss points
// integrate degree 9 and r^4, z^2 r^2 have degree 4.
MassProperties stack_of_discs(double from, double to, double density, const std::function<double(double)>& r2) {
  const double nodes[] = {0, 0.53846931010568309, -0.53846931010568309, 0.90617984593866399, -0.90617984593866399};
  const double weights[] = {128.0 / 225, 0.47862867049936647, 0.47862867049936647, 0.23692688505618909,
                            0.23692688505618909};
  double mass = 0, first = 0, second = 0, spread = 0;
  for (int k = 0; k < 5; ++k) {
    const double z = 0.5 * (from + to) + 0.5 * (to - from) * nodes[k];
    const double slice = 0.5 * (to - from) * weights[k] * density * kPi * r2(z);
    mass += slice;
    first += slice * z;
    second += slice * z * z;
    spread += slice * r2(z) / 4;  // int x^2 over a disc
  }
  const double com = first / mass, along = 2 * spread, across = spread + second - mass * com * com;
  return {mass, Vec3(0, 0, com), Vec3(across, across, along).asDiagonal()};
}

TEST(Solids, AreTheIntegralsOverTheirVolume) {
  const double r = 0.3, h = 0.8, density = 7;
  const double tolerance = 64 * kEps;
  expect_equal(solid_of_density(Sphere{r}, density),
               stack_of_discs(-r, r, density, [&](double z) { return r * r - z * z; }), tolerance);
  expect_equal(solid_of_density(Cylinder{r, h}, density),
               stack_of_discs(-h / 2, h / 2, density, [&](double) { return r * r; }), tolerance);
  expect_equal(solid_of_density(Cone{r, h}, density),
               stack_of_discs(0, h, density, [&](double z) { return r * r * (1 - z / h) * (1 - z / h); }), tolerance);
  const auto cap = [&](double z) { return r * r - (z - h / 2) * (z - h / 2); };
  const MassProperties half = stack_of_discs(h / 2, h / 2 + r, density, cap);
  const MassProperties parts[] = {half, solid_of_density(Cylinder{r, h}, density),
                                  placed(half, rotation_by(Vec3(kPi, 0, 0)), Vec3::Zero())};
  expect_equal(solid_of_density(Capsule{r, h}, density), compound(parts), tolerance);
  expect_equal(solid_of_mass(Capsule{r, 0}, 2), solid_of_mass(Sphere{r}, 2), tolerance);
}

TEST(Solids, HaveTheMassThatIsAsked) {
  for (const Solid& solid : {Solid(Sphere{0.4}), Solid(Box{Vec3(1, 2, 3)}), Solid(Cone{1, 2}), Solid(Capsule{1, 2})}) {
    EXPECT_EQ(solid_of_mass(solid, 3).mass, 3);
    expect_equal(solid_of_density(solid, 3 / volume(solid)), solid_of_mass(solid, 3), 8 * kEps);
  }
  EXPECT_THROW(solid_of_mass(Sphere{0}, 1), std::invalid_argument);
  EXPECT_THROW(solid_of_mass(Box{Vec3(1, -1, 1)}, 1), std::invalid_argument);
  EXPECT_THROW(solid_of_mass(Cylinder{1, std::nan("")}, 1), std::invalid_argument);
  EXPECT_THROW(solid_of_mass(Cone{1, 1}, 0), std::invalid_argument);
  EXPECT_THROW(solid_of_density(Capsule{1, 1}, -1), std::invalid_argument);
}

TEST(Compounds, OfEightTurnedPartsAreTheWholeBox) {
  // Each eighth is described in a frame of its own, at any attitude and far away, and put back.
  std::mt19937_64 bits(1);
  const Vec3 size(0.6, 1.0, 1.4);
  const double mass = 4;
  std::vector<MassProperties> parts;
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    const Vec3 phi = 3 * any_vector(bits);
    const Vec3 shift = 2 * any_vector(bits);
    const Quat turn = rotation_by(phi);
    const MassProperties own = placed(solid_of_mass(Box{size / 2}, mass / 8), turn, shift);
    const Vec3 centre = sign.cwiseProduct(size) / 4;
    parts.push_back(placed(own, turn.conjugate(), centre - turn.conjugate() * shift));
  }
  expect_equal(compound(parts), solid_of_mass(Box{size}, mass), 64 * kEps);
}

TEST(Compounds, WithAHoleAreWhatIsLeft) {
  // A cube with an eccentric bore, against the same from the other side: cube = rest + plug.
  const MassProperties cube = solid_of_density(Box{Vec3(1, 1, 1)}, 5);
  const MassProperties plug = placed(solid_of_density(Cylinder{0.2, 1}, 5), Quat::Identity(), Vec3(0.2, 0.1, 0));
  const MassProperties bored[] = {cube, hole(plug)};
  const MassProperties rest = compound(bored);
  EXPECT_NEAR(rest.mass, 5 * (1 - kPi * 0.04), 16 * kEps);
  const MassProperties again[] = {rest, plug};
  expect_equal(compound(again), cube, 64 * kEps);
  const MassProperties nothing[] = {plug, hole(cube)};
  EXPECT_THROW(compound(nothing), std::invalid_argument);
  // More mass taken from the rim than there is: positive mass, yet no body.
  const MassProperties impossible[] = {cube,
                                       hole(placed(solid_of_mass(Sphere{0.1}, 1), Quat::Identity(), Vec3(3, 0, 0)))};
  EXPECT_THROW(compound(impossible), std::invalid_argument);
}

TEST(MassProperties, ObeyParallelAxesAndRotation) {
  const MassProperties rod = solid_of_mass(Box{Vec3(1e-9, 1e-9, 2)}, 3);
  EXPECT_NEAR(inertia_about(rod, Vec3(0, 0, 1))(0, 0), 3.0 * 4 / 3, 16 * kEps);  // m l^2/3 about its end
  std::mt19937_64 bits(2);
  for (int k = 0; k < 100; ++k) {
    const MassProperties box = solid_of_mass(Box{Vec3(1, 2, 3)}, 2);
    const Vec3 phi = 3 * any_vector(bits);
    const Vec3 p = any_vector(bits), q = any_vector(bits);
    const Quat turn = rotation_by(phi);
    const Mat3 r = turn.toRotationMatrix();
    // The moment about a point does not depend on the order of turning and moving.
    const Mat3 direct = inertia_about(placed(box, turn, p), turn * q + p);
    EXPECT_LT((direct - r * inertia_about(box, q) * r.transpose()).norm(), 64 * kEps * direct.norm());
  }
}

TriangleMesh box_mesh(const Vec3& size, const Vec3& centre) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    mesh.corners.push_back(centre + 0.5 * sign.cwiseProduct(size));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Corners on a sphere: n rings of 2 n corners between two poles.
TriangleMesh sphere_mesh(double radius, std::size_t n) {
  TriangleMesh mesh;
  const std::size_t around = 2 * n, south = 0, north = 1;
  mesh.corners = {Vec3(0, 0, -radius), Vec3(0, 0, radius)};
  for (std::size_t i = 1; i < n; ++i) {
    const double polar = kPi * static_cast<double>(i) / static_cast<double>(n);
    for (std::size_t j = 0; j < around; ++j) {
      const double turn = 2 * kPi * static_cast<double>(j) / static_cast<double>(around);
      mesh.corners.push_back(
          radius * Vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), -std::cos(polar)));
    }
  }
  const auto at = [&](std::size_t ring, std::size_t j) { return 2 + (ring - 1) * around + j % around; };
  for (std::size_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({south, at(1, j + 1), at(1, j)});
    mesh.triangles.push_back({north, at(n - 1, j), at(n - 1, j + 1)});
    for (std::size_t i = 1; i + 1 < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

TEST(MeshMass, OfABoxIsTheBoxWhereverItStands) {
  const Vec3 size(0.1, 0.4, 0.9);
  expect_equal(mesh_of_mass(box_mesh(size, Vec3::Zero()), 10), solid_of_mass(Box{size}, 10), 32 * kEps);
  // 1000 m away the corners themselves are rounded by 1e-13 m, a share of 1e-12 of the shortest edge.
  const Vec3 away(1000, -500, 200);
  const MassProperties far_box = placed(solid_of_mass(Box{size}, 10), Quat::Identity(), away);
  expect_equal(mesh_of_mass(box_mesh(size, away), 10), far_box, 4e-12);
}

TEST(MeshMass, ConvergesToTheSphereInSecondOrder) {
  const MassProperties ball = solid_of_density(Sphere{1}, 3);
  double last = 0;
  for (const std::size_t n : {10U, 20U, 40U}) {
    const MassProperties mesh = mesh_of_density(sphere_mesh(1, n), 3);
    const double error = std::abs(mesh.inertia_com(2, 2) - ball.inertia_com(2, 2));
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.05);  // next term of the expansion: h^4
    }
    last = error;
    EXPECT_LT(mesh.com.norm(), 1e-14);
  }
}

TEST(MeshMass, CountsCavitiesAndNonConvexShapes) {
  // A box in a box, its triangles turned round: what is left of the outer one.
  TriangleMesh shell = box_mesh(Vec3(2, 2, 2), Vec3::Zero());
  const TriangleMesh inner = box_mesh(Vec3(1, 1, 1), Vec3(0.2, 0, 0));
  for (const auto& [a, b, c] : inner.triangles) shell.triangles.push_back({a + 8, c + 8, b + 8});
  shell.corners.insert(shell.corners.end(), inner.corners.begin(), inner.corners.end());
  const MassProperties parts[] = {
      solid_of_density(Box{Vec3(2, 2, 2)}, 1),
      hole(placed(solid_of_density(Box{Vec3(1, 1, 1)}, 1), Quat::Identity(), Vec3(0.2, 0, 0)))};
  expect_equal(mesh_of_density(shell, 1), compound(parts), 64 * kEps);
}

TEST(MeshMass, RefusesWhatEnclosesNothing) {
  const TriangleMesh good = box_mesh(Vec3(1, 1, 1), Vec3::Zero());
  EXPECT_NO_THROW(require_closed(good));
  TriangleMesh open = good;
  open.triangles.pop_back();
  EXPECT_THROW(require_closed(open), std::invalid_argument);
  TriangleMesh twisted = good;
  std::swap(twisted.triangles[3][0], twisted.triangles[3][1]);
  EXPECT_THROW(require_closed(twisted), std::invalid_argument);
  TriangleMesh inside_out = good;
  for (auto& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THROW(require_closed(inside_out), std::invalid_argument);
  TriangleMesh lost = good;
  lost.triangles[0][0] = 99;
  EXPECT_THROW(require_closed(lost), std::invalid_argument);
  TriangleMesh nan = good;
  nan.corners[0].x() = std::nan("");
  EXPECT_THROW(require_closed(nan), std::invalid_argument);
  EXPECT_THROW(require_closed({}), std::invalid_argument);
  EXPECT_THROW(mesh_of_mass(good, 0), std::invalid_argument);
}

TEST(PrincipalAxes, DiagonaliseAnyTensor) {
  std::mt19937_64 bits(3);
  for (int k = 0; k < 500; ++k) {
    const Vec3 spread = any_vector(bits).cwiseAbs();
    const Vec3 moments = Vec3::Constant(spread.sum()) - spread;
    const Mat3 r = rotation_by(3 * any_vector(bits)).toRotationMatrix();
    const Mat3 inertia = r * moments.asDiagonal() * r.transpose();
    const PrincipalAxes axes = principal_axes(0.5 * (inertia + inertia.transpose()));
    const Mat3 r_FB = axes.q_FB.toRotationMatrix();
    EXPECT_NEAR(r_FB.determinant(), 1, 16 * kEps);
    EXPECT_LT((r_FB * axes.moments.asDiagonal() * r_FB.transpose() - inertia).norm(), 32 * kEps * inertia.norm());
  }
}

TEST(PrincipalAxes, LeaveADiagonalTensorAlone) {
  const PrincipalAxes axes = principal_axes(Vec3(3, 1, 2.5).asDiagonal());
  EXPECT_EQ(axes.moments, Vec3(3, 1, 2.5));
  EXPECT_EQ(axes.q_FB.w(), 1);
  EXPECT_THROW(principal_axes(Vec3(1, 1, 3).asDiagonal()), std::invalid_argument);
  EXPECT_THROW(principal_axes(Vec3(1, 1, std::nan("")).asDiagonal()), std::invalid_argument);
  Mat3 lopsided = Mat3::Identity();
  lopsided(0, 1) = 0.1;
  EXPECT_THROW(principal_axes(lopsided), std::invalid_argument);
}

TEST(PrincipalAxes, MakeABodyThatHasTheTensor) {
  const MassProperties parts[] = {
      solid_of_density(Box{Vec3(1, 0.2, 0.2)}, 2),
      placed(solid_of_density(Box{Vec3(0.2, 0.2, 0.8)}, 2), rotation_by(Vec3(0, 0.3, 0)), Vec3(0.5, 0, 0.4))};
  const MassProperties angle = compound(parts);
  const Quat q_WF = rotation_by(Vec3(0.4, -1, 0.2));
  Body body;
  give_mass(body, angle, q_WF, Vec3(1, 2, 3));
  const MassProperties in_world = placed(angle, q_WF, Vec3(1, 2, 3));
  EXPECT_EQ(body.mass, angle.mass);
  EXPECT_LT((body.initial.p_WB - in_world.com).norm(), 16 * kEps);
  EXPECT_LT((inertia_in_world(body, body.initial.q_WB) - in_world.inertia_com).norm(),
            64 * kEps * in_world.inertia_com.norm());
}

}  // namespace
}  // namespace plumbline
