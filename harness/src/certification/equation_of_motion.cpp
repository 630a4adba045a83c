// The reference in its own equation of motion.
//
// A difference quotient divides the rounding of its values by a small step, so that half of the digits are lost. Its
// integral loses none: over a span from a to b
//
//   p(b) - p(a) = integral of v,   v(b) - v(a) = integral of a,   q(b) - q(a) = integral of (0, w) q/2,
//   w(b) - w(a) = integral of dw/dt
//
// where the accelerations are those of forces, springs, joints and the gyroscopic term in the states of the reference.
// The integrals are taken by Gauss's rule with 8 nodes on either half of the span; the same rule on the whole span says
// how good they are, and a span where they are not good enough is cut in two. What may remain: the claimed error of
// the two ends, that of the integrand times the span, and the error of the quadrature.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plumbline/core/joints/joint_equations.hpp"
#include "plumbline/core/kinetics/force_following.hpp"
#include "plumbline/core/metric.hpp"
#include "second_sources.hpp"

namespace plumbline {
namespace {

constexpr int kSpans = 64;
constexpr int kCuts = 14;    // a jump of the force is then confined to a millionth of the duration
constexpr int kProbes = 16;  // times at which the sensitivity of the accelerations is measured
constexpr int kSamples = 200;
constexpr double kRoundings = 64 * 0x1p-53;

// Nodes in (-1, 1) and weights of Gauss's rule: zeros of the Legendre polynomial by Newton's method.
struct GaussRule {
  static constexpr int kNodes = 8;
  std::array<double, kNodes> node{}, weight{};
  GaussRule() {
    for (int i = 0; i < kNodes; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
      for (int pass = 0; pass < 20; ++pass) {
        double before = 1, now = x;
        for (int n = 2; n <= kNodes; ++n) {
          const double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
          before = now;
          now = next;
        }
        slope = kNodes * (x * now - before) / (x * x - 1);
        x -= now / slope;
      }
      const auto at = static_cast<std::size_t>(i);
      node[at] = x;
      weight[at] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

// Rates of one body's 13 numbers, or their integral.
struct Rates {
  Vec3 v = Vec3::Zero(), a = Vec3::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  Vec3 alpha = Vec3::Zero();
};

void add(std::vector<Rates>& sum, const std::vector<Rates>& rates, double factor) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].v += factor * rates[i].v;
    sum[i].a += factor * rates[i].a;
    sum[i].turn += factor * rates[i].turn;
    sum[i].alpha += factor * rates[i].alpha;
  }
}

class EquationOfMotion {
 public:
  EquationOfMotion(const Scenario& scenario, const Reference& reference, const Claim& claim)
      : scenario_(scenario), reference_(reference), claim_(claim), field_(acceleration_field(scenario)) {
    probe_accelerations();
  }

  Worst check(double until) {
    for (int k = 0; k < kSpans; ++k) {
      const double a = until * k / kSpans, b = until * (k + 1) / kSpans;
      check_span(a, b, integral(a, b), 0);
    }
    return worst_;
  }

 private:
  std::vector<Rates> rates_at(double t) {
    const auto states = states_of(scenario_, reference_, t);
    field_values_.assign(states.size(), {});
    field_(t, states, field_values_);
    std::vector<Rates> rates(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Vec3& w = states[i].w_WB;
      const Quat spin(0, w.x(), w.y(), w.z());
      rates[i] = {states[i].v_WB, field_values_[i].linear, 0.5 * (spin * states[i].q_WB).coeffs(),
                  field_values_[i].angular};
      // q and -q are one attitude: a span speaks of the one in its middle.
      if (flipped(states[i].q_WB, i)) rates[i].turn = -rates[i].turn;
    }
    return rates;
  }

  bool flipped(const Quat& q, std::size_t body) const { return q.coeffs().dot(anchor_[body].coeffs()) < 0; }

