#include "plumbline/core/response/impulse.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "impulse_equations.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

constexpr int kMaxSweeps = 1000;
constexpr double kRelativeChange = 1e-14;
constexpr int kSweepsPerLeap = 8;
constexpr int kTries = 6;  // of one leap
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

void push(BodyState& state, const Inertness& body, const Vec3& point_W, const Vec3& impulse_W) {
  state.v_WB += body.inverse_mass * impulse_W;
  state.w_WB += body.inverse_inertia_W * (point_W - state.p_WB).cross(impulse_W);
}

void push_pair(std::span<BodyState> states, std::span<const Inertness> inertness, const Contact& c,
               const Vec3& impulse_W) {
  push(states[c.body_a], inertness[c.body_a], c.point_W, impulse_W);
  push(states[c.body_b], inertness[c.body_b], c.point_W, -impulse_W);
}

PointImpulse prepared(const Contact& c, std::span<const Inertness> inertness, std::span<const BodyState> states) {
  const auto answer = [&](std::size_t body) {
    const Vec3 r = c.point_W - states[body].p_WB;
    return point_mobility(inertness[body], r, r);
  };
  const Mat3 k = answer(c.body_a) + answer(c.body_b);
  const Mat3 across = Mat3::Identity() - c.normal_W * c.normal_W.transpose();
  const Mat3 tangential = across * k * across;
  // Dividing by the largest answer of the plane makes a sweep a contraction whose fixed point is Coulomb's law
  // itself: friction opposite to the sliding velocity, also where the answer depends on the direction. Where it does
  // not (a sphere), one correction is exact.
  const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(tangential, Eigen::EigenvaluesOnly).eigenvalues()(2);
  return {1 / c.normal_W.dot(k * c.normal_W), 1 / largest};
}

// The search: the impulses so far, and the velocities under them.
struct Search {
  std::vector<PointImpulse> impulses;
  std::vector<BodyState> states;
  double change = std::numeric_limits<double>::infinity();  // of any impulse in the last sweep [N s]
  double largest = 0;                                       // impulse along a normal [N s]
  double rounding = 0;                                      // what the rounding of velocities is worth [N s]
};

void sweep(std::span<const ImpactPoint> points, std::span<const Inertness> inertness, Search& search) {
  search.change = search.largest = search.rounding = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Contact& c = points[k].contact;
    PointImpulse& p = search.impulses[k];

    const double wanted = p.normal + p.normal_mass * (points[k].rebound_speed + approach_speed(c, search.states));
    const double normal = wanted < 0 ? 0 : wanted;  // not std::max, which would drop a NaN
    push_pair(search.states, inertness, c, (normal - p.normal) * c.normal_W);
    search.change = max_or_nan(search.change, std::abs(normal - p.normal));
    p.normal = normal;

    if (points[k].friction > 0) {
      const Vec3 v = contact_velocity(c, search.states);
      Vec3 tangent = p.tangent - p.tangent_mass * (v - c.normal_W.dot(v) * c.normal_W);
      const double length = tangent.norm(), bound = points[k].friction * normal;
      if (length > bound) tangent *= bound / length;
      push_pair(search.states, inertness, c, tangent - p.tangent);
      search.change = max_or_nan(search.change, (tangent - p.tangent).norm());
      p.tangent = tangent;
    }
    search.largest = max_or_nan(search.largest, p.normal);
    const double speed = point_velocity(search.states[c.body_a], c.point_W).norm() +
                         point_velocity(search.states[c.body_b], c.point_W).norm();
    search.rounding = max_or_nan(search.rounding, kEpsilon * p.normal_mass * speed);
  }
}

// Solves for the points that push, and sweeps once; again while that tells that other points push, grip or slide. Kept
// once a sweep has less to change than the last one before; whether it came to that.
bool leap(std::span<const ImpactPoint> points, std::span<const Inertness> inertness, std::span<const BodyState> start,
          Search& search) {
  Search trial = search;
  for (int tries = 0; tries < kTries; ++tries) {
    solve_pushing_points(points, inertness, trial.states, trial.impulses);
    trial.states.assign(start.begin(), start.end());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const PointImpulse& p = trial.impulses[k];
      push_pair(trial.states, inertness, points[k].contact, p.normal * points[k].contact.normal_W + p.tangent);
    }
    sweep(points, inertness, trial);
    if (trial.change < search.change) {
      search = std::move(trial);
      return true;
    }
  }
  return false;
}

}  // namespace

Inertness inertness_of(const Body& body, const Quat& q_WB) {
  if (body.fixed) return {};
  const Vec3 inverse = body.inertia.unaryExpr([](double moment) { return moment == 0 ? 0.0 : 1 / moment; });
  const Mat3 r_WB = q_WB.toRotationMatrix();
  return {1 / body.mass, r_WB * inverse.asDiagonal() * r_WB.transpose()};
}

ImpulseReport apply_impulses(std::span<const ImpactPoint> points, std::span<const Inertness> inertness,
                             std::span<BodyState> states, Leaps leaps) {
  ImpulseReport report;
  report.converged = points.empty();
  Search search;
  search.states.assign(states.begin(), states.end());
  for (const ImpactPoint& p : points) search.impulses.push_back(prepared(p.contact, inertness, states));

  int pause = kSweepsPerLeap, next_leap = pause;
  while (!report.converged && report.sweeps < kMaxSweeps) {
    ++report.sweeps;
    if (leaps == Leaps::kAllowed && report.sweeps == next_leap) {
      if (!leap(points, inertness, states, search)) {
        sweep(points, inertness, search);
        pause *= 2;
      }
      next_leap += pause;
    } else {
      sweep(points, inertness, search);
    }
    // Grazing impulses are smaller than what the rounding of large velocities is worth. That they will not settle any
    // further shows when leaps are due, or when the sweeps are over.
    const bool at_last = report.sweeps >= (leaps == Leaps::kAllowed ? kSweepsPerLeap : kMaxSweeps);
    const double settled = kRelativeChange * search.largest;
    report.converged = search.change <= (at_last ? std::max(settled, search.rounding) : settled);
    if (std::isnan(search.change)) break;
  }

  for (std::size_t k = 0; k < points.size(); ++k) {
    const Contact& c = points[k].contact;
    report.impulses_W.push_back(search.impulses[k].normal * c.normal_W + search.impulses[k].tangent);
    push_pair(states, inertness, c, report.impulses_W.back());
  }
  return report;
}

}  // namespace plumbline
