#include "plumbline/core/constraints/penalty_springs.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "particle_scenes.hpp"
#include "plumbline/core/constraints/chain.hpp"
#include "plumbline/core/constraints/coordinate_range.hpp"
#include "plumbline/core/constraints/link_constraint.hpp"

namespace plumbline {
namespace {

using namespace particles;
constexpr double kPi = std::numbers::pi;
constexpr double kG = 9.81;

// v += a dt, then x += v dt: the scheme whose limit the header derives.
class SemiImplicit : public Stepper {
 public:
  std::string_view name() const override { return "semi-implicit Euler"; }
  int order() const override { return 1; }
  void step(const AccelerationField& field, double t, double dt, std::span<BodyState> states) override {
    accelerations_.resize(states.size());
    field(t, states, accelerations_);
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].v_WB += dt * accelerations_[i].linear;
      states[i].p_WB += dt * states[i].v_WB;
    }
  }

 private:
  std::vector<Acceleration> accelerations_;
};

std::vector<BodyState> states_of(const Assembly& assembly) {
  std::vector<BodyState> states(assembly.p_W.size());
  for (std::size_t i = 0; i < states.size(); ++i) states[i].p_WB = assembly.p_W[i], states[i].v_WB = assembly.v_W[i];
  return states;
}

// Links along x of an assembly that is shaken along x: the largest stretch over that many steps, relative to the shake.
double growth(const Assembly& assembly, const PenaltySpring& spring, double dt, int steps) {
  constexpr double kShake = 1e-6;
  std::vector<BodyState> states = states_of(assembly);
  Random random(31);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (assembly.inverse_masses[i] > 0) states[i].p_WB.x() += random.in(-kShake, kShake);
  }
  const AccelerationField field = penalty_field(assembly.constraints, assembly.inverse_masses, Vec3::Zero(), spring);
  SemiImplicit stepper;
  double largest = 0;
  for (int k = 0; k < steps; ++k) {
    stepper.step(field, 0, dt, states);
    for (std::size_t i = 0; i < states.size(); ++i)
      largest = std::max(largest, std::abs(states[i].p_WB.x() - assembly.p_W[i].x()));
    if (!(largest < 1e-2)) break;  // links would turn over: it has diverged
  }
  return largest / kShake;
}

Assembly chain_along_x(std::size_t links, bool both_held) {
  return make_chain(row_of_points(Vec3::Zero(), Vec3(static_cast<double>(links), 0, 0), links), 0.5, both_held);
}

TEST(PenaltySprings, HaveTheFrequenciesOfAChain) {
  // k G W G^T is k/m times a tridiagonal matrix: 2 - 2 cos(theta) at most, theta = pi - pi/N with both ends held (no
  // particle is in the end links' way) and pi - 2 pi/(2N + 1) with one.
  const PenaltySpring spring{800, 0};
  for (const std::size_t links : {1u, 2u, 3u, 10u, 40u}) {
    const auto n = static_cast<double>(links);
    const double unit = 2 * std::sqrt(spring.stiffness / 0.5);
    const Assembly one = chain_along_x(links, false), both = chain_along_x(links, true);
    EXPECT_NEAR(largest_penalty_frequency(one.constraints, one.inverse_masses, one.p_W, spring),
                unit * std::cos(kPi / (2 * n + 1)), 1e-12 * unit);
    // At both ends held a single link has nothing to move; its frequency is the rounding of sqrt(0).
    EXPECT_NEAR(largest_penalty_frequency(both.constraints, both.inverse_masses, both.p_W, spring),
                unit * std::cos(kPi / (2 * n)), 1e-12 * unit);
  }
}

TEST(PenaltySprings, ExplodeJustAboveTheStableStepAndNotJustBelow) {
  // At dt = 2 (1 + epsilon)/w the growing root is -e^(2 sqrt(2 epsilon)): at epsilon = 1e-3 it grows by 9 % a step, 1e4
  // in 110 steps. Below, an undamped mode stays within 1/sqrt(1 - (w dt/2)^2) = 22 times its start, and the modes of a
  // chain of 10 (of which each has at most the shake) add to at most ten times that.
  for (const std::size_t links : {1u, 2u, 10u}) {
    for (const double zeta : {0.0, 0.1, 1.0}) {
      const Assembly chain = chain_along_x(links, false);
      PenaltySpring spring{800, 0};
      const double w = largest_penalty_frequency(chain.constraints, chain.inverse_masses, chain.p_W, spring);
      spring.damping = 2 * zeta * spring.stiffness / w;  // c = 2 zeta k/w
      const double limit = largest_stable_step(w, zeta);
      EXPECT_LT(growth(chain, spring, 0.999 * limit, 1000), 220) << links << " " << zeta;
      EXPECT_GT(growth(chain, spring, 1.001 * limit, 10000), 1e4) << links << " " << zeta;
    }
  }
}

