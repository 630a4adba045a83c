// The four ways to treat the gyroscopic term, against what they promise and against published drifts.
#include "plumbline/core/kinetics/gyroscopic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinetic_scenes.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/simulator.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum GyroscopicTerm;

constexpr double kEps = std::numeric_limits<double>::epsilon();

// The free-rotation benchmark of the Open Source Robotics Foundation (S. Peters, J. Hsu, "Comparison of rigid body
// dynamic simulators for robotic simulation in Gazebo", 2014): a thrown and tumbling plank.
Scenario plank() {
  Body box = solid("plank", Box{Vec3(0.1, 0.4, 0.9)}, 10, Vec3::Zero(), Vec3(-2, 2, 8));
  box.initial.w_WB = Vec3(0.1, 5, 0.1);
  return free_flight(box, Vec3(0, 0, -9.8), 10);
}

struct Drift {
  double angular_momentum = 0, energy = 0;  // largest over time, relative
};

// Angular momentum about the centre of mass; energy with that of translation and height.
Drift drift(const Scenario& s, const Trajectory& path) {
  const auto spin = [&](std::size_t k) {
    BodyState turning = path.at(k, 0);
    turning.p_WB.setZero();
    return angular_momentum(s, {&turning, 1});
  };
  const double start = energy(s, path.states().first(1));
  Drift result;
  for (std::size_t k = 0; k < path.samples(); ++k) {
    result.angular_momentum = max_or_nan(result.angular_momentum, (spin(k) - spin(0)).norm() / spin(0).norm());
    result.energy = max_or_nan(result.energy, std::abs(energy(s, path.states().subspan(k, 1)) / start - 1));
  }
  return result;
}

struct Published {
  GyroscopicTerm term;
  int substeps;
  double angular_momentum, energy;
};

// The implicit row agrees to all printed digits. The engines of the explicit rows advance the attitude by q += w q h/2
// and a normalisation, which turns by w h (1 - (w h)^2/12): 2e-6 less at w h = 0.005, and what that shifts grows
// tenfold with each of the three flips of an unstable axis before the largest drift is reached. So 2e-3 at most; seen
// is 7e-5.
TEST(GyroscopicTerm, ReproducesPublishedDriftsOfThreeEngines) {
  const Published rows[] = {
      {kExplicit, 1, 0.0130708, 0.012462},     // ODE
      {kImplicit, 1, 0.0124501, 0.0135771},    // Bullet
      {kExplicit, 2, 0.00643471, 0.00623355},  // Simbody: half the step of the first row
  };
  for (const Published& row : rows) {
    const Scheme scheme{kSemiImplicitEuler, ImpactRule::kExactTime, row.term, ForceSampling::kHeld, row.substeps};
    const Drift seen = drift(plank(), simulate(plank(), scheme, 1e-3));
    const double tolerance = row.term == kImplicit ? 1e-5 : 2e-3;
    EXPECT_NEAR(seen.angular_momentum / row.angular_momentum, 1, tolerance) << name(scheme);
    EXPECT_NEAR(seen.energy / row.energy, 1, tolerance) << name(scheme);
  }
}

TEST(GyroscopicTerm, ExplicitGainsEnergyAndImplicitLosesIt) {
  Body box = solid("box", Box{Vec3(0.1, 0.4, 0.9)}, 10, Vec3::Zero(), Vec3::Zero());
  const Vec3 inertia = box.inertia;
  const auto rotational = [&](const Vec3& w) { return 0.5 * w.dot(inertia.cwiseProduct(w)); };
  std::mt19937_64 bits(7);
  const auto uniform = [&] { return 2 * static_cast<double>(bits() >> 11) * 0x1p-53 - 1; };
  for (int k = 0; k < 1000; ++k) {
    const Vec3 w = 20 * Vec3(uniform(), uniform(), uniform());
    const double before = rotational(w);
    EXPECT_GT(rotational(gyroscopic_step(kExplicit, inertia, w, 0.01)), before);
    EXPECT_LT(rotational(gyroscopic_step(kImplicit, inertia, w, 0.01)), before);
    EXPECT_EQ(gyroscopic_step(kNone, inertia, w, 0.01), w);
    EXPECT_NEAR(rotational(gyroscopic_step(kExact, inertia, w, 0.01)) / before, 1, 32 * kEps);
  }
}