  std::vector<Rates> integral(double a, double b) {
    static const GaussRule kRule;
    anchor_.clear();
    for (const BodyState& s : states_of(scenario_, reference_, 0.5 * (a + b))) anchor_.push_back(s.q_WB);
    std::vector<Rates> sum(scenario_.bodies.size());
    for (std::size_t n = kRule.node.size(); n-- > 0;) {  // nodes fall: time rises
      const double t = 0.5 * (a + b) + 0.5 * (b - a) * kRule.node[n];
      add(sum, rates_at(t), 0.5 * (b - a) * kRule.weight[n]);
    }
    return sum;
  }

  // The turn's integral belongs to the sign of q in the middle of its span; brought to that of `other`.
  void align(std::vector<Rates>& part, const std::vector<Quat>& own, const std::vector<Quat>& other) const {
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (own[i].coeffs().dot(other[i].coeffs()) < 0) part[i].turn = -part[i].turn;
    }
  }

  void check_span(double a, double b, const std::vector<Rates>& whole, int cuts) {
    const std::vector<Quat> anchor_whole = middle(a, b);
    const double m = 0.5 * (a + b);
    const std::vector<Rates> left = integral(a, m), right = integral(m, b);
    std::vector<Rates> sum = left, second = right;
    align(sum, middle(a, m), anchor_whole);
    align(second, middle(m, b), anchor_whole);
    add(sum, second, 1);

    const Differences allowed = allowance(b - a);
    Differences quadrature, defect;
    const auto start = states_of(scenario_, reference_, a), end = states_of(scenario_, reference_, b);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      if (scenario_.bodies[i].fixed) continue;
      const auto same_sign = [&](const Quat& q) {
        const Eigen::Vector4d c = q.coeffs();
        return c.dot(anchor_whole[i].coeffs()) < 0 ? Eigen::Vector4d(-c) : c;
      };
      quadrature =
          larger(quadrature, {(whole[i].v - sum[i].v).norm(), (whole[i].a - sum[i].a).norm(),
                              2 * (whole[i].turn - sum[i].turn).norm(), (whole[i].alpha - sum[i].alpha).norm()});
      defect = larger(defect,
                      {(end[i].p_WB - start[i].p_WB - sum[i].v).norm(), (end[i].v_WB - start[i].v_WB - sum[i].a).norm(),
                       2 * (same_sign(end[i].q_WB) - same_sign(start[i].q_WB) - sum[i].turn).norm(),
                       (end[i].w_WB - start[i].w_WB - sum[i].alpha).norm()});
    }
    const bool resolved = quadrature.place <= 0.25 * allowed.place && quadrature.velocity <= 0.25 * allowed.velocity &&
                          quadrature.attitude <= 0.25 * allowed.attitude && quadrature.spin <= 0.25 * allowed.spin;
    if (!resolved && cuts < kCuts) {
      check_span(a, m, left, cuts + 1);
      check_span(m, b, right, cuts + 1);
      return;
    }
    // A force that jumps is not integrated better than this, however narrow the span has become.
    const Differences bound{allowed.place + 4 * quadrature.place, allowed.velocity + 4 * quadrature.velocity,
                            allowed.attitude + 4 * quadrature.attitude, allowed.spin + 4 * quadrature.spin};
    worst_.offer(defect, bound, claim_.extent, " against the integral of its rate from t = " + shortest(a));
  }

  std::vector<Quat> middle(double a, double b) const {
    std::vector<Quat> result;
    for (const BodyState& s : states_of(scenario_, reference_, 0.5 * (a + b))) result.push_back(s.q_WB);
    return result;
  }

  Differences allowance(double span) const {
    return {2 * claim_.place + span * claim_.velocity, 2 * claim_.velocity + span * error_.linear,
            2 * claim_.attitude + span * claim_.spin + 0.5 * span * claim_.extent.spin * claim_.attitude,
            2 * claim_.spin + span * error_.angular};
  }

