#include "plumbline/reports/conformance_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "approved.hpp"
#include "literal_report.hpp"

namespace plumbline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string printed(const Report& report, const ConsoleStyle& style, const ConformanceTableOptions& options) {
  std::ostringstream out;
  print_conformance(report, style, out, options);
  return std::move(out).str();
}

TEST(ConformanceConsole, IsAsApproved) {
  const Report report = testing::literal_report();
  EXPECT_TRUE(testing::matches_approved(printed(report, {}, {}), "conformance_plain.txt"));
  EXPECT_TRUE(testing::matches_approved(printed(report, {true, true, 80}, {true, true}), "conformance_color.txt"));
}

TEST(ConformanceConsole, WithoutTheMatrixOnlyFailuresAndCountsAreLeft) {
  const std::string text = printed(testing::literal_report(), {false, false, 200}, {false, false});
  EXPECT_THAT(text, HasSubstr("alpha.default gravity_pulls: the velocity after one step is (0, 0, 0.153)"));
  EXPECT_THAT(text, HasSubstr("it printed: assertion"));
  EXPECT_THAT(text, HasSubstr("1 expected_fail"));
  EXPECT_THAT(text, Not(HasSubstr("beta-f32.matched force_echoes_the_mass")));
}

TEST(ConformancePage, IsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(conformance_page(testing::literal_report()), "conformance.html"));
}

TEST(ConformancePage, TextIsNeverMarkupAndEveryFailureHasItsNumbers) {
  const std::string page = conformance_page(testing::literal_report());
  EXPECT_THAT(page, Not(HasSubstr("<b>&\"")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;&quot;&#39;"));
  EXPECT_EQ(page.find('\x1b'), std::string::npos);
  EXPECT_EQ(page.find('\xFF'), std::string::npos);
  for (const ConformanceResult& r : testing::literal_report().conformance) {
    if (r.verdict != Verdict::kFail) continue;
    EXPECT_THAT(page, HasSubstr("<td class=\"wide\">" + r.text));
  }
}

TEST(ConformancePage, EmptyStatesAreSaidInWords) {
  EXPECT_THAT(conformance_page(Report{}), HasSubstr("Nothing was asked"));
  Report whole = testing::literal_report();
  for (ConformanceResult& r : whole.conformance) r.verdict = Verdict::kPass;
  EXPECT_THAT(conformance_page(whole), HasSubstr("Everything that was asked holds"));
}

}  // namespace
}  // namespace plumbline
