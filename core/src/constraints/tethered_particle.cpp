#include "plumbline/core/constraints/tethered_particle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plumbline/core/constraints/first_crossing.hpp"

namespace plumbline {

namespace {

constexpr std::size_t kOrder = 24;
constexpr std::size_t kMostEvents = 100000;

// r(t) and lambda(t) of a taut string about now.
struct Swing {
  std::array<Vec3, kOrder + 1> r;         // [m/s^k]
  std::array<double, kOrder - 1> lambda;  // [1/s^(k+2)]
};

Swing taylor(const Vec3& r, const Vec3& v, const Vec3& g, double length) {
  Swing swing;
  swing.r[0] = r;
  swing.r[1] = v;
  const double constant = v.squaredNorm() - 2 * g.dot(r);
  for (std::size_t k = 0; k + 2 <= kOrder; ++k) {
    swing.lambda[k] = (3 * g.dot(swing.r[k]) + (k == 0 ? constant : 0)) / (length * length);
    Vec3 pull = Vec3::Zero();
    for (std::size_t j = 0; j <= k; ++j) pull += swing.lambda[j] * swing.r[k - j];
    const auto n = static_cast<double>(k);
    swing.r[k + 2] = ((k == 0 ? g : Vec3(Vec3::Zero())) - pull) / ((n + 1) * (n + 2));
  }
  return swing;
}

// The step at which the last two terms are e^-2 to the power of their order of the length, 1e-20 of it: the rest of the
// series is then far below rounding (Jorba and Zou, Experimental Mathematics 14 (2005) 99).
double step_of(const Swing& swing, double length) {
  double step = std::numeric_limits<double>::infinity();
  for (const std::size_t k : {kOrder - 1, kOrder}) {
    const double size = swing.r[k].norm();
    if (size > 0) step = std::min(step, std::exp(-2.0) * std::pow(length / size, 1 / static_cast<double>(k)));
  }
  return step;
}

// When lambda falls through zero, if it goes on below -rounding. A pendulum let go level with its anchor comes back
// with a tension that only touches zero, and rounding must not let it go slack there.
std::optional<double> slackening(const std::array<double, kOrder - 1>& lambda, double duration, double rounding) {
  auto raised = lambda;
  raised[0] += rounding;
  const auto surely = first_crossing(raised, duration);
  return surely ? first_crossing(lambda, *surely).value_or(*surely) : surely;
}

}  // namespace

TetheredParticle::TetheredParticle(const Tether& tether, const Vec3& gravity_W, const Vec3& p_W, const Vec3& v_W)
    : tether_(tether), now_{p_W, v_W, gravity_W} {
  if (!(tether.length > 0)) throw std::invalid_argument("a string needs a length > 0");
  if (!(tether.restitution >= 0 && tether.restitution <= 1))
    throw std::invalid_argument("a string's restitution must lie in 0..1");
  const double beyond = (p_W - tether.anchor_W).norm() / tether.length - 1;
  if (!(beyond <= 1e-12)) throw std::invalid_argument("a particle must start within its string's length");
  if (beyond < -1e-12) return;
  go_taut();
  if (v_W.dot(p_W - tether.anchor_W) <= 0) events_.clear();  // it was taut, it did not become so
}

double TetheredParticle::tautness() const {
  const Vec3 r = now_.p_W - tether_.anchor_W;
  return (now_.v_W.squaredNorm() + now_.a_W.dot(r)) / (tether_.length * tether_.length);
}

// A tension of zero, as of a pendulum that is let go level with its anchor, is decided by how it goes on: lambda' =
// 3 g.v/l^2, and if that is zero too lambda'' = 3 g^2/l^2.
bool TetheredParticle::pulls() const {
  const double lambda = tautness();
  return lambda > rounding() || (lambda >= -rounding() && now_.a_W.dot(now_.v_W) >= 0);
}

// Of lambda: a thousand roundings of what it is made of.
double TetheredParticle::rounding() const {
  const double l = tether_.length;
  return 2e-13 * (now_.a_W.norm() * l + now_.v_W.squaredNorm()) / (l * l);
}

double TetheredParticle::tension_per_mass() const { return taut_ ? tautness() * tether_.length : 0; }

// At the string's full length: what becomes of the speed along it, and does the string stay taut?
void TetheredParticle::go_taut() {
  const Vec3 out = (now_.p_W - tether_.anchor_W).normalized();
  now_.p_W = tether_.anchor_W + tether_.length * out;
  const double outward = out.dot(now_.v_W);
  const double slow = 1e-7 * std::sqrt(now_.a_W.norm() * tether_.length + now_.v_W.squaredNorm());
  zeros_at_start_ = 1;
  if (outward < -slow) return;  // on its way inwards already
  if (outward * tether_.restitution > slow) {
    now_.v_W = rebound(now_.v_W, -out, tether_.restitution);
    events_.push_back({TetherEvent::Kind::kBounce, time_});
    return;
  }
  now_.v_W -= outward * out;
  taut_ = pulls();
  // Without tension it is off along its parabola, at first along the sphere: a double zero of the quartic.
  zeros_at_start_ = 2;
  if (taut_ || outward > slow)
    events_.push_back({taut_ ? TetherEvent::Kind::kTaut : TetherEvent::Kind::kBounce, time_});
}

void TetheredParticle::fly_until(double time) {
  auto inside = distance_quartic(now_, tether_.anchor_W, tether_.length);
  for (double& c : inside) c = -c;
  // A flight that began on the sphere has zeros there that are known exactly: they are divided out.
  const auto from = static_cast<std::size_t>(zeros_at_start_);
  const std::span<const double> rest(inside.data() + from, inside.size() - from);
  const auto wait = first_crossing(rest, std::min(zeros_bound(rest), time - time_));
  const double duration = wait.value_or(time - time_);
  now_ = after(now_, duration);
  zeros_at_start_ = 0;
  if (!wait) {
    time_ = time;
    return;
  }
  time_ += duration;
  go_taut();
}

void TetheredParticle::swing_until(double time) {
  const Vec3 g = now_.a_W;
  const Swing swing = taylor(now_.p_W - tether_.anchor_W, now_.v_W, g, tether_.length);
  const double reach = step_of(swing, tether_.length);
  double duration = std::min(reach, time - time_);
  const auto slack = slackening(swing.lambda, duration, rounding());
  if (slack) duration = *slack;
  Vec3 r = Vec3::Zero(), v = Vec3::Zero();
  for (std::size_t k = kOrder + 1; k-- > 0;) r = r * duration + swing.r[k];
  for (std::size_t k = kOrder + 1; k-- > 1;) v = v * duration + static_cast<double>(k) * swing.r[k];
  // Rounding leaves the sphere by one digit a step: put back.
  r *= tether_.length / r.norm();
  v -= v.dot(r) / r.squaredNorm() * r;
  now_.p_W = tether_.anchor_W + r;
  now_.v_W = v;
  time_ = !slack && reach >= time - time_ ? time : time_ + duration;
  if (!slack) return;
  taut_ = false;
  zeros_at_start_ = 3;  // on the sphere, along it, and with no pull: value, slope and curvature vanish
  events_.push_back({TetherEvent::Kind::kSlack, time_});
}

void TetheredParticle::advance_to(double time) {
  if (!(time >= time_)) throw std::invalid_argument("a tethered particle only moves forward in time");
  while (time_ < time) {
    if (events_.size() > kMostEvents) throw std::runtime_error("a string bounced more than 100000 times");
    taut_ ? swing_until(time) : fly_until(time);
  }
}

}  // namespace plumbline
