#include "plumbline/core/collision/polyhedron_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "separating_motion.hpp"

namespace plumbline {
namespace {

// Only a gap that stays just above the tolerance, or rests within it while the bodies turn, needs more than some dozen.
constexpr int kMaxSteps = 10000;

// Edges whose directions differ by less have a cross product that turns fast as they turn; a direction fixed to one of
// the bodies then often sees farther ahead.
constexpr double kNearlyParallel = 0.05;

// Nothing touches while the bounding spheres are apart: the time until these meet.
std::optional<double> spheres_meet(const MovingPair& pair, double horizon) {
  Motion a, b;
  b.start.p_WB = pair.b.centre;
  b.start.v_WB = pair.velocity;
  b.a_W = pair.acceleration;
  return sphere_meets_sphere(a, pair.a.shape->radius(), b, pair.b.shape->radius(), horizon);
}

// The bounds grow with the path ahead: look no farther than the bodies move by about their own size.
double look_ahead(const MovingPair& pair, double reach, double remaining) {
  return std::min({remaining, reach / pair.velocity.norm(), std::sqrt(reach / pair.acceleration.norm())});
}

double step_along(const SeparatingAxis& axis, const MovingPair& pair, double until) {
  const TurningDirection direction = direction_of(axis, pair);
  double step = GapBound(pair, direction, until).time_above(0);
  if (direction.rides == TurningDirection::Rides::kOnBoth) {
    const Vec3 u = pair.a.edge_vector(pair.a.shape->edges()[axis.index_a]);
    const Vec3 v = pair.b.edge_vector(pair.b.shape->edges()[axis.index_b]);
    if (u.cross(v).norm() < kNearlyParallel * u.norm() * v.norm()) {
      step = std::max(step, GapBound(pair, riding_on_a(axis.normal_W, pair), until).time_above(0));
    }
  }
  return step;
}

// Bodies that touch approach if they do so along every axis that sees them touch (they part along any other one).
// Those that do not get the step after which to look again.
std::optional<double> step_if_parting(const SeparatingAxis& best, const MovingPair& pair, double tolerance,
                                      double until) {
  const double rest =
      16 * std::numeric_limits<double>::epsilon() *
      (pair.velocity.norm() + pair.w_A.norm() * pair.a.shape->radius() + pair.w_B.norm() * pair.b.shape->radius());
  std::optional<double> step;
  visit_axes(pair.a, pair.b, best.gap - tolerance, [&](const SeparatingAxis& axis) {
    const GapBound bound(pair, direction_of(axis, pair), until);
    // Slower than rounding can tell is rest, not approach. Until the gap may have fallen by the tolerance, nothing
    // worth a look can happen.
    if (!(bound.rate(tolerance) < -rest)) step = std::max(step.value_or(0), bound.time_above(axis.gap - tolerance));
    return best.gap - tolerance;
  });
  return step;
}

Touch touch_at(double t, const SeparatingAxis& axis, MovingPair& pair, const Motion& motion_a) {
  const Vec3 centre_a = motion_a.start.p_WB + t * motion_a.start.v_WB + 0.5 * t * t * motion_a.a_W;
  // A is first moved along the normal until it just touches (from far inside only if they overlap at the start).
  for (Vec3& p : pair.a.vertices) p -= axis.gap * axis.normal_W;
  for (std::size_t f = 0; f < pair.a.normals.size(); ++f) {
    pair.a.offsets[f] -= axis.gap * axis.normal_W.dot(pair.a.normals[f]);
  }
  const NearestPoints nearest = nearest_features(pair.a, pair.b);
  return {t, centre_a + 0.5 * (nearest.a + nearest.b) + 0.5 * axis.gap * axis.normal_W, axis.normal_W};
}

}  // namespace

std::optional<Touch> polyhedron_meets_polyhedron(const ConvexPolyhedron& a, const Motion& motion_a,
                                                 const ConvexPolyhedron& b, const Motion& motion_b, double horizon) {
  const double reach = a.radius() + b.radius(), tolerance = kImpactTolerance * reach;
  MovingPair pair(a, motion_a, b, motion_b);
  double t = 0;
  for (int k = 0; k < kMaxSteps && t <= horizon; ++k) {
    if (k > 0) pair.move_to(t);
    if (pair.b.centre.norm() > reach * (1 + 1e-9)) {
      const auto until = spheres_meet(pair, horizon - t);
      if (!until) return std::nullopt;
      t += *until;
      if (*until > 0) continue;
    }
    const SeparatingAxis axis = separating_axis(pair.a, pair.b);
    if (std::isnan(axis.gap)) return std::nullopt;
    const double until = look_ahead(pair, reach, horizon - t);
    double step = 0;
    if (axis.gap <= tolerance) {
      const auto parting = step_if_parting(axis, pair, tolerance, until);
      if (!parting) return touch_at(t, axis, pair, motion_a);
      step = *parting;
    } else {
      step = step_along(axis, pair, until);
    }
    if (t == horizon || !(step > 0)) return std::nullopt;
    t = std::min(t + step, horizon);
  }
  return std::nullopt;
}

}  // namespace plumbline