  // How far the accelerations may be off because the states are: states are pushed by a ten-millionth of their extent,
  // and what that changes is scaled down to the claimed error. A push at random tells the worst one within a factor of
  // the square root of the number of coordinates: three is granted.
  void probe_accelerations() {
    constexpr double kPush = 1e-7;
    const double share = 3 * std::max({claim_.place / claim_.extent.place, claim_.velocity / claim_.extent.speed,
                                       claim_.attitude, claim_.spin / claim_.extent.spin});
    double largest_linear = scenario_.gravity.norm(), largest_angular = 0;
    unsigned bits = 1;
    const auto random = [&bits] {
      Vec3 v;
      for (double& x : v) {
        bits = bits * 1664525U + 1013904223U;
        x = static_cast<double>(bits) * 0x1p-31 - 1;
      }
      return v;
    };
    for (int k = 0; k < kProbes; ++k) {
      const double t = compared_until(scenario_) * (k + 0.5) / kProbes;
      auto states = states_of(scenario_, reference_, t);
      std::vector<Acceleration> plain(states.size()), pushed(states.size());
      field_(t, states, plain);
      for (BodyState& s : states) {
        s.p_WB += kPush * claim_.extent.place * random();
        s.v_WB += kPush * claim_.extent.speed * random();
        s.w_WB += kPush * claim_.extent.spin * random();
        s.q_WB = (rotation_by(kPush * random()) * s.q_WB).normalized();
      }
      field_(t, states, pushed);
      for (std::size_t i = 0; i < states.size(); ++i) {
        const double linear = (pushed[i].linear - plain[i].linear).norm() / kPush;
        const double angular = (pushed[i].angular - plain[i].angular).norm() / kPush;
        error_.linear = max_or_nan(error_.linear, linear * share);
        error_.angular = max_or_nan(error_.angular, angular * share);
        largest_linear = max_or_nan(largest_linear, plain[i].linear.norm());
        largest_angular = max_or_nan(largest_angular, plain[i].angular.norm());
      }
    }
    error_.linear += kRoundings * largest_linear;
    error_.angular += kRoundings * (largest_angular + claim_.extent.spin * claim_.extent.spin);
  }

  struct AccelerationError {
    double linear = 0, angular = 0;  // [m/s^2], [rad/s^2]
  };

  const Scenario& scenario_;
  const Reference& reference_;
  const Claim& claim_;
  AccelerationField field_;
  std::vector<Acceleration> field_values_;
  std::vector<Quat> anchor_;  // attitudes in the middle of the span: they fix the sign of q
  AccelerationError error_;
  Worst worst_;
};

// The farthest that a joint reaches from a body's centre [m].
double longest_arm(const Scenario& scenario) {
  double arm = 0;
  for (const Joint& joint : scenario.joints) arm = std::max({arm, joint.on_a.anchor.norm(), joint.on_b.anchor.norm()});
  return arm;
}

}  // namespace

bool is_smooth(const Scenario& scenario) {
  return !scenario.contact && std::none_of(scenario.joints.begin(), scenario.joints.end(),
                                           [](const Joint& joint) { return joint.range.has_value(); });
}

void check_start(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result) {
  std::vector<BodyState> stated;
  for (const Body& body : scenario.bodies) stated.push_back(body.initial);
  Worst worst;
  worst.offer(differences(scenario, states_of(scenario, reference, 0), stated),
              {claim.place, claim.velocity, claim.attitude, claim.spin}, claim.extent, " at the start");
  result.rows.push_back({"start", worst.what, worst.figure, worst.bound, false, {}});
}

void check_motion(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result) {
  const double until = compared_until(scenario);
  const Worst worst = EquationOfMotion(scenario, reference, claim).check(until);
  result.rows.push_back({"motion", worst.what, worst.figure, worst.bound, true, {}});
}

void check_joints(const Scenario& scenario, const Reference& reference, const Claim& claim, Certification& result) {
  if (scenario.joints.empty()) return;
  const ArticulatedBody body = articulated_body(scenario);
  double worst = 0;
  for (int k = 0; k <= kSamples; ++k) {
    worst =
        max_or_nan(worst, joint_error(body, states_of(scenario, reference, compared_until(scenario) * k / kSamples)));
  }
  // Two ends, each as far off as the claim says, in place and by the turn of its arm; some conditions are angles.
  const double bound = 4 * (claim.place + std::max(1.0, longest_arm(scenario)) * claim.attitude);
  result.rows.push_back({"joints", "gap of the joints", worst, bound, false, {}});
}

}  // namespace plumbline
