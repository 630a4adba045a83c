#include "gauss_collocation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace plumbline::extended {
namespace {

constexpr int kStages = GaussCollocation::kStages;
constexpr Real kRounding = std::numeric_limits<Real>::epsilon();
// Of the polynomial within a step, relative to the scales. Ends of steps are far better.
constexpr Real kTolerance = 1e-17L;
constexpr int kMaxIterations = 40;
constexpr int kManyIterations = 12;           // beyond, shorter steps are cheaper
constexpr std::size_t kKeptBytes = 64 << 20;  // of steps that are remembered

using Square = Eigen::Matrix<Real, kStages, kStages>;
using Row = std::array<Real, kStages + 1>;

// P_0 .. P_kStages at x.
Row legendre(Real x) {
  Row p{1, x};
  for (int k = 1; k < kStages; ++k) {
    const auto n = static_cast<Real>(k);
    const auto at = static_cast<std::size_t>(k);
    p[at + 1] = ((2 * n + 1) * x * p[at] - n * p[at - 1]) / (n + 1);
  }
  return p;
}

// Integrals of P_0 .. P_(kStages - 1), stretched to [0, 1], from 0 to theta.
Eigen::Matrix<Real, kStages, 1> integrals(Real theta) {
  const Row p = legendre(2 * theta - 1);
  Eigen::Matrix<Real, kStages, 1> result;
  result[0] = theta;
  for (int k = 1; k < kStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    result[k] = (p[at + 1] - p[at - 1]) / (2 * (2 * static_cast<Real>(k) + 1));
  }
  return result;
}

struct Rule {
  std::array<Real, kStages> node;  // in [0, 1]
  Square coefficients;             // stage values times this: coefficients in Legendre polynomials
  Square integration;              // stage values times this: integrals from 0 to the nodes
};

Rule make_rule() {
  Rule rule{};
  Square sums;
  for (int i = 0; i < kStages; ++i) {
    // Newton's method from Chebyshev's points finds each zero of P_n.
    Real x = -std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(i) + 0.75L) / (kStages + 0.5L));
    Real slope = 0;
    for (int sweep = 0; sweep < 8; ++sweep) {
      const Row p = legendre(x);
      slope = kStages * (p[kStages - 1] - x * p[kStages]) / (1 - x * x);
      x -= p[kStages] / slope;
    }
    const Row p = legendre(x);
    const Real weight = 1 / ((1 - x * x) * slope * slope);  // of [0, 1]
    rule.node[static_cast<std::size_t>(i)] = (1 + x) / 2;
    for (int k = 0; k < kStages; ++k) {
      rule.coefficients(i, k) = (2 * static_cast<Real>(k) + 1) * weight * p[static_cast<std::size_t>(k)];
    }
    sums.col(i) = integrals((1 + x) / 2);
  }
  rule.integration = rule.coefficients * sums;
  return rule;
}

Real off(const Column& a, const Slice& b, const Column& scale) {
  return (a - b).cwiseQuotient(scale).cwiseAbs().maxCoeff();
}

const Rule& rule() {
  static const Rule kRule = make_rule();
  return kRule;
}

}  // namespace

GaussCollocation::GaussCollocation(Motion& motion, Column x, Column u, Real stop)
    : motion_(motion),
      stop_(stop),
      noise_(16 *
             (motion.evaluates_in_double() ? static_cast<Real>(std::numeric_limits<double>::epsilon()) : kRounding)),
      x_(std::move(x)),
      u_(std::move(u)),
      start_x_(x_),
      start_u_(u_),
      x_stage_(x_.size(), kStages),
      u_stage_(u_.size(), kStages),
      dx_(x_stage_),
      du_(u_stage_),
      dx_coefficients_(x_stage_),
      du_coefficients_(u_stage_),
      newest_(u_.size()),
      newest_rate_(x_.size()) {}

void GaussCollocation::set_scales() {
  const Scales& scales = motion_.scenario().scales;
  Real v = static_cast<Real>(scales.velocity()), w = 1 / static_cast<Real>(scales.time);
  for (Eigen::Index i = 0; i < motion_.moving(); ++i) {
    v = std::max(v, u_.segment<3>(6 * i).norm());
    w = std::max(w, u_.segment<3>(6 * i + 3).norm());
  }
  x_scale_.resize(x_.size());
  u_scale_.resize(u_.size());
  for (Eigen::Index i = 0; i < motion_.moving(); ++i) {
    x_scale_.segment<3>(7 * i).setConstant(static_cast<Real>(scales.length));
    x_scale_.segment<4>(7 * i + 3).setOnes();
    u_scale_.segment<3>(6 * i).setConstant(v);
    u_scale_.segment<3>(6 * i + 3).setConstant(w);
  }
}

// Stage values from the polynomials of the step before, or, at the start, from a constant field.
void GaussCollocation::guess(Real h) {
  if (kept_.empty()) {
    motion_.accelerations(t_, x_, u_, newest_);
    ++evaluations_;
    du_ = newest_.replicate<1, kStages>();
    Column rates(x_.size());
    motion_.rates(x_, u_, rates);
    dx_ = rates.replicate<1, kStages>();
  } else {
    const Step& before = kept_.back();
    Square values;
    for (int i = 0; i < kStages; ++i) {
      const Row p = legendre(1 + 2 * h * rule().node[static_cast<std::size_t>(i)] / before.h);
      for (int k = 0; k < kStages; ++k) values(k, i) = p[static_cast<std::size_t>(k)];
    }
    du_.noalias() = before.du * values;
    dx_.noalias() = before.dx * values;
  }
  const Square A = h * rule().integration;
  x_stage_.noalias() = dx_ * A;
  x_stage_.colwise() += x_;
  u_stage_.noalias() = du_ * A;
  u_stage_.colwise() += u_;
}

