#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>

#include "plumbline/core/gate.hpp"
#include "plumbline/core/metric.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(StepCount, CountsAStepThatMissesByRounding) {
  Scenario s;
  s.duration = 2;
  EXPECT_EQ(s.step_count(0.02), 100u);
  EXPECT_EQ(s.step_count(1.0 / 60), 120u);
  EXPECT_EQ(s.step_count(0.001), 2000u);
  s.duration = 0.3;  // 0.3 / 0.1 is 2.9999999999999996 in doubles
  EXPECT_EQ(s.step_count(0.1), 3u);
}

TEST(StepCount, LeavesOutAStepThatDoesNotFit) {
  Scenario s;
  s.duration = 1;
  EXPECT_EQ(s.step_count(0.3), 3u);
  EXPECT_EQ(s.step_count(0.50001), 1u);
  EXPECT_EQ(s.step_count(2), 0u);
}

TEST(Shortest, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int k = 0; k < 1000; ++k) {
    const double value = std::pow(10, exponent(random));
    EXPECT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
  }
}

TEST(Shortest, HasNoDigitTooMany) {
  EXPECT_EQ(shortest(0.02), "0.02");
  EXPECT_EQ(shortest(1e-9), "1e-09");
  EXPECT_EQ(shortest(1.0 / 60), "0.016666666666666666");
  EXPECT_EQ(shortest(-3), "-3");
  EXPECT_EQ(shortest(kNan), "nan");
  EXPECT_EQ(shortest(-kInf), "-inf");
}

TEST(CaseName, ListsTheSweptParameters) {
  Scenario s;
  s.id = "collision/two_sphere";
  EXPECT_EQ(s.case_name(), "collision/two_sphere");
  s.parameters = {{"m", 1}, {"e", 0.5}, {"b", 0}};
  s.swept = {{"e", 0.5}, {"b", 0}};
  EXPECT_EQ(s.case_name(), "collision/two_sphere/e=0.5,b=0");
}

TEST(BodyIndex, NamesTheBodyThatIsMissing) {
  Scenario s;
  s.bodies.resize(2);
  s.bodies[1].name = "ball";
  EXPECT_EQ(s.body_index("ball"), 1u);
  try {
    s.body_index("bell");
    FAIL();
  } catch (const std::out_of_range& e) {
    EXPECT_NE(std::string(e.what()).find("bell"), std::string::npos);
  }
}

TEST(MaxOrNan, LetsNanStickOnEitherSide) {
  EXPECT_EQ(max_or_nan(1, 2), 2);
  EXPECT_EQ(max_or_nan(2, 1), 2);
  EXPECT_EQ(max_or_nan(-kInf, kInf), kInf);
  EXPECT_TRUE(std::isnan(max_or_nan(kNan, 1)));
  EXPECT_TRUE(std::isnan(max_or_nan(1, kNan)));
  EXPECT_TRUE(std::isnan(max_or_nan(kNan, kInf)));
  EXPECT_TRUE(std::isnan(max_or_nan(kInf, kNan)));
}

TEST(Within, ComparesMagnitudes) {
  EXPECT_TRUE(within(1, 1));
  EXPECT_TRUE(within(-1, 1));
  EXPECT_TRUE(within(1, kInf));
  EXPECT_TRUE(within(0, 0));
  EXPECT_FALSE(within(-1.5, 1));
  EXPECT_FALSE(within(0, -1));
}

TEST(Within, FailsForNanOnEitherSide) {
  EXPECT_FALSE(within(kNan, 1));
  EXPECT_FALSE(within(kNan, kInf));
  EXPECT_FALSE(within(0, kNan));
  EXPECT_FALSE(within(kInf, 1e300));
}

TEST(IsFinite, LooksAtEveryNumberOfAState) {
  EXPECT_TRUE(is_finite(BodyState{}));
  for (int k = 0; k < 13; ++k) {
    for (const double bad : {kNan, kInf}) {
      BodyState s;
      if (k < 3)
        s.p_WB(k) = bad;
      else if (k < 7)
        s.q_WB.coeffs()(k - 3) = bad;
      else if (k < 10)
        s.v_WB(k - 7) = bad;
      else
        s.w_WB(k - 10) = bad;
      EXPECT_FALSE(is_finite(s)) << k;
    }
  }
}

}  // namespace
}  // namespace plumbline
