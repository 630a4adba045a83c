// The moment of first touch by another way than the core's, to check it.
//
// Two convex polyhedra meet exactly if an edge of one has a point inside the other (both ways tried). The depth of a
// point is the largest of its heights over all face planes; along an edge that is a maximum of linear functions, whose
// minimum is found by intersecting lines. No separating axis, no product of edges, no derivative is used.
//
// The first time is found by halving: the least height q(t) cannot change faster than the bodies move, so an interval
// of length h is free if q(middle) > speed * h/2; others are halved, the earlier half first, down to `resolution`.
// Where q has changed its sign over one of that length, halving it further by sign gives the time to the last bit.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "plumbline/core/collision/convex_polyhedron.hpp"
#include "plumbline/core/collision/time_of_impact.hpp"

namespace plumbline {

class PiercingOracle {
 public:
  PiercingOracle(const ConvexPolyhedron& a, const Motion& motion_a, const ConvexPolyhedron& b, const Motion& motion_b)
      : a_(a), b_(b), motion_a_(motion_a), motion_b_(motion_b) {}

  // Positive: apart; zero: touching; negative: overlapping [m].
  double height(double t) {
    const BodyState a = at(motion_a_, t), b = at(motion_b_, t);
    return std::min(least_height(a_, a, b_, b), least_height(b_, b, a_, a));
  }

  // Nothing if they are apart all the time. An overlap that both begins and ends within one interval of length
  // `resolution` may be passed over: it is not deeper than resolution * speed.
  std::optional<double> first_touch(double from, double to, double resolution) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const Vec3 d = at(motion_b_, middle).p_WB - at(motion_a_, middle).p_WB;
    const Vec3 v = motion_b_.start.v_WB - motion_a_.start.v_WB, c = motion_b_.a_W - motion_a_.a_W;
    const double glide = (v + middle * c).norm() + half * c.norm();
    const double spin_a = motion_a_.start.w_WB.norm(), spin_b = motion_b_.start.w_WB.norm();
    const double radii = a_.radius() + b_.radius();
    if (d.norm() - radii > half * glide) return std::nullopt;
    // The velocity of a point of one body as seen from the other, which turns as well.
    const double far = d.norm() + half * glide;
    const double speed = glide + std::max(spin_a * a_.radius() + spin_b * (far + a_.radius()),
                                          spin_b * b_.radius() + spin_a * (far + b_.radius()));
    if (height(middle) > half * speed) return std::nullopt;
    if (to - from <= resolution) return height(to) > 0 ? std::nullopt : std::optional(change_of_sign(from, to));
    const auto early = first_touch(from, middle, resolution);
    return early ? early : first_touch(middle, to, resolution);
  }

 private:
  static BodyState at(const Motion& m, double t) {
    BodyState s = m.start;
    s.p_WB += t * m.start.v_WB + 0.5 * t * t * m.a_W;
    s.q_WB = rotation_by(t * m.start.w_WB) * m.start.q_WB;
    return s;
  }

  double change_of_sign(double from, double to) {
    for (;;) {
      const double middle = 0.5 * (from + to);
      if (!(from < middle && middle < to)) return from;
      (height(middle) > 0 ? from : to) = middle;
    }
  }

  // The least height over the faces of `solid` that the edges of `wire` reach.
  double least_height(const ConvexPolyhedron& wire, const BodyState& wire_at, const ConvexPolyhedron& solid,
                      const BodyState& solid_at) {
    const Mat3 R = (solid_at.q_WB.conjugate() * wire_at.q_WB).toRotationMatrix();
    const Vec3 shift = solid_at.q_WB.conjugate() * (wire_at.p_WB - solid_at.p_WB);
    const std::size_t planes = solid.faces().size();
    heights_.clear();
    for (const Vec3& r : wire.vertices_B()) {
      const Vec3 p = shift + R * r;
      for (const auto& face : solid.faces()) heights_.push_back(face.normal_B.dot(p) - face.offset);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& edge : wire.edges()) {
      const double* tail = &heights_[edge.tail * planes];
      const double* head = &heights_[edge.head * planes];
      double outside = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < planes; ++k) outside = std::max(outside, std::min(tail[k], head[k]));
      if (outside < least) least = std::min(least, least_of_largest(tail, head, planes));
    }
    return least;
  }

  // min over s in [0, 1] of max_k (tail_k + s (head_k - tail_k)): from the lines that are highest at the two ends, go
  // to where they cross; the line that is highest there replaces the one on its side, until none is higher.
  static double least_of_largest(const double* tail, const double* head, std::size_t count) {
    const auto at = [&](std::size_t k, double s) { return tail[k] + s * (head[k] - tail[k]); };
    const auto highest = [&](double s) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < count; ++k) {
        if (at(k, s) > at(best, s)) best = k;
      }
      return best;
    };
    std::size_t left = highest(0), right = highest(1);
    if (head[left] >= tail[left]) return tail[left];
    if (head[right] <= tail[right]) return head[right];
    for (;;) {
      const double fall = tail[left] - head[left], rise = head[right] - tail[right];
      const double s = std::clamp((tail[left] - tail[right]) / (fall + rise), 0.0, 1.0);
      const std::size_t top = highest(s);
      const double value = at(top, s), crossing = std::max(at(left, s), at(right, s));
      if (top == left || top == right || !(value > crossing)) return value;
      (head[top] < tail[top] ? left : right) = top;
    }
  }

  const ConvexPolyhedron &a_, &b_;
  const Motion &motion_a_, &motion_b_;
  std::vector<double> heights_;
};

}  // namespace plumbline
