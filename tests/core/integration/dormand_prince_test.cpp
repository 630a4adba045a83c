// The general solver: order, error control, exact output times, rounding, errors.
#include "plumbline/core/integration/dormand_prince.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "quadratic_taylor.hpp"

namespace plumbline {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kEps = std::numeric_limits<double>::epsilon();

const auto kOscillator = [](double, const auto& y, auto& dy) {
  dy[0] = y[1];
  dy[1] = -y[0];
};

// Kepler's orbit in its plane, x'' = -x/|x|^3.
const auto kKepler = [](double, const Eigen::Vector4d& y, Eigen::Vector4d& dy) {
  const double r2 = y.head<2>().squaredNorm();
  dy << y[2], y[3], -y.head<2>() / (r2 * std::sqrt(r2));
};

// Started in the pericentre of an orbit of semi-axis 1 and eccentricity e; state at t by Kepler's equation E - e sin E
// = t.
Eigen::Vector4d kepler(double e, double t) {
  double E = t;
  for (int n = 0; n < 50; ++n) E -= (E - e * std::sin(E) - t) / (1 - e * std::cos(E));
  const double b = std::sqrt(1 - e * e), rate = 1 / (1 - e * std::cos(E));
  return {std::cos(E) - e, b * std::sin(E), -std::sin(E) * rate, b * std::cos(E) * rate};
}

double error_of_fixed_steps(int steps) {
  const double e = 0.3, end = 2;
  DormandPrince<Eigen::Vector4d> solver({});
  solver.start(0, kepler(e, 0));
  for (int n = 0; n < steps; ++n) solver.step(kKepler, end / steps);
  return (solver.state() - kepler(e, end)).norm();
}

TEST(DormandPrince, HasItsDesignOrderAtFixedSteps) {
  // Halving the step from 2/64 takes the error from 1e-11 to a few 1e-14: the next bisection would meet rounding. The
  // next term of the error is of relative size h times a few, hence 0.25.
  EXPECT_NEAR(std::log2(error_of_fixed_steps(16) / error_of_fixed_steps(32)), 8, 0.25);
}

TEST(DormandPrince, KeepsWhatTheToleranceSays) {
  const double e = 0.6, end = 10;
  double before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    DormandPrince<Eigen::Vector4d> solver({tolerance, tolerance});
    solver.start(0, kepler(e, 0));
    solver.advance_to(kKepler, end);
    const double error = (solver.state() - kepler(e, end)).norm();
    // Each step adds the tolerance (times 1 + |y| <= 3); an orbit stretches errors along itself, by 3/2 n t a/(1-e)^2 =
    // 94 at most after 10 s. Rounding: the same with 2^-53 a step.
    const double steps = static_cast<double>(solver.effort().accepted);
    EXPECT_LT(error, 94 * 3 * steps * (tolerance + kEps)) << tolerance;
    EXPECT_LT(error, before) << tolerance;
    before = error;
  }
  EXPECT_LT(before, 1e-12);
}

TEST(DormandPrince, ArrivesAtOutputTimesExactlyAndAlsoBackwards) {
  DormandPrince<Vector2d> solver({1e-13, 1e-13});
  solver.start(0, Vector2d(1, 0));
  for (const double t : {0.1, 0.1, 0.1 + 1e-9, 3.0, 7.25, 10.0, 4.0, -1.0}) {
    solver.advance_to(kOscillator, t);
    EXPECT_EQ(solver.time(), t);
    // About 100 steps of at most 2e-13 each.
    EXPECT_NEAR(solver.state()[0], std::cos(t), 2e-11);
    EXPECT_NEAR(solver.state()[1], -std::sin(t), 2e-11);
  }
}

TEST(DormandPrince, LosesNoStepSizeAtOutputTimes) {
  const auto effort = [](int outputs) {
    DormandPrince<Vector2d> solver({1e-10, 1e-10});
    solver.start(0, Vector2d(1, 0));
    for (int n = 1; n <= outputs; ++n) {
      solver.advance_to(kOscillator, 100.0 * n / outputs - 1e-6);
      solver.advance_to(kOscillator, 100.0 * n / outputs);  // a tiny step on the way
    }
    return solver.effort();
  };
  // A visit to an output time costs two more steps at most, here at each of 20 pairs.
  EXPECT_LE(effort(20).accepted, effort(1).accepted + 2 * 2 * 19);
}

