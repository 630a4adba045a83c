#include "separating_motion.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline {
namespace {

using Rides = TurningDirection::Rides;

// A normal that turns with its body runs round the axis on a cone, at constant speed.
TurningDirection riding(Rides rides, const Vec3& normal, const Vec3& w) {
  const Vec3 rate = w.cross(normal);
  return {rides, normal, rate, rate.norm(), rate.norm() * w.norm()};
}

// u x v, scaled to length 1 now: (u x v)' = u' x v + u x v', (u x v)'' = u'' x v + 2 u' x v' + u x v''.
TurningDirection crossing(const Vec3& u, const Vec3& w_u, const Vec3& v, const Vec3& w_v, const Vec3& normal) {
  const Vec3 u_rate = w_u.cross(u), v_rate = w_v.cross(v);
  const double scale = 1 / u.cross(v).dot(normal), size = std::abs(scale);
  const double by_u = u_rate.norm() * v.norm(), by_v = v_rate.norm() * u.norm();
  const double bend = w_u.norm() * by_u + 2 * u_rate.norm() * v_rate.norm() + w_v.norm() * by_v;
  return {Rides::kOnBoth, normal, scale * (u_rate.cross(v) + u.cross(v_rate)), size * (by_u + by_v), size * bend};
}

// Bound of |m . (w x (w x r))| = |(w x m) . (w x r)| for |r| <= radius: nothing for a body that spins about m.
double centripetal(const Vec3& w, double radius, const TurningDirection& direction, double until) {
  const double turn = w.norm();
  return turn * radius * std::min(turn, w.cross(direction.m).norm() + turn * direction.speed * until);
}

}  // namespace

MovingPair::MovingPair(const ConvexPolyhedron& shape_a, const Motion& motion_a, const ConvexPolyhedron& shape_b,
                       const Motion& motion_b)
    : a(shape_a),
      b(shape_b),
      w_A(motion_a.start.w_WB),
      w_B(motion_b.start.w_WB),
      acceleration(motion_b.a_W - motion_a.a_W),
      attitude_a_(motion_a.start.q_WB),
      attitude_b_(motion_b.start.q_WB),
      position_(motion_b.start.p_WB - motion_a.start.p_WB),
      velocity_(motion_b.start.v_WB - motion_a.start.v_WB) {
  move_to(0);
}

void MovingPair::move_to(double t) {
  velocity = velocity_ + t * acceleration;
  a.place(Vec3::Zero(), rotation_by(t * w_A) * attitude_a_);
  b.place(position_ + t * velocity_ + 0.5 * t * t * acceleration, rotation_by(t * w_B) * attitude_b_);
}

TurningDirection direction_of(const SeparatingAxis& axis, const MovingPair& pair) {
  if (axis.kind == SeparatingAxis::Kind::kFaceOfA) return riding(Rides::kOnA, axis.normal_W, pair.w_A);
  if (axis.kind == SeparatingAxis::Kind::kFaceOfB) return riding(Rides::kOnB, axis.normal_W, pair.w_B);
  const Vec3 u = pair.a.edge_vector(pair.a.shape->edges()[axis.index_a]);
  const Vec3 v = pair.b.edge_vector(pair.b.shape->edges()[axis.index_b]);
  return crossing(u, pair.w_A, v, pair.w_B, axis.normal_W);
}

TurningDirection riding_on_a(const Vec3& normal, const MovingPair& pair) {
  return riding(Rides::kOnA, normal, pair.w_A);
}

// Heights are measured from the centre of the body that the direction rides on: its own corners then never move.
GapBound::GapBound(const MovingPair& pair, const TurningDirection& direction, double until) : until_(until) {
  const Vec3& m = direction.m;
  const bool moves_a = direction.rides != Rides::kOnA, moves_b = direction.rides != Rides::kOnB;
  const Vec3 origin = moves_b ? Vec3(Vec3::Zero()) : pair.b.centre;
  const Vec3 origin_velocity = moves_b ? Vec3(Vec3::Zero()) : pair.velocity;
  for (const Vec3& p : pair.a.vertices) {
    const double slope = direction.m_rate.dot(p - origin) + m.dot(pair.w_A.cross(p) - origin_velocity);
    above_.push_back({m.dot(p - origin), moves_a ? slope : 0});
  }
  for (const Vec3& p : pair.b.vertices) {
    const Vec3 velocity = pair.velocity + pair.w_B.cross(p - pair.b.centre) - origin_velocity;
    below_.push_back({-m.dot(p - origin), moves_b ? -direction.m_rate.dot(p - origin) - m.dot(velocity) : 0});
  }
  // (m . x)'' = m'' . x + 2 m' . x' + m . x'' with the largest x, x' and x'' that the time to come allows.
  const double radius_a = moves_a ? pair.a.shape->radius() : 0, radius_b = moves_b ? pair.b.shape->radius() : 0;
  const double pull = pair.acceleration.norm(), fastest = pair.velocity.norm() + pull * until;
  const double reach = pair.b.centre.norm() + fastest * until + radius_a + radius_b;
  const double speed = fastest + pair.w_A.norm() * radius_a + pair.w_B.norm() * radius_b;
  bend_ = direction.bend * reach + 2 * direction.speed * speed + pull +
          centripetal(pair.w_A, radius_a, direction, until) + centripetal(pair.w_B, radius_b, direction, until);
}

// The bound is concave, so that its tangent lies above it: Newton from the far end stays beyond the root and runs down
// to it, faster and faster.
double GapBound::time_above(double floor) const {
  constexpr int kMaxIterations = 100;
  double s = until_;
  for (int k = 0; k < kMaxIterations; ++k) {
    const Line a = lowest(above_, s), b = lowest(below_, s);
    const double excess = a.value + b.value - 0.5 * bend_ * s * s - floor;
    if (excess >= 0) return s;
    const double next = s - excess / (a.slope + b.slope - bend_ * s);
    if (!(next < s)) return s;  // as close as roundings allow
    if (next <= 0) return 0;
    s = next;
  }
  return s;
}

double GapBound::rate(double tolerance) const {
  return slope_of_lowest(above_, tolerance) + slope_of_lowest(below_, tolerance);
}

GapBound::Line GapBound::lowest(const std::vector<Line>& lines, double s) {
  Line best{lines.front().value + s * lines.front().slope, lines.front().slope};
  for (const Line& line : lines) {
    const double value = line.value + s * line.slope;
    if (!(value >= best.value)) best = {value, line.slope};
  }
  return best;
}

double GapBound::slope_of_lowest(const std::vector<Line>& lines, double tolerance) {
  Line best = lowest(lines, 0);
  const double limit = best.value + tolerance;
  for (const Line& line : lines) {
    if (line.value <= limit) best.slope = std::min(best.slope, line.slope);
  }
  return best.slope;
}

}  // namespace plumbline
