#include "plumbline/core/constraints/constraint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline {

namespace {

constexpr int kMostIterations = 300;

// The particles displaced by d.
PerParticle displaced(std::span<const Vec3> p_W, const PerParticle& d_W) {
  PerParticle result = d_W;
  for (std::size_t i = 0; i < p_W.size(); ++i) result[i] += p_W[i];
  return result;
}

// How well q can be known at all: each coordinate is rounded, and q follows it by its gradient.
double rounding(const PerParticle& gradient, std::span<const Vec3> p_W) {
  double sum = 0;
  for (std::size_t i = 0; i < p_W.size(); ++i) sum += gradient[i].norm() * p_W[i].norm();
  return 2 * std::numeric_limits<double>::epsilon() * sum;
}

// sum w_i a_i . b_i
double weighted(const PerParticle& a, const PerParticle& b, std::span<const double> w) {
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * a[i].dot(b[i]);
  return sum;
}

double cost(const PerParticle& d_W, std::span<const double> w) {
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (w[i] > 0) sum += d_W[i].squaredNorm() / w[i];
  }
  return sum;
}

// From a motion that meets the constraint to the smallest one that does: d -> -lambda W g(p + d) with the lambda for
// which the linearised constraint holds, until d repeats itself. Its fixed points are Lagrange's condition. Where q is
// curved so strongly that d would swing about its end, only a share of each change is made; near a minimum a small
// enough share always converges, since the eigenvalues of the map are real and below 1 there (second-order condition).
MinimalMotion shortened(const Constraint& constraint, double bound, const MinimalMotion& found,
                        std::span<const Vec3> p_W, std::span<const double> w) {
  const double lightest = *std::max_element(w.begin(), w.end());
  MinimalMotion motion = found, next;
  PerParticle change, before = motion.d_W;
  double share = 1;
  for (int k = 0; k < kMostIterations; ++k) {
    const PerParticle at = displaced(p_W, motion.d_W);
    const std::span<const Vec3> end(at.data(), p_W.size());
    const PerParticle g = constraint.gradient(end);
    const double leverage = weighted(g, g, w);
    if (!(leverage > 0)) return found;
    double along = 0;
    for (std::size_t i = 0; i < p_W.size(); ++i) along += g[i].dot(motion.d_W[i]);
    next.multiplier = (constraint.quantity(end) - bound - along) / leverage;
    double largest = 0, turned = 0, turn = 0;
    for (std::size_t i = 0; i < p_W.size(); ++i) {
      next.d_W[i] = -next.multiplier * w[i] * g[i];
      change[i] = next.d_W[i] - motion.d_W[i];
      largest = std::max(largest, change[i].norm());
      turned += before[i].dot(change[i] - before[i]);
      turn += (change[i] - before[i]).squaredNorm();
    }
    if (largest <= 1e-15 * std::sqrt(cost(next.d_W, w) * lightest)) break;
    if (k > 0 && turn > 0) share = std::clamp(-share * turned / turn, 0.02, 1.0);
    before = change;
    for (std::size_t i = 0; i < p_W.size(); ++i) motion.d_W[i] += share * change[i];
  }
  // Far from the constraint the repetition may wander off; then the first motion is kept.
  const PerParticle at = displaced(p_W, next.d_W);
  const std::span<const Vec3> end(at.data(), p_W.size());
  const bool met = std::abs(constraint.quantity(end) - bound) <= 4 * rounding(constraint.gradient(end), end);
  return met && cost(next.d_W, w) <= cost(found.d_W, w) * (1 + 1e-14) ? next : found;
}

}  // namespace

Constraint::Constraint(std::initializer_list<std::size_t> particles, double low, double high)
    : count_(particles.size()), low_(low), high_(high) {
  if (count_ == 0 || count_ > kMostParticles)
    throw std::invalid_argument("a constraint holds 1 to 3 particles: make several of it");
  if (!(low <= high)) throw std::invalid_argument("a constraint needs a range with low <= high: exchange the two");
  std::copy(particles.begin(), particles.end(), particles_.begin());
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (particles_[i] == particles_[j])
        throw std::invalid_argument("a constraint names particle " + std::to_string(particles_[i]) +
                                    " twice: its particles must differ");
    }
  }
}

double Constraint::violation(std::span<const Vec3> p_W) const {
  const double q = quantity(p_W);
  if (q < low_) return q - low_;
  if (q > high_) return q - high_;
  return q - q;  // 0, or NaN
}

MinimalMotion Constraint::minimal_motion(std::span<const Vec3> p_W, std::span<const double> inverse_masses) const {
  MinimalMotion motion;
  double excess = violation(p_W);
  if (excess == 0) return motion;
  const double bound = quantity(p_W) - excess;
  for (int k = 0; k < kMostIterations && excess != 0; ++k) {
    const PerParticle at = displaced(p_W, motion.d_W);
    const PerParticle g = gradient({at.data(), p_W.size()});
    const double leverage = weighted(g, g, inverse_masses);
    if (leverage == 0) return {};
    if (k > 0 && std::abs(excess) <= rounding(g, p_W)) break;
    const double lambda = excess / leverage;
    for (std::size_t i = 0; i < p_W.size(); ++i) motion.d_W[i] -= lambda * inverse_masses[i] * g[i];
    motion.multiplier += lambda;
    const PerParticle end = displaced(p_W, motion.d_W);
    excess = quantity({end.data(), p_W.size()}) - bound;
  }
  return shortened(*this, bound, motion, p_W, inverse_masses);
}

MinimalMotion motion_along(const Constraint& constraint, const PerParticle& direction, std::span<const Vec3> p_W,
                           std::span<const double> inverse_masses) {
  MinimalMotion motion;
  double excess = constraint.violation(p_W);
  const double bound = constraint.quantity(p_W) - excess;
  for (int k = 0; k < kMostIterations && excess != 0; ++k) {
    const PerParticle at = displaced(p_W, motion.d_W);
    const PerParticle g = constraint.gradient({at.data(), p_W.size()});
    const double leverage = weighted(g, direction, inverse_masses);
    if (leverage == 0) return {};
    if (k > 0 && std::abs(excess) <= rounding(g, p_W)) break;
    motion.multiplier += excess / leverage;
    for (std::size_t i = 0; i < p_W.size(); ++i) motion.d_W[i] = -motion.multiplier * inverse_masses[i] * direction[i];
    const PerParticle end = displaced(p_W, motion.d_W);
    excess = constraint.quantity({end.data(), p_W.size()}) - bound;
  }
  return motion;
}

}  // namespace plumbline