TEST(DormandPrince, CarriesWhatSumsLose) {
  // 400,000 steps of 2.5e-5 s on an oscillator. Plain sums round y each time: sqrt(steps) roundings of 2^-54 make
  // 4e-14. With the carries only the increments are rounded, h times smaller, and the arguments of f: 10 rad times
  // 2^-53.
  const int steps = 400000;
  const double h = 10.0 / steps;
  DormandPrince<Vector2d> solver({});
  solver.start(0, Vector2d(1, 0));
  for (int n = 0; n < steps; ++n) solver.step(kOscillator, h);
  EXPECT_LT(std::abs(solver.time() - 10), 2 * kEps * 10);
  // The weights b_i are rounded, and so is each of their products, in nearly the same way at every step: the worst case
  // is 10 s times the sum of their sizes, 13 (and 1 for the arguments of f), times 2^-53: 1.6e-14.
  EXPECT_LT((solver.state() - Vector2d(std::cos(10.0), -std::sin(10.0))).norm(), 10 * 14 * kEps / 2);
}

TEST(DormandPrince, GivesTheSameForFixedAndDynamicVectors) {
  DormandPrince<Vector2d> fixed({1e-12, 1e-12});
  DormandPrince<VectorXd> dynamic({1e-12, 1e-12});
  fixed.start(0, Vector2d(1, 0));
  dynamic.start(0, Vector2d(1, 0));
  fixed.advance_to(kOscillator, 5);
  dynamic.advance_to(kOscillator, 5);
  EXPECT_EQ(fixed.effort().evaluations, dynamic.effort().evaluations);
  EXPECT_LT((fixed.state() - dynamic.state()).norm(), 8 * kEps);
}

TEST(DormandPrince, TakesTimeDependentRightHandSides) {
  // y' = 2 t y, y = exp(t^2)
  using Vector1d = Eigen::Matrix<double, 1, 1>;
  DormandPrince<Vector1d> solver({1e-14, 1e-14});
  solver.start(-1, Vector1d(std::exp(1.0)));
  solver.advance_to([](double t, const Vector1d& y, Vector1d& dy) { dy[0] = 2 * t * y[0]; }, 2);
  // Errors grow from t = 0 on by exp(4), from before it by exp(3).
  const double steps = static_cast<double>(solver.effort().accepted);
  EXPECT_NEAR(solver.state()[0], std::exp(4.0), std::exp(4.0) * steps * 2 * 1e-14);
}

TEST(DormandPrince, SaysWhereItCannotGoOn) {
  using Vector1d = Eigen::Matrix<double, 1, 1>;
  const auto message = [](const auto& f, double end) -> std::string {
    DormandPrince<Vector1d> solver({1e-10, 1e-10});
    solver.start(0, Vector1d(1.0));
    try {
      solver.advance_to(f, end);
    } catch (const std::runtime_error& e) {
      EXPECT_TRUE(solver.state().allFinite());
      return e.what();
    }
    return "";
  };
  // y' = y^2 from 1 is 1/(1 - t): no solution beyond t = 1.
  const std::string pole = message([](double, const Vector1d& y, Vector1d& dy) { dy[0] = y[0] * y[0]; }, 2);
  ASSERT_NE(pole.find("singular"), std::string::npos) << pole;
  // The computed solution has its own pole, off by the error before: about 1e-10 a step.
  EXPECT_NEAR(std::stod(pole.substr(pole.find("t = ") + 4)), 1, 1e-8) << pole;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string hole = message([=](double t, const Vector1d&, Vector1d& dy) { dy[0] = t > 0.5 ? nan : 1; }, 2);
  EXPECT_NE(hole.find("not finite"), std::string::npos) << hole;
  EXPECT_NE(hole.find("t = 0.49999"), std::string::npos) << hole;
  EXPECT_NE(message([=](double, const Vector1d&, Vector1d& dy) { dy[0] = nan; }, 2).find("not finite"),
            std::string::npos);
}

TEST(DormandPrince, RefusesWhatMakesNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Tolerance& t : {Tolerance{1e-18, 1e-16}, Tolerance{0.2, 1e-9}, Tolerance{nan, 1e-9}, Tolerance{1e-9, 0},
                             Tolerance{1e-9, -1}, Tolerance{1e-9, nan}}) {
    EXPECT_THROW(DormandPrince<Vector2d>{t}, std::invalid_argument);
  }
  DormandPrince<Vector2d> solver({});
  EXPECT_THROW(solver.start(0, Vector2d(1, nan)), std::invalid_argument);
  EXPECT_THROW(solver.start(nan, Vector2d(1, 0)), std::invalid_argument);
  solver.start(0, Vector2d(1, 0));
  EXPECT_THROW(solver.advance_to(kOscillator, nan), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
