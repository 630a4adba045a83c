#include "plumbline/core/mass/mesh_mass.hpp"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace plumbline {
namespace {

struct VolumeIntegrals {
  double volume = 0;           // int dV
  Vec3 first = Vec3::Zero();   // int x dV
  Mat3 second = Mat3::Zero();  // int x x^T dV
};

Vec3 middle(const TriangleMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : mesh.corners) sum += corner;
  return sum / static_cast<double>(mesh.corners.size());
}

VolumeIntegrals integrate(const TriangleMesh& mesh, const Vec3& o) {
  VolumeIntegrals sum;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.corners[i] - o, b = mesh.corners[j] - o, c = mesh.corners[k] - o;
    const double v = a.dot(b.cross(c)) / 6;
    const Vec3 s = a + b + c;
    sum.volume += v;
    sum.first += v / 4 * s;
    sum.second += v / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  return sum;
}

std::string edge_text(std::size_t a, std::size_t b) { return std::to_string(a) + "-" + std::to_string(b); }

MassProperties of_density(const VolumeIntegrals& sum, const Vec3& o, double density) {
  const Vec3 com = sum.first / sum.volume;
  const Mat3 covariance = density * (sum.second - sum.volume * com * com.transpose());
  return {density * sum.volume, o + com, covariance.trace() * Mat3::Identity() - covariance};
}

}  // namespace

void require_closed(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("a mesh without triangles encloses no volume");
  for (const Vec3& corner : mesh.corners) {
    if (!corner.allFinite()) throw std::invalid_argument("a corner of the mesh is not finite");
  }
  // +1 for each pass in the direction low -> high, kept apart from the passes back.
  std::map<std::pair<std::size_t, std::size_t>, std::pair<int, int>> passes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = triangle[k], to = triangle[(k + 1) % 3];
      if (from >= mesh.corners.size() || from == to) {
        throw std::invalid_argument("triangle " + std::to_string(t) + " of the mesh needs three corners that exist");
      }
      auto& [forth, back] = passes[std::minmax(from, to)];
      ++(from < to ? forth : back);
    }
  }
  for (const auto& [edge, count] : passes) {
    const auto& [forth, back] = count;
    if (forth == 1 && back == 1) continue;
    const std::string text = edge_text(edge.first, edge.second);
    if (forth + back == 1) {
      throw std::invalid_argument("the mesh is open at edge " + text + ": close it with a triangle");
    }
    if (forth + back == 2) {
      throw std::invalid_argument("the triangles at edge " + text + " turn opposite ways: turn one of them round");
    }
    throw std::invalid_argument("edge " + text + " of the mesh belongs to " + std::to_string(forth + back) +
                                " triangles; two are needed");
  }
  if (!(integrate(mesh, middle(mesh)).volume > 0)) {
    throw std::invalid_argument(
        "the mesh encloses no positive volume: its triangles must be counter-clockwise from outside");
  }
}

double mesh_volume(const TriangleMesh& mesh) {
  require_closed(mesh);
  return integrate(mesh, middle(mesh)).volume;
}

MassProperties mesh_of_density(const TriangleMesh& mesh, double density) {
  if (!(density > 0 && std::isfinite(density)))
    throw std::invalid_argument("the density of a mesh must be finite and > 0");
  require_closed(mesh);
  const Vec3 o = middle(mesh);
  MassProperties result = of_density(integrate(mesh, o), o, density);
  require_physical(result);
  return result;
}

MassProperties mesh_of_mass(const TriangleMesh& mesh, double mass) {
  return mesh_of_density(mesh, mass / mesh_volume(mesh));
}

}  // namespace plumbline