GaussCollocation::Attempt GaussCollocation::attempt(Real h) {
  const Square A = h * rule().integration;
  guess(h);
  Attempt result;
  Real change = std::numeric_limits<Real>::infinity();
  while (result.iterations < kMaxIterations) {
    ++result.iterations;
    const Real before = change;
    change = 0;
    for (int i = 0; i < kStages; ++i) {
      motion_.accelerations(t_ + h * rule().node[static_cast<std::size_t>(i)], x_stage_.col(i), u_stage_.col(i),
                            newest_);
      if (!newest_.allFinite()) return result;
      change = std::max(change, h * off(newest_, du_.col(i), u_scale_));
      du_.col(i) = newest_;
    }
    evaluations_ += kStages;
    u_stage_.noalias() = du_ * A;
    u_stage_.colwise() += u_;
    // Attitudes feed on themselves: a second sweep is cheap beside the accelerations.
    for (int sweep = 0; sweep < 2; ++sweep) {
      for (int i = 0; i < kStages; ++i) {
        motion_.rates(x_stage_.col(i), u_stage_.col(i), newest_rate_);
        change = std::max(change, h * off(newest_rate_, dx_.col(i), x_scale_));
        dx_.col(i) = newest_rate_;
      }
      x_stage_.noalias() = dx_ * A;
      x_stage_.colwise() += x_;
    }
    // Where the field's own rounding is larger than the last digit the changes stop falling.
    const bool stagnates = result.iterations > 2 && change > before / 4;
    if (change <= 2 * kRounding || (stagnates && change < 1e-14L)) {
      result.converged = true;
      break;
    }
    if (stagnates && change > 2 * before && change > 1e-6L) return result;  // it runs away
  }
  if (!result.converged) return result;
  dx_coefficients_.noalias() = dx_ * rule().coefficients;
  du_coefficients_.noalias() = du_ * rule().coefficients;
  result.error = truncation(h) / kTolerance;
  return result;
}

// What the first coefficient left out would be worth: it falls as those before it do.
Real GaussCollocation::truncation(Real h) const {
  const auto size = [&](int k) {
    return std::max(dx_coefficients_.col(k).cwiseQuotient(x_scale_).cwiseAbs().maxCoeff(),
                    du_coefficients_.col(k).cwiseQuotient(u_scale_).cwiseAbs().maxCoeff());
  };
  const Real last = std::max(size(kStages - 1), size(kStages - 2)),
             before = std::max(size(kStages - 3), size(kStages - 4));
  const Real worth = h / (2 * kStages);
  Real largest = size(0);
  for (int k = 1; k < kStages - 4; ++k) largest = std::max(largest, size(k));
  if (last <= noise_ * largest) return 0;  // nothing but rounding
  return worth * last * std::min<Real>(1, std::sqrt(last / before));
}

void GaussCollocation::advance() {
  set_scales();
  const Real time_scale = static_cast<Real>(motion_.scenario().scales.time);
  if (h_ == 0) h_ = 0.01L * std::min(time_scale, stop_ > 0 ? stop_ : time_scale);
  while (true) {
    const Real left = stop_ - t_;
    const Real h = left > 0 && h_ > left ? left : h_;
    if (!(h > 1e-18L * std::max(time_scale, t_))) {
      throw std::runtime_error("the integration cannot go on at t = " + std::to_string(static_cast<double>(t_)) +
                               " s: the motion is singular, stiff or not finite there");
    }
    const Attempt tried = attempt(h);
    if (!tried.converged) {
      h_ = h / 4;
      continue;
    }
    const Real wanted = 0.9L * std::pow(std::max<Real>(tried.error, 1e-12L), -1 / static_cast<Real>(kStages + 1));
    if (tried.error > 1) {
      h_ = h * std::clamp<Real>(wanted, 0.1L, 0.9L);
      continue;
    }
    const bool many = tried.iterations > kManyIterations;
    const Real next = h * std::clamp<Real>(wanted, 0.5L, many ? 0.8L : 2);
    // A step that was cut short by the stop must not make the next ones short.
    if (h == h_ || next > h_) h_ = next;
    const std::size_t bytes = static_cast<std::size_t>(x_.size() + u_.size()) * (kStages + 1) * sizeof(Real);
    if ((kept_.size() + 1) * bytes > kKeptBytes) kept_.clear();
    kept_.push_back({t_, h, x_, u_, dx_coefficients_, du_coefficients_});
    x_ += h * dx_coefficients_.col(0);
    u_ += h * du_coefficients_.col(0);
    motion_.project(x_, u_);
    t_ = h == left ? stop_ : t_ + h;
    ++steps_;
    return;
  }
}

void GaussCollocation::evaluate(const Step& step, Real t, Column& x, Column& u) const {
  const Eigen::Matrix<Real, kStages, 1> weights = step.h * integrals((t - step.t) / step.h);
  x = step.x;
  x.noalias() += step.dx * weights;
  u = step.u;
  u.noalias() += step.du * weights;
}

void GaussCollocation::read(Real t, Column& x, Column& u) {
  if (!(t >= 0)) throw std::runtime_error("a reference starts at t = 0");
  if (t < t_ && (kept_.empty() || t < kept_.front().t)) {
    kept_.clear();
    x_ = start_x_;
    u_ = start_u_;
    t_ = 0;
    h_ = 0;
  }
  while (t_ < t) advance();
  if (t == t_) {
    x = x_;
    u = u_;
    return;
  }
  const auto after = std::upper_bound(kept_.begin(), kept_.end(), t, [](Real a, const Step& s) { return a < s.t; });
  evaluate(*std::prev(after), t, x, u);
}

}  // namespace plumbline::extended