TEST(PenaltySprings, StableStepIsWhereTheCharacteristicRootReachesMinusOne) {
  for (const double zeta : {0.0, 0.01, 0.5, 1.0, 30.0}) {
    const double wh = 7 * largest_stable_step(7, zeta);
    // z^2 - (2 - wh^2 - 2 zeta wh) z + 1 - 2 zeta wh at z = -1, relative to its largest term.
    EXPECT_NEAR((4 - wh * wh - 4 * zeta * wh) / 4, 0, 8 * kEps) << zeta;
  }
  EXPECT_THROW(largest_stable_step(0), std::invalid_argument);
}

TEST(PenaltySprings, HangTheWeightTooLowByWeightOverStiffness) {
  // Damped until it is at rest; links k of a chain carry the weight below.
  const PenaltySpring spring{2000, 20};
  Assembly chain = make_chain(row_of_points(Vec3::Zero(), Vec3(0, 0, -3), 3), 0.5);
  std::vector<BodyState> states = states_of(chain);
  const auto field = penalty_field(chain.constraints, chain.inverse_masses, Vec3(0, 0, -kG), spring);
  SemiImplicit stepper;
  // The slowest of the chain's modes has w^2 = 4 k/m sin^2(pi/14) and is damped like exp(-c w^2/(2 k) t): e^-39 after
  // 10 s.
  for (int k = 0; k < 10000; ++k) stepper.step(field, 0, 1e-3, states);
  for (std::size_t k = 0; k < 3; ++k) {
    const double stretch = (states[k + 1].p_WB - states[k].p_WB).norm() - 1;
    EXPECT_NEAR(stretch, static_cast<double>(3 - k) * 0.5 * kG / spring.stiffness, 1e-14) << k;  // roundings of 3 m
  }
}

TEST(PenaltySprings, KeepBothMomentaOfAFreeBody) {
  Assembly triangle;
  triangle.add_particle(1, Vec3(0, 0, 0), Vec3(1, 0, 2));
  triangle.add_particle(2, Vec3(1, 0, 0), Vec3(1, 2, 0));
  triangle.add_particle(3, Vec3(0, 1, 0), Vec3(0, 0, -1));
  triangle.constraints.add(LinkConstraint(0, 1, 1));
  triangle.constraints.add(LinkConstraint(1, 2, std::sqrt(2)));
  triangle.constraints.add(LinkConstraint(2, 0, 1));
  std::vector<BodyState> states = states_of(triangle);
  const auto field = penalty_field(triangle.constraints, triangle.inverse_masses, Vec3::Zero(), {1000, 5});
  const auto momenta = [&] {
    std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i < 3; ++i) {
      const double m = 1 / triangle.inverse_masses[i];
      sum.first += m * states[i].v_WB;
      sum.second += m * states[i].p_WB.cross(states[i].v_WB);
    }
    return sum;
  };
  const auto [p0, l0] = momenta();
  SemiImplicit stepper;
  for (int k = 0; k < 1000; ++k) stepper.step(field, 0, 1e-3, states);
  const auto [p1, l1] = momenta();
  // The forces are opposite and along the link, and semi-implicit Euler keeps linear and angular momentum exactly; a
  // thousand roundings of some 20 kg m^2/s.
  EXPECT_LE((p1 - p0).norm(), 1000 * 20 * kEps);
  EXPECT_LE((l1 - l0).norm(), 1000 * 20 * kEps);
}

TEST(PenaltySprings, PushOnlyWhileViolated) {
  ConstraintList floor;
  floor.add(CoordinateRange(0, Vec3::UnitZ(), 0, 1e9));
  const auto field = penalty_field(floor, {2.0}, Vec3(0, 0, -kG), {100, 3});
  std::vector<Acceleration> a(1);
  std::vector<BodyState> states(1);
  states[0].v_WB = Vec3(5, 0, -1);
  states[0].p_WB.z() = 0.1;
  field(0, states, a);
  EXPECT_EQ(a[0].linear, Vec3(0, 0, -kG));
  states[0].p_WB.z() = -0.1;
  field(0, states, a);
  EXPECT_LE((a[0].linear - Vec3(0, 0, -kG + 2 * (100 * 0.1 + 3 * 1))).norm(), 1e-14);
  EXPECT_THROW(penalty_field(floor, {1.0}, Vec3::Zero(), {-1, 0}), std::invalid_argument);
  a.resize(2);
  EXPECT_THROW(field(0, states, a), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
