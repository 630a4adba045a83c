#include "plumbline/harness/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumbline {
namespace {

std::vector<ErrorAtStep> power_law(double order, double factor, double floor = 0) {
  std::vector<ErrorAtStep> errors;
  for (double dt : {0.02, 1.0 / 60, 1.0 / 240, 0.001}) errors.push_back({dt, factor * std::pow(dt, order), floor});
  return errors;
}

TEST(ObservedOrder, IsTheExponentOfAPowerLaw) {
  for (double order : {0.5, 1.0, 2.0, 4.0}) {
    // Logarithms of numbers within 1e-12..1 carry errors of some 1e-15 each.
    EXPECT_NEAR(observed_order(power_law(order, 3.7)).order, order, 1e-12);
  }
}

TEST(ObservedOrder, LeavesOutWhatRoundingExplains) {
  auto errors = power_law(1, 1);
  errors.push_back({1e-4, 0.5, 1.0});  // a plateau at the floor
  const Order order = observed_order(errors);
  EXPECT_NEAR(order.order, 1, 1e-12);
  EXPECT_EQ(order.points, 4u);
  EXPECT_EQ(order.note, "1 dt at the rounding floor left out");
}

TEST(ObservedOrder, IsNoNumberWhenItMeansNothing) {
  EXPECT_TRUE(std::isnan(observed_order({}).order));
  const auto exact = observed_order(power_law(1, 1e-20, 1e-15));
  EXPECT_TRUE(std::isnan(exact.order));
  EXPECT_EQ(exact.note, "exact to rounding");
  std::vector<ErrorAtStep> two = {{0.1, 1, 0}, {0.01, 0.1, 0}};
  EXPECT_TRUE(std::isnan(observed_order(two).order));
  two.push_back({0.001, std::nan(""), 0});
  two.push_back({0.0001, std::numeric_limits<double>::infinity(), 0});
  EXPECT_TRUE(std::isnan(observed_order(two).order)) << "NaN and infinity are no points";
}

}  // namespace
}  // namespace plumbline
