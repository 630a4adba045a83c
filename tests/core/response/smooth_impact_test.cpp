// Frictionless impact in one point: the plane's formula, the tensor's, and the solver's answer.
#include "plumbline/core/response/smooth_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinetic_scenes.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

constexpr double kEps = std::numeric_limits<double>::epsilon();

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }

 private:
  std::mt19937_64 bits_;
};

// A box b x h in the x-z plane, turned by `tilt` about y, whose lowest corner touches z = 0.
Body tilted_box(double b, double h, double tilt, const Vec3& v_WB, double w_y) {
  Body box = solid("box", Box{Vec3(b, 0.7, h)}, 2, Vec3::Zero(), v_WB);
  box.initial.q_WB = rotation_by(Vec3(0, tilt, 0));
  box.initial.w_WB = Vec3(0, w_y, 0);
  box.initial.p_WB.z() = 0.5 * (b * std::abs(std::sin(tilt)) + h * std::abs(std::cos(tilt)));
  return box;
}

// The plane's formula, written with scalars: v_n at the corner, j = -(1+e) v_n / (1/m + (r x n)^2 / I), and w changes
// by (r x n) j / I, where r x n is along y.
TEST(SmoothImpact, OfAFallingBoxOnItsCornerIsThePlanesFormula) {
  const double b = 0.8, h = 0.5, m = 2, moment = m / 12 * (b * b + h * h), fall = 3, e = 0.4;
  for (double tilt = 0.05; tilt < 1.5; tilt += 0.1) {
    for (const double w : {0.0, 1.5, -2.0}) {
      const Body box = tilted_box(b, h, tilt, Vec3(0.3, 0, -fall), w);
      // A positive turn about y lowers the side of +x: the corner (b, -h)/2 is the lowest.
      const double x = 0.5 * (b * std::cos(tilt) - h * std::sin(tilt));
      const double v_n = -fall - w * x;  // (w x r).z = -w_y r_x
      const double j = v_n < 0 ? -(1 + e) * v_n / (1 / m + x * x / moment) : 0;

      // Through the simulator: at the start of a step without gravity the box touches, in two corners (along y).
      Scenario s = on_ground(box, e, 0, 1);
      s.gravity = Vec3::Zero();
      Simulator simulator(s, {Integrator::kSemiImplicitEuler, ImpactRule::kStepStart});
      simulator.step(1e-6);
      const BodyState& after = simulator.states()[1];
      EXPECT_NEAR(after.v_WB.z(), -fall + j / m, 1e-12) << tilt;
      EXPECT_NEAR(after.w_WB.y(), w - x * j / moment, 1e-11) << tilt;
      EXPECT_NEAR(after.v_WB.x(), 0.3, 1e-15);
      EXPECT_LT(std::hypot(after.w_WB.x(), after.w_WB.z()), 1e-11);

      // Through the closed form, in the middle of the edge that touches.
      Contact c{1, 0, Vec3(x, 0, 0), Vec3::UnitZ(), 0};
      std::vector<BodyState> states = {BodyState{}, box.initial};
      const Inertness inertness[] = {Inertness{}, inertness_of(box, box.initial.q_WB)};
      EXPECT_NEAR(apply_smooth_impact(c, e, inertness, states), j, 16 * kEps * 20);
      EXPECT_NEAR(states[1].v_WB.z(), after.v_WB.z(), 1e-12);
      EXPECT_NEAR(states[1].w_WB.y(), after.w_WB.y(), 1e-11);
    }
  }
}

struct Strike {
  Body bodies[2];
  std::vector<BodyState> states;
  Inertness inertness[2];
  Contact contact;
};

