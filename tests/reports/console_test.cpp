#include "plumbline/reports/console.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "approved.hpp"
#include "literal_report.hpp"

namespace plumbline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string printed(const Report& report, const ConsoleStyle& style, const ConsoleOptions& options = {}) {
  std::ostringstream out;
  print_report(report, style, out, options);
  return std::move(out).str();
}

// The text without its escape sequences.
std::string without_color(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\x1b') {
      i = text.find('m', i);
    } else {
      plain += text[i];
    }
  }
  return plain;
}

TEST(Console, PlainIsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(printed(testing::literal_report(), {false, false, 120}, {false, "out/"}),
                                        "console_plain.txt"));
}

TEST(Console, ColouredIsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(printed(testing::literal_report(), {true, true, 120}, {true, ""}),
                                        "console_color.txt"));
}

TEST(Console, ColourChangesNothingButColour) {
  const Report report = testing::literal_report();
  EXPECT_EQ(without_color(printed(report, {true, false, 100})), printed(report, {false, false, 100}));
}

TEST(Console, PlainHasNeitherEscapesNorLettersBeyondAscii) {
  const std::string text = printed(testing::literal_report(), {false, false, 100}, {true, ""});
  EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
}

TEST(Console, EveryCaseIsThereWorstFirst) {
  const std::string text = printed(testing::literal_report(), {false, false, 100});
  const std::size_t crashed = text.find("\ncollision/two_sphere"), listed = text.find("\nparticle/falling_box"),
                    unsupported = text.find("\nodd/");
  ASSERT_NE(unsupported, std::string::npos);
  EXPECT_LT(crashed, listed);
  EXPECT_LT(listed, unsupported);
}

TEST(Console, WhatWasNotRunSaysSo) {
  EXPECT_THAT(printed(testing::literal_report(), {false, false, 100}), HasSubstr("not run"));
  EXPECT_THAT(printed(Report{}, {false, false, 100}), HasSubstr("Nothing was run"));
}

TEST(Console, AnInterruptedReportSaysSo) {
  Report report = testing::literal_report();
  EXPECT_THAT(printed(report, {false, false, 100}), Not(HasSubstr("interrupted")));
  report.interrupted = true;
  EXPECT_THAT(printed(report, {false, false, 100}), HasSubstr("interrupted"));
}

TEST(Console, ExplainsTheErrorOfTheScheme) {
  EXPECT_THAT(printed(testing::literal_report(), {false, false, 120}),
              HasSubstr("0.196 m off, 3.60e-15 m off semi-implicit Euler: 100 % explained"));
}

TEST(Console, AFullComparisonStaysReadable) {
  const Report report = testing::large_report();
  ASSERT_GE(report.runs.size(), 528U);
  const std::string text = printed(report, {false, false, 130});
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 250);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 130U) << line;
  // A cause that many runs share is told once per case, not once per run.
  std::size_t told = 0;
  for (std::size_t at = 0; (at = text.find("known cause", at)) != std::string::npos; ++at) ++told;
  EXPECT_EQ(told, 8U);
}

}  // namespace
}  // namespace plumbline
