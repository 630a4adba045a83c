// Slide 26: accuracy against cost. The currency is the evaluation of forces, which is what costs in an engine.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "known_motions.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"
#include "plumbline/core/integration/stepper_table.hpp"

namespace plumbline {
namespace {

using namespace testing;

struct Run {
  double error;
  double evaluations;
};

Run measure(const StepperKind& kind, const KnownMotion& motion, long steps) {
  double evaluations = 0;
  const AccelerationField counted = [&](double t, std::span<const BodyState> s, std::span<Acceleration> a) {
    ++evaluations;
    motion.field(t, s, a);
  };
  const auto stepper = kind.make();
  const double error = distance(
      run(*stepper, counted, motion.initial, motion.duration / static_cast<double>(steps), steps), motion.final);
  return {error, evaluations};
}

// Evaluations for that error: err = C dt^p predicts the steps from a trial, and each run is the trial of the next.
double cost(const StepperKind& kind, const KnownMotion& motion, double target) {
  long steps = 400;
  Run run{};
  for (int trial = 0; trial < 5; ++trial) {
    run = measure(kind, motion, steps);
    if (std::abs(run.error / target - 1) < 0.1) break;
    steps = std::lround(static_cast<double>(steps) * std::pow(run.error / target, 1.0 / kind.order));
  }
  EXPECT_NEAR(run.error / target, 1, 0.1) << kind.name;
  return run.evaluations;
}

TEST(WorkPrecision, EachDigitCostsTenToTheOneOverTheOrder) {
  const KnownMotion motion = pendulum(10);
  std::map<int, double> at_1e4;
  for (const StepperKind& kind : stepper_kinds().first(5)) {
    const double rough = cost(kind, motion, 1e-3), fine = cost(kind, motion, 1e-4);
    EXPECT_NEAR(fine / rough / std::pow(10, 1.0 / kind.order), 1, 0.15) << kind.name;
    RecordProperty("cost_of_1e-4_" + std::to_string(&kind - stepper_kinds().data()), std::to_string(fine));
    at_1e4[kind.order] = std::max(at_1e4[kind.order], fine);
  }
  // The higher order wins, and by a lot.
  EXPECT_GT(at_1e4[1], 50 * at_1e4[2]);
  EXPECT_GT(at_1e4[2], 2 * at_1e4[4]);
}

TEST(WorkPrecision, NineDigitsAreDormandPrincesBusiness) {
  const KnownMotion motion = pendulum(10);
  const double rk4 = cost(stepper_kinds()[4], motion, 1e-9);
  DormandPrince<Eigen::Vector2d> solver({1e-10, 1e-10});
  solver.start(0, Eigen::Vector2d(motion.initial.p_WB.x(), motion.initial.v_WB.x()));
  solver.advance_to([](double, const auto& y, auto& dy) { dy = Eigen::Vector2d(y[1], -std::sin(y[0])); }, 10);
  EXPECT_LT(std::hypot(solver.state()[0] - motion.final.p_WB.x(), solver.state()[1] - motion.final.v_WB.x()), 1e-9);
  EXPECT_GT(rk4, 5 * static_cast<double>(solver.effort().evaluations));
  RecordProperty("rk4", std::to_string(rk4));
  RecordProperty("dormand_prince", std::to_string(solver.effort().evaluations));
}

}  // namespace
}  // namespace plumbline