// All of them but none solve the same equation: they differ from the exact rotation by their order of one step, 2.
TEST(GyroscopicTerm, ConvergesToEulersEquation) {
  const Vec3 inertia(0.81, 0.68, 0.14), w(1, -2, 3);
  for (const GyroscopicTerm term : {kExplicit, kImplicit}) {
    const auto error = [&](double h) {
      return (gyroscopic_step(term, inertia, w, h) - gyroscopic_step(kExact, inertia, w, h)).norm();
    };
    EXPECT_NEAR(std::log2(error(1e-3) / error(5e-4)), 2, 0.05);
  }
}

TEST(GyroscopicTerm, NoneLetsAngularMomentumTurnWithTheBody) {
  // Slide 6's M = I alpha taken literally: with no torque w stays, and L = R I R^T w swings with the body.
  const Drift slide = drift(plank(), simulate(plank(), {kSemiImplicitEuler, ImpactRule::kExactTime, kNone}, 1e-3));
  const Drift exact = drift(plank(), simulate(plank(), {kSemiImplicitEuler, ImpactRule::kExactTime, kExact}, 1e-3));
  EXPECT_GT(slide.angular_momentum, 0.02);
  EXPECT_LT(exact.angular_momentum, 10000 * 4 * kEps);  // one rotation into the body and out of it each step
}

// Whatever the step, the attitude after 10 s is the same, to what the motion makes of rounding. Each piece of a quarter
// radian changes energy and angular momentum by at most 4 eps; 200 pieces shift the modulus k'^2 = 1.4e-4 of the
// elliptic functions by 200 * 4 eps/k'^2 = 1.3e-9 of itself, and with it each of the 7 quarter periods by half of that
// over lambda = 3.85 1/s. At 13 rad/s^2 that makes 1.5e-8 rad/s.
TEST(GyroscopicTerm, ExactFreeRotationDoesNotDependOnTheStep) {
  const Scheme scheme{kSemiImplicitEuler, ImpactRule::kExactTime, kExact};
  const Trajectory coarse = simulate(plank(), scheme, 0.1), fine = simulate(plank(), scheme, 0.05);
  const BodyState &a = coarse.at(100, 0), &b = fine.at(200, 0);
  EXPECT_LT(geodesic_angle(a.q_WB, b.q_WB), 1.5e-8);
  EXPECT_LT((a.w_WB - b.w_WB).norm(), 1.5e-8);
}

TEST(GyroscopicTerm, ExactFreeRotationDoesNotAskForTheImpactRule) {
  const Trajectory a = simulate(plank(), {kSemiImplicitEuler, ImpactRule::kExactTime, kExact}, 0.1);
  const Trajectory b = simulate(plank(), {kSemiImplicitEuler, ImpactRule::kStepStart, kExact}, 0.1);
  EXPECT_EQ(a.at(100, 0).q_WB.coeffs(), b.at(100, 0).q_WB.coeffs());
}

// The published attitude of the same box after 1 s is of scenario R3; here the flip interval is enough: w_y changes
// sign at 1.165960046 s, which is a zero of the Jacobi function sn.
TEST(GyroscopicTerm, ExactFreeRotationFlipsWhenTheEllipticFunctionSays) {
  Scenario s = plank();
  const auto w_y = [&](double t) {
    BodyState state = s.bodies[0].initial;
    turn_freely(s.bodies[0].inertia, t, state);
    return (state.q_WB.conjugate() * state.w_WB).y();
  };
  double early = 1.1, late = 1.2;
  ASSERT_LT(w_y(late) * w_y(early), 0);
  for (int k = 0; k < 60; ++k) (w_y(0.5 * (early + late)) * w_y(early) > 0 ? early : late) = 0.5 * (early + late);
  EXPECT_NEAR(early, 1.165960046, 5e-10);  // published to nine decimals
}

TEST(GyroscopicTerm, KeepsNanAndBodiesThatDoNotTurn) {
  BodyState state;
  state.w_WB = Vec3(std::nan(""), 0, 0);
  turn_freely(Vec3(1, 2, 3), 0.1, state);
  EXPECT_FALSE(is_finite(state));
  const Vec3 w(0, 0, 3), planar(0, 0, 2);
  for (const GyroscopicTerm term : {kExplicit, kNone, kImplicit, kExact}) {
    EXPECT_LT((gyroscopic_step(term, planar, w, 0.1) - w).norm(), 4 * kEps);
  }
}

}  // namespace
}  // namespace plumbline
