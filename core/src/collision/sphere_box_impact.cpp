#include "plumbline/core/collision/sphere_box_impact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "conservative_advancement.hpp"

namespace plumbline {
namespace {

// Of a point from a box, in the axes of the box: negative inside.
struct BoxDistance {
  double value;   // [m]
  Vec3 gradient;  // unit
};

BoxDistance box_distance(const Vec3& x, const Vec3& half) {
  const Vec3 beyond = x.cwiseAbs() - half;
  if (beyond.maxCoeff() > 0) {
    const Vec3 nearest = x.cwiseMax(-half).cwiseMin(half);
    const double value = (x - nearest).norm();
    return {value, (x - nearest) / value};
  }
  Eigen::Index axis = 0;
  const double value = beyond.maxCoeff(&axis);
  Vec3 gradient = Vec3::Zero();
  gradient(axis) = x(axis) < 0 ? -1 : 1;
  return {value, gradient};
}

// x + v t reaches the distance `radius` from the box, from piece to piece.
std::optional<double> straight_time(const Vec3& x, const Vec3& v, const Vec3& half, double radius, double horizon) {
  const BoxDistance start = box_distance(x, half);
  if (!std::isfinite(start.value) || !v.allFinite()) return std::nullopt;
  if (start.value <= radius) return start.gradient.dot(v) < 0 ? std::optional(0.0) : std::nullopt;

  std::array<double, 7> ends;  // where a coordinate passes a face of the box; the horizon for all that do not
  ends.fill(horizon);
  std::size_t count = 0;
  for (int k = 0; k < 3; ++k) {
    for (const double side : {-half(k), half(k)}) {
      const double t = (side - x(k)) / v(k);
      if (t > 0 && t < horizon) ends[count++] = t;
    }
  }
  std::sort(ends.begin(), ends.end());

  double from = 0;
  for (const double end : ends) {
    // Only the coordinates that are outside all through this piece count; a straight distance |d + v t| is left.
    const Vec3 middle = x + 0.5 * (from + end) * v;
    Vec3 d = Vec3::Zero(), rate = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      if (std::abs(middle(i)) <= half(i)) continue;
      d(i) = x(i) - std::copysign(half(i), middle(i));
      rate(i) = v(i);
    }
    if (d.isZero(0) && rate.isZero(0)) return from;  // the centre itself is in the box: a sphere of radius 0
    const double closing = -d.dot(rate), speed = rate.norm(), miss = d.cross(rate).norm();
    const double clear = (d.norm() - radius) * (d.norm() + radius);
    const double radicand = (radius * speed - miss) * (radius * speed + miss);
    // Closed at the end of the piece: rounding must not push the root into the next one, where it would get lost.
    const bool closed = (d + end * rate).squaredNorm() <= radius * radius;
    if (closing > 0 && radicand > 0) {
      const double t = clear / (closing + std::sqrt(radicand));
      if (closed || (t >= from && t <= end)) return std::clamp(t, from, end);
    } else if (closed) {
      return end;
    }
    from = end;
  }
  return std::nullopt;
}

// The path of the sphere's centre as the box sees it.
class PathInBox {
 public:
  PathInBox(const Motion& sphere, const Motion& box)
      : d_(sphere.start.p_WB - box.start.p_WB),
        v_(sphere.start.v_WB - box.start.v_WB),
        a_(sphere.a_W - box.a_W),
        w_(box.start.w_WB),
        attitude_(box.start.q_WB) {}

  Vec3 offset(double t) const { return d_ + t * v_ + 0.5 * t * t * a_; }
  Vec3 velocity(double t) const { return v_ + t * a_; }
  const Vec3& acceleration() const { return a_; }
  Quat attitude(double t) const { return rotation_by(t * w_) * attitude_; }
  Vec3 position(double t) const { return attitude(t).conjugate() * offset(t); }
  Height height(double t, const Vec3& half, double radius) const {
    const Quat q = attitude(t);
    const BoxDistance distance = box_distance(q.conjugate() * offset(t), half);
    return {distance.value - radius, (q * distance.gradient).dot(velocity(t) - w_.cross(offset(t)))};
  }
  // Bound of |x''| from t to t + span.
  double bend(double t, double span) const {
    const double fastest = velocity(t).norm() + span * a_.norm(), turn = w_.norm();
    return a_.norm() + 2 * turn * fastest + turn * turn * (offset(t).norm() + span * fastest);
  }
  // A time in which the centre moves by about that length [m].
  double span(double t, double length) const {
    return std::min(length / velocity(t).norm(), std::sqrt(length / a_.norm()));
  }
  bool straight() const { return !(w_.norm() > 0) && !(a_.norm() > 0); }

 private:
  Vec3 d_, v_, a_, w_;
  Quat attitude_;
};

// Piece by piece of the way, since the bound of x'' grows with the length of a piece.
std::optional<double> turning_time(const PathInBox& path, const Vec3& half, double radius, double horizon) {
  const double size = 2 * half.norm() + 2 * radius, reach = half.norm() + radius;
  constexpr int kMaxPieces = 10000;
  double t = 0;
  for (int k = 0; k < kMaxPieces; ++k) {
    if (path.offset(t).norm() > reach * (1 + 1e-9)) {  // nothing happens until it enters the sphere about the box
      Motion centre;
      centre.start.p_WB = path.offset(t);
      centre.start.v_WB = path.velocity(t);
      centre.a_W = path.acceleration();
      const auto entry = sphere_meets_sphere(centre, radius, Motion{}, half.norm(), horizon - t);
      if (!entry) return std::nullopt;
      t += *entry;
    }
    if (!(t <= horizon)) return std::nullopt;
    const double span = std::min(horizon - t, path.span(t, reach));
    const auto curve = [&](double s) { return path.height(t + s, half, radius); };
    const auto met = advance(curve, path.bend(t, span), kImpactTolerance * size, span);
    if (met) return t + *met;
    if (t + span >= horizon) return std::nullopt;
    t += span;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Touch> sphere_meets_box(const Motion& sphere, double radius, const Motion& box, const Vec3& size,
                                      double horizon) {
  const PathInBox path(sphere, box);
  const Vec3 half = 0.5 * size;
  std::optional<double> time;
  if (path.straight()) {
    const Quat to_box = path.attitude(0).conjugate();
    time = straight_time(to_box * path.offset(0), to_box * path.velocity(0), half, radius, horizon);
  } else {
    time = turning_time(path, half, radius, horizon);
  }
  if (!time || !(*time <= horizon)) return std::nullopt;
  const double t = *time;
  const BoxDistance distance = box_distance(path.position(t), half);
  const Vec3 normal_W = path.attitude(t) * distance.gradient;
  const Vec3 centre_W = sphere.start.p_WB + t * sphere.start.v_WB + 0.5 * t * t * sphere.a_W;
  return Touch{t, centre_W - 0.5 * (distance.value + radius) * normal_W, normal_W};
}

}  // namespace plumbline
