#include "plumbline/core/response/impulse.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

constexpr int kMaxSweeps = 1000;
constexpr double kRelativeChange = 1e-14;

Mat3 cross_matrix(const Vec3& r) {
  Mat3 m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

// Change of the velocity of a body's point at the arm r per unit impulse there: 1/m - [r] I^-1 [r].
Mat3 answer(const Inertness& body, const Vec3& r) {
  const Mat3 arm = cross_matrix(r);
  return body.inverse_mass * Mat3::Identity() - arm * body.inverse_inertia_W * arm;
}

void push(BodyState& state, const Inertness& body, const Vec3& point_W, const Vec3& impulse_W) {
  state.v_WB += body.inverse_mass * impulse_W;
  state.w_WB += body.inverse_inertia_W * (point_W - state.p_WB).cross(impulse_W);
}

void push_pair(std::span<BodyState> states, std::span<const Inertness> inertness, const Contact& c,
               const Vec3& impulse_W) {
  push(states[c.body_a], inertness[c.body_a], c.point_W, impulse_W);
  push(states[c.body_b], inertness[c.body_b], c.point_W, -impulse_W);
}

// Effective masses [kg] of one point: what an impulse must be multiplied from to change its velocity by 1 m/s.
struct Point {
  double normal_mass, tangent_mass;
  double normal = 0;            // [N s]
  Vec3 tangent = Vec3::Zero();  // [N s]
};

Point prepared(const Contact& c, std::span<const Inertness> inertness, std::span<const BodyState> states) {
  const Mat3 k = answer(inertness[c.body_a], c.point_W - states[c.body_a].p_WB) +
                 answer(inertness[c.body_b], c.point_W - states[c.body_b].p_WB);
  const Mat3 across = Mat3::Identity() - c.normal_W * c.normal_W.transpose();
  const Mat3 tangential = across * k * across;
  // Dividing by the largest answer of the plane makes a sweep a contraction whose fixed point is Coulomb's law
  // itself: friction opposite to the sliding velocity, also where the answer depends on the direction. Where it does
  // not (a sphere), one correction is exact.
  const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(tangential, Eigen::EigenvaluesOnly).eigenvalues()(2);
  return {1 / c.normal_W.dot(k * c.normal_W), 1 / largest};
}

}  // namespace

Inertness inertness_of(const Body& body, const Quat& q_WB) {
  if (body.fixed) return {};
  const Vec3 inverse = body.inertia.unaryExpr([](double moment) { return moment == 0 ? 0.0 : 1 / moment; });
  const Mat3 r_WB = q_WB.toRotationMatrix();
  return {1 / body.mass, r_WB * inverse.asDiagonal() * r_WB.transpose()};
}

ImpulseReport apply_impulses(std::span<const ImpactPoint> points, std::span<const Inertness> inertness,
                             std::span<BodyState> states) {
  ImpulseReport report;
  report.converged = points.empty();
  std::vector<Point> work;
  work.reserve(points.size());
  for (const ImpactPoint& p : points) work.push_back(prepared(p.contact, inertness, states));

  std::vector<BodyState> trial(states.begin(), states.end());
  while (!report.converged && report.sweeps < kMaxSweeps) {
    ++report.sweeps;
    double largest = 0, change = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Contact& c = points[k].contact;
      Point& p = work[k];

      const double wanted = p.normal + p.normal_mass * (points[k].rebound_speed + approach_speed(c, trial));
      const double normal = wanted < 0 ? 0 : wanted;  // not std::max, which would drop a NaN
      push_pair(trial, inertness, c, (normal - p.normal) * c.normal_W);
      change = max_or_nan(change, std::abs(normal - p.normal));
      p.normal = normal;

      if (points[k].friction > 0) {
        const Vec3 v = contact_velocity(c, trial);
        Vec3 tangent = p.tangent - p.tangent_mass * (v - c.normal_W.dot(v) * c.normal_W);
        const double length = tangent.norm(), bound = points[k].friction * normal;
        if (length > bound) tangent *= bound / length;
        push_pair(trial, inertness, c, tangent - p.tangent);
        change = max_or_nan(change, (tangent - p.tangent).norm());
        p.tangent = tangent;
      }
      largest = max_or_nan(largest, p.normal);
    }
    report.converged = change <= kRelativeChange * largest;
    if (std::isnan(change)) break;
  }

  for (std::size_t k = 0; k < points.size(); ++k) {
    const Contact& c = points[k].contact;
    report.impulses_W.push_back(work[k].normal * c.normal_W + work[k].tangent);
    push_pair(states, inertness, c, report.impulses_W.back());
  }
  return report;
}

}  // namespace plumbline
