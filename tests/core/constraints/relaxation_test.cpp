#include "plumbline/core/constraints/relaxation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "particle_scenes.hpp"
#include "plumbline/core/constraints/angle_range.hpp"
#include "plumbline/core/constraints/chain.hpp"
#include "plumbline/core/constraints/coordinate_range.hpp"
#include "plumbline/core/constraints/keep_out.hpp"
#include "plumbline/core/constraints/link_constraint.hpp"

namespace plumbline {
namespace {

using namespace particles;
constexpr double kPi = std::numbers::pi;

// A straight chain of that many links of length 1 along x whose free particles are shaken along x by up to 0.1.
Assembly shaken_chain(std::size_t links, bool both_held) {
  const std::vector<Vec3> p = row_of_points(Vec3::Zero(), Vec3(static_cast<double>(links), 0, 0), links);
  Assembly chain = make_chain(p, 1, both_held);
  Random random(21);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (chain.inverse_masses[i] > 0) chain.p_W[i].x() += random.in(-0.1, 0.1);
  }
  return chain;
}

// Factor by which the residual falls in a sweep, once only the slowest mode is left: from the sweeps between which the
// residual goes from 1e-5 to 1e-9 of the shake, well above rounding.
double measured_rate(const RelaxationReport& report) {
  std::size_t from = 0, to = 0;
  for (std::size_t k = 0; k < report.residuals.size(); ++k) {
    if (from == 0 && report.residuals[k] < 1e-6) from = k;
    if (to == 0 && report.residuals[k] < 1e-10) to = k;
  }
  EXPECT_GT(to, from + 3);
  return std::pow(report.residuals[to] / report.residuals[from], 1 / static_cast<double>(to - from));
}

double rate_of(Assembly chain, const RelaxationOptions& options) {
  return measured_rate(relax(chain.constraints, chain.inverse_masses, chain.p_W, options));
}

TEST(Relaxation, OfAChainConvergesAtTheRateOfTheory) {
  // Of the second slowest mode nothing but (mu_2/mu_1)^k is left, mu_2/mu_1 = 1 - 3 theta^2 or so against mu_1 = 1 -
  // theta^2: when the slowest has fallen to 1e-5 the other is at 1e-15. What remains is rounding of positions, 1e-15 of
  // 1e-10, over the number of sweeps between; the tolerance leaves ten times as much.
  for (const std::size_t links : {4u, 10u, 30u}) {
    const auto n = static_cast<double>(links);
    RelaxationOptions options;
    options.sweeps = 20000;
    options.tolerance = 1e-11;
    EXPECT_NEAR(rate_of(shaken_chain(links, true), options), std::pow(std::cos(kPi / (n - 1)), 2), 1e-5) << links;
    EXPECT_NEAR(rate_of(shaken_chain(links, false), options), std::pow(std::cos(kPi / (2 * n)), 2), 1e-5) << links;
    options.order = SweepOrder::kJacobi;
    options.factor = 0.5;
    EXPECT_NEAR(rate_of(shaken_chain(links, true), options), std::pow(std::cos(kPi / (2 * n - 2)), 2), 1e-5) << links;
  }
}

TEST(Relaxation, OfAChainTakesFewerSweepsWhenOverdone) {
  // omega = 2/(1 + sin theta): the residual falls by omega - 1 a sweep, times a power of the number of sweeps since all
  // modes have the same rate there (a Jordan block), which is why the count below is allowed twice the plain estimate.
  constexpr std::size_t kLinks = 30;
  const double theta = kPi / (2 * kLinks), omega = 2 / (1 + std::sin(theta));
  RelaxationOptions options;
  options.sweeps = 20000;
  options.tolerance = 1e-10;
  Assembly plain = shaken_chain(kLinks, false), overdone = plain;
  const int sweeps = relax(plain.constraints, plain.inverse_masses, plain.p_W, options).sweeps();
  options.factor = omega;
  const int fewer = relax(overdone.constraints, overdone.inverse_masses, overdone.p_W, options).sweeps();
  EXPECT_LT(fewer, 2 * std::log(0.2 / 1e-10) / -std::log(omega - 1));
  EXPECT_LT(10 * fewer, sweeps);
}

TEST(Relaxation, ByPlainJacobiSwapsAViolationForEver) {
  // Two links between held ends: both move the middle by half of c, to the other side and back.
  Assembly chain = make_chain(row_of_points(Vec3::Zero(), Vec3(2, 0, 0), 2), 1, true);
  chain.p_W[1].x() = 1.1;
  RelaxationOptions options;
  options.order = SweepOrder::kJacobi;
  options.sweeps = 101;
  const RelaxationReport report = relax(chain.constraints, chain.inverse_masses, chain.p_W, options);
  EXPECT_NEAR(chain.p_W[1].x(), 0.9, 101 * kEps);
  EXPECT_NEAR(report.residuals.back(), 0.1, 101 * kEps);
  EXPECT_FALSE(report.within_tolerance);
}

TEST(Relaxation, ComesToAStableConfigurationWhereTheViolationCannotBeUndone) {
  // Ten links of 1 m between ends 10.5 m apart. By Jacobi all links then pull alike: lambda = c/(w1 + w2) is the same,
  // so that the end links, with one end held, are stretched half as much as the others: 8 c + 2 c/2 = 0.5. Gauss-Seidel
  // has just met its last link, whatever that did to the others, which share the rest: 9 c = 0.5.
  for (const SweepOrder order : {SweepOrder::kJacobi, SweepOrder::kGaussSeidel}) {
    Assembly chain = shaken_chain(10, true);
    chain.p_W.back().x() = 10.5;
    RelaxationOptions options;
    options.sweeps = 2000;
    options.order = order;
    if (order == SweepOrder::kJacobi) options.factor = 0.5;
    const RelaxationReport report = relax(chain.constraints, chain.inverse_masses, chain.p_W, options);
    EXPECT_FALSE(report.within_tolerance);
    EXPECT_EQ(report.sweeps(), 2000);
    EXPECT_NEAR(report.residuals.back(), 0.5 / 9, 1e-13);
    for (std::size_t k = 0; k < 10; ++k) {
      double stretch = 0.5 / 9;
      if (order == SweepOrder::kJacobi && (k == 0 || k == 9)) stretch = 0.25 / 9;
      if (order == SweepOrder::kGaussSeidel && k == 9) stretch = 0;
      EXPECT_NEAR((chain.p_W[k + 1] - chain.p_W[k]).norm(), 1 + stretch, 1e-13) << k;  // roundings of 10 m
    }
  }
}

TEST(Relaxation, ByJacobiDoesNotDependOnTheOrderOfTheList) {
  Random random(22);
  std::vector<Vec3> p;
  std::vector<double> w;
  for (int i = 0; i < 6; ++i) {
    p.push_back(random.vector(1));
    w.push_back(random.in(0.5, 2));
  }
  ConstraintList forward, backward;
  for (std::size_t i = 0; i < 5; ++i) forward.add(LinkConstraint(i, i + 1, 0.8));
  for (std::size_t i = 5; i-- > 0;) backward.add(LinkConstraint(i, i + 1, 0.8));
  RelaxationOptions options;
  options.factor = 0.5;
  for (const SweepOrder order : {SweepOrder::kJacobi, SweepOrder::kGaussSeidel}) {
    options.order = order;
    options.sweeps = 3;
    std::vector<Vec3> one = p, other = p;
    relax(forward, w, one, options);
    relax(backward, w, other, options);
    double apart = 0;
    for (std::size_t i = 0; i < p.size(); ++i) apart = std::max(apart, (one[i] - other[i]).norm());
    if (order == SweepOrder::kJacobi) {
      EXPECT_LE(apart, 100 * kEps);  // two motions of a particle are added in another order
    } else {
      EXPECT_GT(apart, 1e-3);
    }
  }
}

TEST(Relaxation, BringsLinksAnglesRangesAndObstaclesTogether) {
  // A limb of three links over a ball, with limits to its angles, in a room: all met to the tolerance asked for.
  Assembly limb = make_chain(row_of_points(Vec3(0, 0, 1), Vec3(3, 0, 1), 3), 1);
  for (std::size_t i = 0; i + 2 < 4; ++i) limb.constraints.add(AngleRange(i, i + 1, i + 2, 2, kPi));
  for (std::size_t i = 0; i < 3; ++i)
    limb.constraints.add(LinkKeepOut(i, i + 1, {Sphere{0.8}, Vec3(1.5, 0.1, 0.5), Quat::Identity()}));
  for (std::size_t i = 0; i < 4; ++i) limb.constraints.add(CoordinateRange(i, Vec3::UnitX(), -10, 2.9));
  RelaxationOptions options;
  options.sweeps = 1000;
  options.tolerance = 1e-12;
  const RelaxationReport report = relax(limb.constraints, limb.inverse_masses, limb.p_W, options);
  EXPECT_GT(report.residuals.front(), 0.1);
  EXPECT_TRUE(report.within_tolerance) << report.residuals.back();
  EXPECT_LE(largest_violation(limb.constraints, limb.p_W), 1e-12);
  EXPECT_EQ(limb.p_W[0], Vec3(0, 0, 1));
}

TEST(Relaxation, StopsAtOnceWhereAllIsMet) {
  Assembly chain = make_chain(row_of_points(Vec3::Zero(), Vec3(4, 0, 0), 4), 1);
  const std::vector<Vec3> before = chain.p_W;
  const RelaxationReport report = relax(chain.constraints, chain.inverse_masses, chain.p_W);
  EXPECT_EQ(report.sweeps(), 0);
  EXPECT_TRUE(report.within_tolerance);
  EXPECT_EQ(chain.p_W, before);
}

TEST(Relaxation, ShowsNaNAndRefusesNonsense) {
  Assembly chain = shaken_chain(4, false);
  chain.p_W[3].x() = std::numeric_limits<double>::quiet_NaN();
  RelaxationOptions options;
  options.tolerance = 1e9;
  const RelaxationReport report = relax(chain.constraints, chain.inverse_masses, chain.p_W, options);
  EXPECT_TRUE(std::isnan(report.residuals.back()));
  EXPECT_FALSE(report.within_tolerance);

  const auto refused = [&](const RelaxationOptions& bad) {
    EXPECT_THROW(relax(chain.constraints, chain.inverse_masses, chain.p_W, bad), std::invalid_argument);
  };
  options = {};
  options.factor = 2;
  refused(options);
  options = {};
  options.sweeps = -1;
  refused(options);
  options = {};
  options.tolerance = -1;
  refused(options);
  chain.inverse_masses[1] = -1;
  refused({});
  chain.inverse_masses[1] = 1;
  chain.constraints.add(LinkConstraint(1, 5, 1));
  refused({});
  chain.inverse_masses.pop_back();
  refused({});
}

}  // namespace
}  // namespace plumbline
