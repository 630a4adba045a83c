// Bodies that rest on bodies: stacks, bridges, overhangs, weights handed down from interface to interface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum ImpactRule;

const Vec3 kCube(1, 1, 1);

Scenario on_the_ground(std::vector<Body> bodies, double restitution, double friction, double duration) {
  Scenario s = on_ground(ground(), restitution, friction, duration);
  s.bodies = {ground()};
  for (Body& b : bodies) s.bodies.push_back(std::move(b));
  return s;
}

Body cube(double mass, const Vec3& p_WB) { return solid("cube", Box{kCube}, mass, p_WB, Vec3::Zero()); }

Scenario stack(int n, double friction, double duration) {
  std::vector<Body> cubes;
  for (int k = 0; k < n; ++k) cubes.push_back(cube(1, Vec3(0, 0, 0.5 + k)));
  return on_the_ground(cubes, 0.4, friction, duration);
}

// How far any body ever strays from where it started [m], and how far any turns [rad].
double largest_drift(const Trajectory& path) {
  double drift = 0;
  for (std::size_t k = 0; k < path.samples(); ++k) {
    for (std::size_t i = 0; i < path.bodies(); ++i) {
      drift = std::max({drift, (path.at(k, i).p_WB - path.at(0, i).p_WB).norm(),
                        geodesic_angle(path.at(k, i).q_WB, path.at(0, i).q_WB)});
    }
  }
  return drift;
}

// The impulses of one step of dt as the simulator finds them: free velocities, touching points, nothing rebounds.
// Summed over the points between each pair of bodies, along z on the upper one, per dt [N].
std::map<std::pair<std::size_t, std::size_t>, double> loads(const Scenario& s, std::span<const BodyState> at) {
  const double dt = 1.0 / 60;
  std::vector<BodyState> states(at.begin(), at.end());
  std::vector<Inertness> inertness;
  for (std::size_t i = 0; i < states.size(); ++i) {
    inertness.push_back(inertness_of(s.bodies[i], states[i].q_WB));
    if (!s.bodies[i].fixed) states[i].v_WB += s.gravity * dt;
  }
  std::vector<ImpactPoint> points;
  for (const Pair pair : contact_pairs(s.bodies)) {
    std::vector<Contact> contacts;
    append_contacts(s.bodies, states, pair, contacts);
    for (const Contact& c : contacts) {
      if (c.gap < 1e-9) points.push_back({c, 0, s.contact->friction});
    }
  }
  const ImpulseReport report = apply_impulses(points, inertness, states);
  EXPECT_TRUE(report.converged);
  std::map<std::pair<std::size_t, std::size_t>, double> result;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Contact& c = points[k].contact;
    const bool a_is_low = c.normal_W.z() < 0;
    const auto key = a_is_low ? std::pair{c.body_a, c.body_b} : std::pair{c.body_b, c.body_a};
    result[key] += (a_is_low ? -1 : 1) * report.impulses_W[k].z() / dt;
  }
  return result;
}

// Impulses are found to 1e-14 of the largest, which is the weight of the whole stack over a step: ten cubes keep
// 1e-14 * 10 g dt = 2e-14 m/s at most, and as every step starts anew from that, no more than 2e-13 m in 10 s.
// Positions of 10 m round to 2e-15 m and make tilts of as much; 1e-12 leaves room for both.
TEST(Stack, StandsForTenSecondsWithoutDrift) {
  for (const int n : {1, 2, 5, 10}) {
    for (const double mu : {0.0, 0.5}) {
      for (const Scheme scheme : {Scheme{kSemiImplicitEuler, kExactTime}, Scheme{kVelocityVerlet, kExactTime},
                                  Scheme{kExplicitEuler, kExactTime}, Scheme{kSemiImplicitEuler, kStepStart}}) {
        if (n > 2 && (scheme != Scheme{} || mu == 0)) continue;  // the same again, and slow
        const double drift = largest_drift(simulate(stack(n, mu, 10), scheme, 1.0 / 60));
        EXPECT_LT(drift, 1e-12) << n << " cubes, mu " << mu << ", " << name(scheme);
        if (scheme == Scheme{}) RecordProperty("drift_of_" + std::to_string(n), std::to_string(drift * 1e15) + "e-15");
      }
    }
  }
}

