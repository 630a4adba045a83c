// Mass properties of a homogeneous body bounded by triangles (course slide 7, step 1).
//
// Every triangle spans a tetrahedron with a point o, of signed volume a . (b x c)/6 for corners a, b, c seen from o;
// the tetrahedra outside the body cancel. Over one of volume V the polynomials integrate exactly:
//
//   int x dV = V (a + b + c)/4        int x x^T dV = V/20 (s s^T + a a^T + b b^T + c c^T),   s = a + b + c
//
// and I = trace(C) 1 - C for the covariance C about the centre of mass. Source: Lien and Kajiya, A symbolic method for
// calculating the integral properties of arbitrary nonconvex polyhedra, IEEE CG&A 4(10), 1984. o is the mean of the
// corners, so that a mesh far from its origin keeps its digits. Any closed mesh will do, convex or not; several closed
// shells too, inner ones with their triangles turned round being cavities.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plumbline/core/mass/mass_properties.hpp"

namespace plumbline {

struct TriangleMesh {
  std::vector<Vec3> corners;                          // [m]
  std::vector<std::array<std::size_t, 3>> triangles;  // indices, counter-clockwise seen from outside
};

// Throws std::invalid_argument, naming the triangle or edge, unless every index exists, every edge is shared by exactly
// two triangles that pass it in opposite directions (closed, consistently oriented), and the volume is positive (the
// orientation is outward).
void require_closed(const TriangleMesh& mesh);

double mesh_volume(const TriangleMesh& mesh);  // [m^3]
MassProperties mesh_of_mass(const TriangleMesh& mesh, double mass);
MassProperties mesh_of_density(const TriangleMesh& mesh, double density);

}  // namespace plumbline
