#include "plumbline/core/collision/nearest_points.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline {

Vec3 nearest_on_segment(const Vec3& point, const Segment& segment) {
  const Vec3 along = segment.head - segment.tail;
  const double reach = along.dot(point - segment.tail), length2 = along.squaredNorm();
  if (!(reach > 0)) return segment.tail;
  if (reach >= length2) return segment.head;
  return segment.tail + (reach / length2) * along;
}

NearestPoints nearest_points(const Segment& a, const Segment& b) {
  NearestPoints best{a.tail, nearest_on_segment(a.tail, b)};
  const auto offer = [&](const Vec3& on_a, const Vec3& on_b) {
    if ((on_a - on_b).squaredNorm() < (best.a - best.b).squaredNorm()) best = {on_a, on_b};
  };
  offer(a.head, nearest_on_segment(a.head, b));
  offer(nearest_on_segment(b.tail, a), b.tail);
  offer(nearest_on_segment(b.head, a), b.head);

  // The common perpendicular of the lines a.tail + s u and b.tail + t v.
  const Vec3 u = a.head - a.tail, v = b.head - b.tail, d = b.tail - a.tail, n = u.cross(v);
  const double n2 = n.squaredNorm();
  if (n2 > 0) {
    const double s = d.cross(v).dot(n) / n2, t = d.cross(u).dot(n) / n2;
    if (s > 0 && s < 1 && t > 0 && t < 1) offer(a.tail + s * u, b.tail + t * v);
    return best;
  }
  // Parallel: where a's ends project on b, cut to b, is the part in which they run side by side.
  const double v2 = v.squaredNorm();
  if (!(v2 > 0)) return best;
  const double at_tail = -v.dot(d) / v2, at_head = at_tail + v.dot(u) / v2;
  const double from = std::max(0.0, std::min(at_tail, at_head)), to = std::min(1.0, std::max(at_tail, at_head));
  if (from < to) {
    best.b = b.tail + 0.5 * (from + to) * v;
    best.a = nearest_on_segment(best.b, a);
  }
  return best;
}

Vec3 nearest_on_triangle(const Vec3& point, const TriangleCorners& triangle) {
  const Vec3 n = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  bool inside = n.squaredNorm() > 0;
  Vec3 best = triangle[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Segment edge{triangle[k], triangle[(k + 1) % 3]};
    inside = inside && n.dot((edge.head - edge.tail).cross(point - edge.tail)) >= 0;
    const Vec3 candidate = nearest_on_segment(point, edge);
    if ((candidate - point).squaredNorm() < (best - point).squaredNorm()) best = candidate;
  }
  return inside ? Vec3(point - n * (n.dot(point - triangle[0]) / n.squaredNorm())) : best;
}

}  // namespace plumbline
