#include "plumbline/reports/html_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "approved.hpp"
#include "literal_report.hpp"

namespace plumbline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kLargestPage = 5 * 1000 * 1000;  // what still opens at once on a phone [bytes]

TEST(HtmlPage, IsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(html_page(testing::literal_report()), "report.html"));
}

TEST(HtmlPage, TextOfTheReportIsNeverMarkup) {
  const std::string page = html_page(testing::literal_report());
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<b>&\"")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;&quot;&#39;"));
  EXPECT_EQ(page.find('\x1b'), std::string::npos);
  EXPECT_EQ(page.find('\xFF'), std::string::npos);
}

TEST(HtmlPage, NumbersThatAreNoneReachNoCoordinate) {
  const std::string page = html_page(testing::literal_report());
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = page.find("<svg viewBox=\"0 0 900", at)) != std::string::npos; ++at, ++pictures) {
    const std::string picture = page.substr(at, page.find("</svg>", at) - at);
    for (std::size_t d = 0; (d = picture.find(" d=\"", d)) != std::string::npos; ++d) {
      const std::string path = picture.substr(d + 4, picture.find('"', d + 4) - d - 4);
      EXPECT_EQ(path.find_first_not_of("MLHVlhvmz0123456789.- "), std::string::npos) << path;
    }
  }
  EXPECT_EQ(pictures, 3U);  // two dt's of the falling box, one of the spheres
  EXPECT_THAT(page, HasSubstr("not finite"));
  EXPECT_THAT(page, HasSubstr("exactly 0"));
}

TEST(HtmlPage, EmptyStatesAreSaidInWords) {
  const std::string page = html_page(Report{});
  EXPECT_THAT(page, HasSubstr("Nothing was run"));
  EXPECT_THAT(page, HasSubstr("No engine took part"));
  EXPECT_THAT(html_page(testing::literal_report()), HasSubstr("there is nothing to draw"));
}

TEST(HtmlPage, AFullComparisonStaysSmall) {
  const auto path = testing::fresh_folder() / "report.html";
  write_html(testing::large_report(), path);
  EXPECT_LT(std::filesystem::file_size(path), kLargestPage);
  EXPECT_GT(std::filesystem::file_size(path), 100 * testing::large_report().runs.size());
}

}  // namespace
}  // namespace plumbline
