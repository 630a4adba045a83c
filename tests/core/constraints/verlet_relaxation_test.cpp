#include "plumbline/core/constraints/verlet_relaxation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "particle_scenes.hpp"
#include "plumbline/core/constraints/chain.hpp"
#include "plumbline/core/constraints/link_constraint.hpp"

namespace plumbline {
namespace {

using namespace particles;
constexpr double kG = 9.81;

VerletOptions options_of(Pull pull, const Vec3& gravity_W = Vec3(0, 0, -kG), double tolerance = 1e-14,
                         int sweeps = 2000) {
  VerletOptions options;
  options.gravity_W = gravity_W;
  options.pull = pull;
  options.relaxation.sweeps = sweeps;
  options.relaxation.tolerance = tolerance;
  return options;
}

// Where the cubic through four equidistant samples has its zero between the second and third, in steps from the second.
// The samples of a smooth curve leave an error of fourth order.
double crossing(const std::array<double, 4>& y) {
  double t = y[1] / (y[1] - y[2]);
  const double d1 = y[2] - y[1], d2 = y[2] - 2 * y[1] + y[0], d3 = y[3] - 3 * y[2] + 3 * y[1] - y[0];
  for (int k = 0; k < 50; ++k) {
    const double f = y[1] + t * d1 + t * (t - 1) / 2 * d2 + (t + 1) * t * (t - 1) / 6 * d3;
    t -= f / (d1 + (t - 0.5) * d2 + (3 * t * t - 1) / 6 * d3);
  }
  return t;
}

// Times at which a coordinate of a particle changes sign.
template <class Coordinate>
std::vector<double> crossings(VerletRelaxation& run, double dt, std::size_t count, const Coordinate& coordinate) {
  std::array<double, 4> y{};
  std::vector<double> times;
  for (int k = 0; times.size() < count && k < 10000000; ++k) {
    y = {y[1], y[2], y[3], coordinate(run.positions())};
    if (k >= 3 && y[1] * y[2] < 0) times.push_back((k - 2 + crossing(y)) * dt);
    run.step();
  }
  return times;
}

// A pendulum of 1 m let go level with its pivot: T = 4 K(1/sqrt(2)) sqrt(l/g).
TEST(RelaxedPendulum, HasTheExactPeriodInTheOrderOfItsPull) {
  const double exact = 4 * std::comp_ellint_1(std::sqrt(0.5)) / std::sqrt(kG);
  ASSERT_NEAR(exact, 2.367841947576, 5e-13);  // published: IFToMM benchmark A01
  for (const Pull pull : {Pull::kMinimal, Pull::kStart}) {
    std::vector<double> errors;
    for (const double dt : {0.001, 0.0005, 0.00025, 0.000125}) {
      Assembly pendulum = make_chain(std::vector<Vec3>{Vec3::Zero(), Vec3(-1, 0, 0)}, 1);
      VerletRelaxation run(pendulum, dt, options_of(pull, Vec3(0, 0, -kG), 0, 5));
      const auto times = crossings(run, dt, 3, [](std::span<const Vec3> p) { return p[1].x(); });
      ASSERT_EQ(times.size(), 3u);
      errors.push_back(std::abs(times[2] - times[0] - exact));
    }
    // The slide's pull is damped in first order and swings less wide, so faster; SHAKE's is of second order.
    const double order = pull == Pull::kMinimal ? 1 : 2;
    EXPECT_NEAR(observed_order(errors), order, 0.05);
    const std::string name = pull == Pull::kMinimal ? "minimal" : "start";
    RecordProperty(name + "_error", measured(errors.back()));
    RecordProperty(name + "_order", measured(observed_order(errors)));
  }
}

TEST(RelaxedPendulum, OfSmallSwingsIsImplicitEulerOrVerletAsDerived) {
  // z = 1/(1 -+ i w h) for the slide's pull, e^{+-i phi} with sin(phi/2) = w h/2 for SHAKE's. The swing of 1e-4 rad
  // makes the pendulum linear to (1e-4)^2/16 in frequency; over these 100 crossings the angle of rotation of a step is
  // found to that, and the amplitude as well.
  const double length = 1, w = std::sqrt(kG / length), h = 0.05, a = 1e-4;
  for (const Pull pull : {Pull::kMinimal, Pull::kStart}) {
    const Vec3 start(length * std::sin(a), 0, -length * std::cos(a));
    Assembly pendulum = make_chain(std::vector<Vec3>{Vec3::Zero(), start}, 1);
    VerletRelaxation run(pendulum, h, options_of(pull, Vec3(0, 0, -kG), 0, 5));
    // x_n+1 - 2 cos(phi) r x_n + r^2 x_n-1 = 0: cos(phi) r and r^2 by least squares from the run.
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double before = 0, now = 0;
    for (int k = 0; k < 60; ++k) {
      const double next = run.positions()[1].x();
      if (k >= 2) {
        const Eigen::Vector2d row(2 * now, -before);
        normal += row * row.transpose();
        right += next * row;
      }
      before = now;
      now = next;
      run.step();
    }
    const Eigen::Vector2d found = normal.inverse() * right;
    const double r2 = pull == Pull::kMinimal ? 1 / (1 + w * w * h * h) : 1;
    const double cosine = pull == Pull::kMinimal ? r2 : 1 - 0.5 * w * w * h * h;
    EXPECT_NEAR(found[0], cosine, a * a);
    EXPECT_NEAR(found[1], r2, a * a);
  }
}

TEST(RelaxedRod, ThatTurnsFreelyKeepsItsAngularMomentumOrLosesItAsDerived) {
  const double h = 0.01, turn = 0.05;
  for (const Pull pull : {Pull::kMinimal, Pull::kStart}) {
    Assembly rod = make_chain(std::vector<Vec3>{Vec3::Zero(), Vec3(1, 0, 0)}, 1);
    rod.v_W[1] = Vec3(0, 0, turn / h);
    VerletRelaxation run(rod, h, options_of(pull, Vec3::Zero(), 0, 5));
    run.step();
    double expected = std::atan2(run.positions()[1].z(), run.positions()[1].x());
    for (int k = 0; k < 1000; ++k) {
      const Vec3 p = run.positions()[1];
      run.step();
      const Vec3 next = run.positions()[1];
      if (pull == Pull::kMinimal) expected = std::atan(std::sin(expected) / (2 - std::cos(expected)));
      EXPECT_NEAR(std::atan2(p.x() * next.z() - p.z() * next.x(), p.dot(next)), expected, 1e-12) << k;
    }
    // theta' = theta - theta^3: after n steps 1/theta^2 has grown by 2 n, here from 400 to about 2400.
    if (pull == Pull::kMinimal) {
      EXPECT_NEAR(1 / (expected * expected), 2400, 24);
    }
  }
}

// Bernoulli's chain of 3: w_j^2 = (g/l) x_j with L_3(x_j) = 0. Let go in the shape of each mode it swings with that
// mode's frequency alone. The shapes: u_i = L_i(x_j) counted from the free end.
TEST(RelaxedChain, SwingsWithTheFrequenciesOfTheLaguerrePolynomial) {
  const double l = 0.5;
  for (const double zero : {0.41577456, 2.29428036, 6.28994508}) {  // published to eight decimals
    double x = zero;
    for (int k = 0; k < 5; ++k)  // the rest of the digits from L_3 = (-x^3 + 9 x^2 - 18 x + 6)/6 itself
      x -= (((-x + 9) * x - 18) * x + 6) / ((-3 * x + 18) * x - 18);
    ASSERT_NEAR(x, zero, 5e-9);
    const double w = std::sqrt(kG / l * x), amplitude = 2e-6;
    const std::array<double, 4> shape{0, 1 - 2 * x + x * x / 2, 1 - x, 1};  // L_3 = 0 at the pivot, L_2, L_1, L_0
    for (const Pull pull : {Pull::kMinimal, Pull::kStart}) {
      std::vector<double> errors;
      for (const double wh : {0.1, 0.05, 0.025}) {
        const double h = wh / w;
        std::vector<Vec3> p{Vec3::Zero()};
        for (std::size_t i = 1; i < 4; ++i) {
          const double step = amplitude * (shape[i] - shape[i - 1]);
          p.push_back(p.back() + Vec3(step, 0, -std::sqrt(l * l - step * step)));
        }
        VerletRelaxation run(make_chain(p, 1), h, options_of(pull, Vec3(0, 0, -kG), 1e-15, 400));
        const auto times = crossings(run, h, 3, [](std::span<const Vec3> q) { return q[3].x(); });
        ASSERT_EQ(times.size(), 3u);
        const double found = 2 * std::numbers::pi / (times[2] - times[0]);
        // SHAKE is Verlet in the chain's angles. The interpolation of a zero errs by (wh)^4 times 1/100 or so, and
        // slopes of up to 14 amplitude/l by their squares, 3e-9. (By the slide's pull each link is put right where the
        // others are not yet: second order, but not atan(w h)/h.)
        if (pull == Pull::kStart) {
          EXPECT_NEAR(found * h / (2 * std::asin(wh / 2)), 1, 0.02 * std::pow(wh, 4) + 1e-7) << x << " " << wh;
        }
        errors.push_back(std::abs(found / w - 1));
      }
      EXPECT_NEAR(observed_order(errors), 2, 0.05) << x;
      const std::string name = (pull == Pull::kMinimal ? "minimal_" : "start_") + std::to_string(static_cast<int>(x));
      RecordProperty(name + "_error", measured(errors.back()));
      RecordProperty(name + "_order", measured(observed_order(errors)));
    }
  }
}

TEST(RelaxedChain, CarriesAtEachLinkTheWeightBelow) {
  constexpr std::size_t kLinks = 8;
  const double mass = 0.3, h = 0.1;
  for (const Pull pull : {Pull::kMinimal, Pull::kStart}) {
    const auto p = row_of_points(Vec3::Zero(), Vec3(0, 0, -4), kLinks);
    VerletRelaxation run(make_chain(p, mass), h, options_of(pull, Vec3(0, 0, -kG), 1e-14, 20000));
    RelaxationReport report;
    for (int k = 0; k < 5; ++k) report = run.step();
    for (std::size_t k = 0; k < kLinks; ++k) {
      // Left over when the residual has come down to 1e-14 by a factor of cos^2(pi/2N) a sweep: 1e-14/(pi/2N)^2 = 3e-13
      // of length, times m/h^2, in this step and in the ones before, which it follows.
      const double weight = mass * kG * static_cast<double>(kLinks - k);
      EXPECT_NEAR(report.multipliers[k] / (h * h), weight, 1e-10) << k;
    }
  }
}

TEST(RelaxedChain, StretchesLessTheMoreSweeps) {
  // At rest under its weight with n sweeps a step, the largest stretch of a link: what slide 36 calls no guarantee.
  double before = std::numeric_limits<double>::infinity();
  for (const int sweeps : {1, 4, 16, 64, 256}) {
    const auto p = row_of_points(Vec3::Zero(), Vec3(0, 0, -10), 10);
    VerletOptions options = options_of(Pull::kMinimal, Vec3(0, 0, -kG), 0, sweeps);
    options.drag = 5;
    VerletRelaxation run(make_chain(p, 1), 0.01, options);
    double stretch = 0;
    for (int k = 0; k < 1000; ++k) stretch = run.step().residuals.back();
    EXPECT_LT(stretch, before);
    before = stretch;
  }
  // After the sweeps a load of 10 m g a h^2 is left to a chain whose slowest mode falls by cos^2(pi/20)^256 = 1.8e-3
  // and starts from some N^2/2 of a g h^2: 50 * 1e-3 * 1.8e-3.
  EXPECT_LT(before, 2e-4);
}

TEST(RelaxedTriangle, InFreeFlightKeepsItsMomenta) {
  // Linear momentum by either pull; angular momentum by SHAKE's to rounding even with two sweeps, and by the slide's in
  // first order of the step: the loss halves with it.
  std::vector<double> losses;
  for (const double h : {0.004, 0.002, 0.001}) {
    for (const Pull pull : {Pull::kStart, Pull::kMinimal}) {
      Assembly triangle;
      triangle.add_particle(1, Vec3(0, 0, 0), Vec3(1, 0, 2));
      triangle.add_particle(2, Vec3(1, 0, 0), Vec3(1, 2, 0));
      triangle.add_particle(3, Vec3(0, 1, 0), Vec3(0, 0, -1));
      triangle.constraints.add(LinkConstraint(0, 1, 1));
      triangle.constraints.add(LinkConstraint(1, 2, std::sqrt(2)));
      triangle.constraints.add(LinkConstraint(2, 0, 1));
      VerletRelaxation run(triangle, h, options_of(pull, Vec3::Zero(), 0, 2));
      const auto momenta = [&] {
        std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
        for (std::size_t i = 0; i < 3; ++i) {
          const double m = 1 / triangle.inverse_masses[i];
          const Vec3 p = run.previous_positions()[i], next = run.positions()[i];
          sum.first += m / h * (next - p);
          sum.second += m / h * p.cross(next);
        }
        return sum;
      };
      for (int k = 0; k < 20; ++k) run.step();  // until the links hold
      const auto [p0, l0] = momenta();
      const int steps = static_cast<int>(std::lround(1 / h));
      for (int k = 0; k < steps; ++k) run.step();
      const auto [p1, l1] = momenta();
      // Each step rounds positions of some 5 m to 5 eps, divided by h, times masses of 6 in all (times an arm of 5 for
      // L).
      const double rounding = steps * 5 * kEps * 6 / h;
      EXPECT_LE((p1 - p0).norm(), rounding);
      if (pull == Pull::kStart) {
        EXPECT_LE((l1 - l0).norm(), 5 * rounding);
      } else {
        losses.push_back((l1 - l0).norm());
      }
    }
  }
  EXPECT_GT(losses.back(), 1e-4);
  EXPECT_NEAR(observed_order(losses), 1, 0.05);
  RecordProperty("loss_order", measured(observed_order(losses)));
}

TEST(VerletRelaxation, OfAFreeParticleIsTheParabola) {
  Assembly stone;
  stone.add_particle(2, Vec3(0, 0, 1), Vec3(3, -1, 4));
  VerletRelaxation run(stone, 0.01);
  const std::vector<Vec3> wind{Vec3(2, 0, 0)};
  run.step();
  for (int k = 1; k < 100; ++k) run.step();
  EXPECT_LE((run.positions()[0] - Vec3(3, -1, 1 + 4 - 0.5 * 9.81)).norm(), 1e-12);  // 100^2/2 roundings of 5 m
  const Vec3 p = run.positions()[0], before = run.previous_positions()[0];
  run.step(wind);
  EXPECT_LE((run.positions()[0] - (2 * p - before + 1e-4 * Vec3(1, 0, -9.81))).norm(), 1e-15);
  EXPECT_NEAR(run.time(), 1.01, 1e-15);
}

TEST(VerletRelaxation, RefusesNonsense) {
  Assembly stone;
  EXPECT_THROW(stone.add_particle(0, Vec3::Zero()), std::invalid_argument);
  stone.add_particle(1, Vec3::Zero());
  EXPECT_THROW(VerletRelaxation(stone, 0), std::invalid_argument);
  VerletOptions options;
  options.drag = 101;
  EXPECT_THROW(VerletRelaxation(stone, 0.01, options), std::invalid_argument);
  options = {};
  options.relaxation.factor = 0;
  EXPECT_THROW(VerletRelaxation(stone, 0.01, options), std::invalid_argument);
  VerletRelaxation run(stone, 0.01);
  EXPECT_THROW(run.step(std::vector<Vec3>(2, Vec3::Zero())), std::invalid_argument);
  stone.v_W.clear();
  EXPECT_THROW(VerletRelaxation(stone, 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