Strike random_strike(Random& random) {
  Strike s;
  for (Body& body : s.bodies) {
    body = solid("box", Box{Vec3(random.in(0.2, 1), random.in(0.2, 1), random.in(0.2, 1))}, random.in(0.5, 5),
                 random.vector(1), random.vector(2));
    body.initial.q_WB = rotation_by(random.vector(2));
    body.initial.w_WB = random.vector(2);
    s.states.push_back(body.initial);
  }
  for (int k = 0; k < 2; ++k) s.inertness[k] = inertness_of(s.bodies[k], s.states[static_cast<std::size_t>(k)].q_WB);
  s.contact = {0, 1, random.vector(0.5), (random.vector(1) + Vec3(0, 0, 1.1)).normalized(), 0};
  return s;
}

TEST(SmoothImpact, KeepsItsLawsAndIsTheSolversOnRandomBodies) {
  Random random(577);
  int hits = 0;
  for (int k = 0; k < 5000; ++k) {
    Strike s = random_strike(random);
    const double e = random.in(0, 1), u = approach_speed(s.contact, s.states);
    Scenario scenario;
    scenario.bodies = {s.bodies[0], s.bodies[1]};
    const double before = energy(scenario, s.states), mass = effective_mass(s.contact, s.inertness, s.states);
    const Vec3 p = momentum(scenario, s.states), l = angular_momentum(scenario, s.states);

    std::vector<BodyState> solved = s.states;
    const ImpactPoint point{s.contact, u > 0 ? e * u : 0, 0};
    const ImpulseReport report = apply_impulses({&point, 1}, s.inertness, solved);
    const double j = apply_smooth_impact(s.contact, e, s.inertness, s.states);
    hits += j > 0;

    // One direction, one unknown: a single correction of the solver is exact, up to rounding of turned inertias.
    const double left = 256 * kEps;
    ASSERT_NEAR(report.impulses_W[0].dot(s.contact.normal_W), j, left * (1 + j)) << k;
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_LT((solved[i].v_WB - s.states[i].v_WB).norm(), left * (1 + j) / s.bodies[i].mass) << k;
    }
    // Stronge 2000: restitution, the energy law with the effective mass, momentum.
    ASSERT_NEAR(-approach_speed(s.contact, s.states), u > 0 ? e * u : -u, left * (10 + j / mass)) << k;
    ASSERT_NEAR(before - energy(scenario, s.states), u > 0 ? 0.5 * (1 - e * e) * mass * u * u : 0, left * before) << k;
    ASSERT_LT((momentum(scenario, s.states) - p).norm(), left * (20 + j)) << k;
    ASSERT_LT((angular_momentum(scenario, s.states) - l).norm(), left * (40 + 2 * j)) << k;
  }
  EXPECT_GT(hits, 2000);
}

TEST(SmoothImpact, ThroughTheCentreIsSlide23) {
  const double m1 = 2, m2 = 3, e = 0.7, u = 4;
  Body a = solid("a", Box{Vec3(1, 1, 1)}, m1, Vec3(0, 0, 1), Vec3(0, 0, -u));
  Body b = solid("b", Box{Vec3(1, 1, 1)}, m2, Vec3::Zero(), Vec3::Zero());
  std::vector<BodyState> states = {a.initial, b.initial};
  const Inertness inertness[] = {inertness_of(a, Quat::Identity()), inertness_of(b, Quat::Identity())};
  const Contact c{0, 1, Vec3(0, 0, 0.5), Vec3::UnitZ(), 0};
  EXPECT_NEAR(apply_smooth_impact(c, e, inertness, states), (1 + e) * m1 * m2 / (m1 + m2) * u, 8 * kEps * 10);
}

TEST(SmoothImpact, RefusesWhatCannotCollide) {
  std::vector<BodyState> states(2);
  const Inertness fixed[2];
  EXPECT_THROW(apply_smooth_impact({0, 1, Vec3::Zero(), Vec3::UnitZ(), 0}, 0.5, fixed, states), std::invalid_argument);
  const Inertness moving[] = {{1, Mat3::Identity()}, {}};
  EXPECT_THROW(apply_smooth_impact({0, 1, Vec3::Zero(), Vec3::UnitZ(), 0}, 1.5, moving, states), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
