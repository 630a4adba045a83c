#include "plumbline/core/collision/convex_distance.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "posed_polyhedron.hpp"

namespace plumbline {
namespace {

// The foot of the perpendicular on a face, if the point is in front of the face and the foot within its rim.
std::optional<Vec3> foot_on_face(const Vec3& point, const PosedPolyhedron& solid, std::size_t f) {
  const Vec3& n = solid.normals[f];
  const double height = n.dot(point) - solid.offsets[f];
  const std::vector<std::size_t>& loop = solid.shape->faces()[f].corners;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 &tail = solid.vertices[loop[k]], &head = solid.vertices[loop[(k + 1) % loop.size()]];
    if (!(n.dot((head - tail).cross(point - tail)) >= 0)) return std::nullopt;
  }
  return point - height * n;
}

// Calls visit(pair) for every corner over a face and every two edges. Corners beyond the rim are nearer to an edge.
template <typename Visit>
void visit_features(const PosedPolyhedron& a, const PosedPolyhedron& b, const Visit& visit) {
  for (const Vec3& corner : a.vertices) {
    for (std::size_t f = 0; f < b.normals.size(); ++f) {
      if (const auto foot = foot_on_face(corner, b, f)) visit(NearestPoints{corner, *foot});
    }
  }
  for (const Vec3& corner : b.vertices) {
    for (std::size_t f = 0; f < a.normals.size(); ++f) {
      if (const auto foot = foot_on_face(corner, a, f)) visit(NearestPoints{*foot, corner});
    }
  }
  for (const auto& edge_a : a.shape->edges()) {
    const Segment segment_a{a.vertices[edge_a.tail], a.vertices[edge_a.head]};
    for (const auto& edge_b : b.shape->edges()) {
      visit(nearest_points(segment_a, Segment{b.vertices[edge_b.tail], b.vertices[edge_b.head]}));
    }
  }
}

}  // namespace

SeparatingAxis separating_axis(const PosedPolyhedron& a, const PosedPolyhedron& b) {
  SeparatingAxis best;
  best.gap = -std::numeric_limits<double>::infinity();
  visit_axes(a, b, best.gap, [&](const SeparatingAxis& axis) {
    if (!std::isnan(best.gap)) best = axis;
    return best.gap;
  });
  return best;
}

NearestPoints nearest_features(const PosedPolyhedron& a, const PosedPolyhedron& b) {
  constexpr double kTie = 64 * std::numeric_limits<double>::epsilon();
  NearestPoints nearest{Vec3::Zero(), Vec3::Zero()};
  double least2 = std::numeric_limits<double>::infinity();
  visit_features(a, b, [&](const NearestPoints& pair) {
    const double distance2 = (pair.a - pair.b).squaredNorm();
    if (distance2 < least2) least2 = distance2, nearest = pair;
  });
  const double limit = kTie * (a.shape->radius() + b.shape->radius());
  NearestPoints sum{Vec3::Zero(), Vec3::Zero()};
  int count = 0;
  visit_features(a, b, [&](const NearestPoints& pair) {
    if (!(((pair.a - pair.b) - (nearest.a - nearest.b)).norm() <= limit)) return;
    sum.a += pair.a;
    sum.b += pair.b;
    ++count;
  });
  return {sum.a / count, sum.b / count};
}

SeparatingAxis separating_axis(const ConvexPolyhedron& a, const BodyState& state_a, const ConvexPolyhedron& b,
                               const BodyState& state_b) {
  PosedPolyhedron posed_a(a), posed_b(b);
  posed_a.place(Vec3::Zero(), state_a.q_WB);
  posed_b.place(state_b.p_WB - state_a.p_WB, state_b.q_WB);
  return separating_axis(posed_a, posed_b);
}

Separation convex_distance(const ConvexPolyhedron& a, const BodyState& state_a, const ConvexPolyhedron& b,
                           const BodyState& state_b) {
  const Vec3& origin = state_a.p_WB;
  PosedPolyhedron posed_a(a), posed_b(b);
  posed_a.place(Vec3::Zero(), state_a.q_WB);
  posed_b.place(state_b.p_WB - origin, state_b.q_WB);
  const SeparatingAxis axis = separating_axis(posed_a, posed_b);
  if (std::isnan(axis.gap)) {
    const Vec3 unknown = Vec3::Constant(axis.gap);
    return {axis.gap, unknown, unknown, unknown};
  }
  // Overlapping bodies are first pushed apart until they touch; what then touches is what is deepest.
  const Vec3 push = axis.gap < 0 ? Vec3(-axis.gap * axis.normal_W) : Vec3(Vec3::Zero());
  if (axis.gap < 0) posed_a.place(push, state_a.q_WB);
  const NearestPoints nearest = nearest_features(posed_a, posed_b);
  const Vec3 apart = nearest.a - nearest.b;
  const double distance = apart.norm();
  // The gap of a face or of crossing edges is the distance itself, with a better direction than the difference of two
  // points that nearly coincide; only corners (and edges seen from corners) are farther apart than any plane can see.
  const double rounding =
      8 * std::numeric_limits<double>::epsilon() * (a.radius() + b.radius() + posed_b.centre.norm());
  const bool plane_sees_all = axis.gap <= 0 || distance <= axis.gap + rounding;
  if (plane_sees_all) {
    return {axis.gap, axis.normal_W, origin + nearest.a - push, origin + nearest.b};
  }
  return {distance, apart / distance, origin + nearest.a, origin + nearest.b};
}

}  // namespace plumbline
