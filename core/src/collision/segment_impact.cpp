#include "plumbline/core/collision/segment_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "plumbline/core/collision/polynomial_roots.hpp"

namespace plumbline {
namespace {

constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
constexpr double kLargestSlant = 1e6;  // 1/sin of the flattest angle whose loss of digits is made allowance for

MovingPoint operator-(const MovingPoint& a, const MovingPoint& b) { return {a.p_W - b.p_W, a.v_W - b.v_W}; }

// The product of two vectors that are linear in t: c[0] + c[1] t + c[2] t^2.
std::array<Vec3, 3> cross(const MovingPoint& u, const MovingPoint& v) {
  return {u.p_W.cross(v.p_W), u.v_W.cross(v.p_W) + u.p_W.cross(v.v_W), u.v_W.cross(v.v_W)};
}

double size_within(const MovingPoint& u, double horizon) { return u.p_W.norm() + horizon * u.v_W.norm(); }

// The times at which u, v and d lie in one plane. `always` tells that they do so all the time, as far as one can see.
struct Coplanar {
  std::vector<double> times;
  bool always;
};

Coplanar coplanar_times(const MovingPoint& u, const MovingPoint& v, const MovingPoint& d, double horizon) {
  const auto n = cross(u, v);
  const std::array<double, 4> c{n[0].dot(d.p_W), n[1].dot(d.p_W) + n[0].dot(d.v_W), n[2].dot(d.p_W) + n[1].dot(d.v_W),
                                n[2].dot(d.v_W)};
  const double flat = kRounding * size_within(u, horizon) * size_within(v, horizon) * size_within(d, horizon);
  bool always = true;
  for (std::size_t k = 0; k < c.size(); ++k) {
    always = always && std::abs(c[k]) * std::pow(horizon, static_cast<double>(k)) <= flat;
  }
  Coplanar result{polynomial_roots(c, 0, horizon), always};
  // The coefficients have lost digits where things start far away: Newton on the volume itself gets them back.
  for (double& t : result.times) {
    for (int k = 0; k < 2; ++k) {
      const Vec3 ut = u.at(t), vt = v.at(t), dt = d.at(t);
      const double slope = (u.v_W.cross(vt) + ut.cross(v.v_W)).dot(dt) + ut.cross(vt).dot(d.v_W);
      const double next = t - ut.cross(vt).dot(dt) / slope;
      // Only where it is a matter of digits; near a double root the slope means nothing.
      if (std::abs(next - t) <= 1e-6 * horizon && next >= 0 && next <= horizon) t = next;
    }
  }
  return result;
}

// The times at which a point may pass through the line of a segment: a component of v x (p - b1) is zero.
void add_line_times(const MovingPoint& point, const MovingSegment& segment, double horizon,
                    std::vector<double>& times) {
  const auto n = cross(segment.head - segment.tail, point - segment.tail);
  for (int k = 0; k < 3; ++k) {
    const std::array<double, 3> c{n[0](k), n[1](k), n[2](k)};
    const auto roots = polynomial_roots(c, 0, horizon);
    times.insert(times.end(), roots.begin(), roots.end());
  }
}

// The time at which two points are nearest.
void add_nearest_time(const MovingPoint& a, const MovingPoint& b, double horizon, std::vector<double>& times) {
  const MovingPoint d = a - b;
  const double t = -d.p_W.dot(d.v_W) / d.v_W.squaredNorm();
  if (t >= 0 && t <= horizon) times.push_back(t);
}

// How far apart things may be to count as touching: see the header.
double slack(const Vec3& u, const Vec3& v, double reach) {
  const double sine = u.cross(v).norm() / (u.norm() * v.norm());
  return kRounding * reach * (sine > 1 / kLargestSlant ? 1 / sine : 1);
}

// u x v if the approach is along it, else the part of the approach across `edge`, else the approach itself. Of nearly
// parallel u and v the product is rounding only.
Vec3 facing(const Vec3& u, const Vec3& v, const Vec3& approach, const Vec3& edge) {
  constexpr double kAlong = 1e-9;
  const Vec3 normal = u.cross(v);
  const double along = normal.dot(approach);
  if (std::abs(along) > kAlong * u.norm() * v.norm() * approach.norm()) {
    return normal.normalized() * (along > 0 ? -1 : 1);
  }
  const double length2 = edge.squaredNorm();
  const Vec3 across = length2 > 0 ? Vec3(approach - edge * (edge.dot(approach) / length2)) : approach;
  if (across.norm() > kAlong * approach.norm()) return -across.normalized();
  if (approach.norm() > 0) return -approach.normalized();
  return normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
}

Vec3 velocity_on(const MovingSegment& segment, const Vec3& point, double t) {
  const Segment now = segment.at(t);
  const Vec3 along = now.head - now.tail;
  const double share = along.squaredNorm() > 0 ? along.dot(point - now.tail) / along.squaredNorm() : 0;
  return (1 - share) * segment.tail.v_W + share * segment.head.v_W;
}

}  // namespace

std::optional<Touch> segment_meets_segment(const MovingSegment& a, const MovingSegment& b, double horizon) {
  Coplanar plane = coplanar_times(a.head - a.tail, b.head - b.tail, b.tail - a.tail, horizon);
  std::vector<double>& times = plane.times;
  times.push_back(0);
  if (plane.always) {
    for (const MovingPoint& end : {a.tail, a.head}) add_line_times(end, b, horizon, times);
    for (const MovingPoint& end : {b.tail, b.head}) add_line_times(end, a, horizon, times);
    for (const MovingPoint& end_a : {a.tail, a.head}) {
      for (const MovingPoint& end_b : {b.tail, b.head}) add_nearest_time(end_a, end_b, horizon, times);
    }
  }
  std::sort(times.begin(), times.end());
  for (const double t : times) {
    const Segment now_a = a.at(t), now_b = b.at(t);
    const NearestPoints nearest = nearest_points(now_a, now_b);
    const Vec3 u = now_a.head - now_a.tail, v = now_b.head - now_b.tail;
    double reach = 0;
    for (const MovingPoint& end : {a.tail, a.head, b.tail, b.head}) reach = std::max(reach, size_within(end, t));
    if (!(nearest.distance() <= slack(u, v, reach))) continue;
    const Vec3 point = 0.5 * (nearest.a + nearest.b);
    const Vec3 approach = velocity_on(a, point, t) - velocity_on(b, point, t);
    // Of two in one plane, the one that is hit is the one whose ends are farther from the point.
    const double end_of_a = std::min((point - now_a.tail).norm(), (point - now_a.head).norm());
    const double end_of_b = std::min((point - now_b.tail).norm(), (point - now_b.head).norm());
    return Touch{t, point, facing(u, v, approach, end_of_a > end_of_b ? u : v)};
  }
  return std::nullopt;
}

std::optional<Touch> point_meets_triangle(const MovingPoint& point, const MovingTriangle& triangle, double horizon) {
  const MovingPoint u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
  Coplanar plane = coplanar_times(u, v, point - triangle[0], horizon);
  std::vector<double>& times = plane.times;
  times.push_back(0);
  if (plane.always) {
    for (std::size_t k = 0; k < 3; ++k) {
      add_line_times(point, {triangle[k], triangle[(k + 1) % 3]}, horizon, times);
      add_nearest_time(point, triangle[k], horizon, times);
    }
  }
  std::sort(times.begin(), times.end());
  for (const double t : times) {
    const TriangleCorners now{triangle[0].at(t), triangle[1].at(t), triangle[2].at(t)};
    const Vec3 p = point.at(t), on = nearest_on_triangle(p, now);
    double reach = size_within(point, t);
    for (const MovingPoint& corner : triangle) reach = std::max(reach, size_within(corner, t));
    if (!((p - on).norm() <= slack(now[1] - now[0], now[2] - now[0], reach))) continue;
    // The velocity of the triangle there, from its plane coordinates: on = corner + s u + r v.
    const Vec3 ut = u.at(t), vt = v.at(t), n = ut.cross(vt), rel = on - now[0];
    const double n2 = n.squaredNorm();
    const double s = n2 > 0 ? rel.cross(vt).dot(n) / n2 : 0, r = n2 > 0 ? ut.cross(rel).dot(n) / n2 : 0;
    const Vec3 approach = point.v_W - (triangle[0].v_W + s * u.v_W + r * v.v_W);
    // In the plane of the triangle it is an edge that is hit: the nearest one.
    Vec3 edge = Vec3::Zero();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Segment side{now[k], now[(k + 1) % 3]};
      const double distance = (nearest_on_segment(p, side) - p).norm();
      if (distance < nearest) nearest = distance, edge = side.head - side.tail;
    }
    return Touch{t, on, facing(ut, vt, approach, edge)};
  }
  return std::nullopt;
}

}  // namespace plumbline