TEST(Stack, HandsItsWeightDown) {
  for (const int n : {1, 2, 5, 10}) {
    const Scenario s = stack(n, 0.5, 1);
    const Trajectory path = simulate(s, {}, 1.0 / 60);
    const std::size_t bodies = s.bodies.size();
    const auto load = loads(s, path.states().subspan((path.samples() - 1) * bodies, bodies));
    ASSERT_EQ(load.size(), static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {  // the k-th interface from below carries what is above it
      const auto low = static_cast<std::size_t>(k);
      EXPECT_NEAR(load.at({low, low + 1}), (n - k) * kG, 1e-12 * n * kG) << k << " of " << n;
    }
  }
}

// A mass ratio of 1000 both ways round. The impulses follow the heavy body, 1e-14 of which moves the light one by
// 1000 times as much: 1e-14 * 1000 g dt = 2e-12 m/s, or 2e-11 m in 10 s.
TEST(Stack, BearsAMassRatioOfAThousand) {
  for (const double low : {1.0, 1000.0}) {
    const double high = 1000 / low;
    const Scenario s = on_the_ground({cube(low, Vec3(0, 0, 0.5)), cube(high, Vec3(0, 0, 1.5))}, 0.4, 0.5, 10);
    const Trajectory path = simulate(s, {}, 1.0 / 60);
    EXPECT_LT(largest_drift(path), 2e-11) << low;
    const auto load = loads(s, path.states().subspan((path.samples() - 1) * 3, 3));
    EXPECT_NEAR(load.at({1, 2}), high * kG, 1e-12 * 1001 * kG);
    EXPECT_NEAR(load.at({0, 1}), 1001 * kG, 1e-12 * 1001 * kG);
  }
}

TEST(Stack, CarriesASphere) {
  const Scenario s =
      on_the_ground({cube(2, Vec3(0, 0, 0.5)), ball("ball", 0.3, 1, Vec3(0.1, -0.2, 1.3), Vec3::Zero())}, 0.4, 0.5, 10);
  for (const Scheme& scheme : candidate_schemes(s)) {
    const Trajectory path = simulate(s, scheme, 1.0 / 60);
    EXPECT_LT(largest_drift(path), 1e-12) << name(scheme);
    const auto load = loads(s, path.states().subspan((path.samples() - 1) * 3, 3));
    EXPECT_NEAR(load.at({1, 2}), kG, 1e-12 * kG);
    EXPECT_NEAR(load.at({0, 1}), 3 * kG, 3e-12 * kG);
  }
}

// The numbers in impulse.hpp: sweeps alone against sweeps with leaps, and both the same where both converge.
TEST(Stack, SettlesInAFewSweepsWithLeaps) {
  for (const int n : {2, 5, 10}) {
    const Scenario s = stack(n, 0.5, 1);
    std::vector<BodyState> start;
    std::vector<Inertness> inertness;
    std::vector<ImpactPoint> points;
    for (const Body& b : s.bodies) {
      start.push_back(b.initial);
      inertness.push_back(inertness_of(b, b.initial.q_WB));
      if (!b.fixed) start.back().v_WB = Vec3(0.01, 0, -kG / 60);
    }
    std::vector<Contact> contacts;
    for (const Pair pair : contact_pairs(s.bodies)) append_contacts(s.bodies, start, pair, contacts);
    for (const Contact& c : contacts) {
      if (c.gap < 1e-9) points.push_back({c, 0, 0.5});
    }
    std::vector<BodyState> swept = start, leapt = start;
    const ImpulseReport slow = apply_impulses(points, inertness, swept, Leaps::kNever);
    const ImpulseReport fast = apply_impulses(points, inertness, leapt);
    EXPECT_TRUE(fast.converged);
    EXPECT_LE(fast.sweeps, 24) << n;
    EXPECT_EQ(slow.converged, n == 2) << n;
    double apart = 0;
    for (std::size_t i = 0; i < start.size(); ++i) apart = std::max(apart, (swept[i].v_WB - leapt[i].v_WB).norm());
    if (slow.converged) {
      EXPECT_LT(apart, 1e-13) << n;
    } else {
      EXPECT_GT(apart, 1e-6) << n;
    }
    for (const BodyState& b : leapt) EXPECT_LT(b.v_WB.norm() + b.w_WB.norm(), 1e-13) << n;
  }
}

// A plank across two pillars, on each with the point where they meet at its end: the lever shares its weight. The plank
// rests on the pillars' inner parts, so that only its whole balance is known: both forces together, and the moment.
TEST(Stack, BridgesTwoPillars) {
  Body plank = solid("plank", Box{Vec3(4, 1, 0.2)}, 3, Vec3(0.3, 0, 1.1), Vec3::Zero());
  const Scenario s = on_the_ground({cube(1, Vec3(-1.5, 0, 0.5)), cube(1, Vec3(1.5, 0, 0.5)), plank}, 0, 0.5, 10);
  const Trajectory path = simulate(s, {}, 1.0 / 60);
  EXPECT_LT(largest_drift(path), 1e-12);
  const auto load = loads(s, path.states().subspan((path.samples() - 1) * 4, 4));
  const double left = load.at({1, 3}), right = load.at({2, 3});
  EXPECT_NEAR(left + right, 3 * kG, 3e-12 * kG);
  EXPECT_NEAR(load.at({0, 1}), left + kG, 3e-12 * kG);
  EXPECT_NEAR(load.at({0, 2}), right + kG, 3e-12 * kG);
  // About x = 0.3 each pillar's force acts somewhere on its top: [-1.7, -1] on the left, [1, 2] on the right, less 0.3.
  EXPECT_GE(left / right, (1 - 0.3) / (1.7 + 0.3));
  EXPECT_LE(left / right, (2 - 0.3) / (1 + 0.3));
}

// A cube upon a cube stays as long as its centre is above the lower one.
TEST(Stack, OverhangsUpToHalfACube) {
  for (const double overhang : {0.0, 0.3, 0.499, 0.501, 0.6}) {
    const Scenario s = on_the_ground({cube(1000, Vec3(0, 0, 0.5)), cube(1, Vec3(overhang, 0, 1.5))}, 0, 0.5, 1);
    const Trajectory path = simulate(s, {}, 1.0 / 240);
    if (overhang < 0.5) {
      EXPECT_LT(largest_drift(path), 1e-11) << overhang;
    } else {
      EXPECT_GT(geodesic_angle(path.at(path.samples() - 1, 2).q_WB, Quat::Identity()), 0.01) << overhang;
    }
  }
}

Trajectory falling_pair(double restitution, Integrator integrator, double dt) {
  return simulate(on_the_ground({cube(1, Vec3(0, 0, 0.55)), cube(1, Vec3(0.1, 0.05, 1.6))}, restitution, 0.5, 1.25),
                  {integrator, kExactTime}, dt);
}

// Dropped with air between: an impact each, for e = 0.3 rocking too, and at last a stack. Touching means 1e-10 of the
// sizes of both: 3.5e-10 m for cubes; Verlet may leave the corners of either interface that much apart or overlapping.
TEST(Stack, FormsFromFallingCubes) {
  for (const double e : {0.0, 0.3}) {
    for (const Integrator integrator : {kSemiImplicitEuler, kVelocityVerlet}) {
      if (e > 0 && integrator != kVelocityVerlet) continue;  // below
      const Trajectory path = falling_pair(e, integrator, 1.0 / 120);
      for (std::size_t i = 1; i < 3; ++i) {
        const BodyState& end = path.at(path.samples() - 1, i);
        EXPECT_NEAR(end.p_WB.z(), static_cast<double>(i) - 0.5, 3.5e-10 * static_cast<double>(i)) << i << ", e " << e;
        EXPECT_LT(end.v_WB.norm() + end.w_WB.norm(), 1e-12) << i << ", e " << e;
      }
    }
  }
}

// Semi-implicit Euler gives all of a step's gravity at its start, so that corners on their way hit with g dt more than
// they should, and rebound with e times that: two cubes go on rocking for seconds, by less than g dt^2 and 2 g dt.
TEST(Stack, RocksWithinOneStepOfFallUnderSemiImplicitEuler) {
  for (const double dt : {1.0 / 60, 1.0 / 120}) {
    const Trajectory path = falling_pair(0.3, kSemiImplicitEuler, dt);
    for (std::size_t k = path.samples() / 2; k < path.samples(); ++k) {
      for (std::size_t i = 1; i < 3; ++i) {
        ASSERT_NEAR(path.at(k, i).p_WB.z(), static_cast<double>(i) - 0.5, kG * dt * dt * static_cast<double>(i));
        ASSERT_LT(path.at(k, i).v_WB.norm() + path.at(k, i).w_WB.norm(), 2 * kG * dt);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline
