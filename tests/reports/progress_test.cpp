#include "plumbline/reports/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace plumbline {
namespace {

using ::testing::HasSubstr;
using Mode = Progress::Mode;

VerdictCounts failures(std::size_t count) {
  VerdictCounts counts{};
  counts[static_cast<std::size_t>(Verdict::kPass)] = 100;
  counts[static_cast<std::size_t>(Verdict::kExpectedFail)] = 5;  // expected: not a failure
  counts[static_cast<std::size_t>(Verdict::kFail)] = count;
  return counts;
}

TEST(Progress, OnATerminalRedrawsOneLine) {
  std::ostringstream out;
  double now = 5;
  Progress progress(out, Mode::kRedraw, 80, [&] { return now; });
  progress.begin(528);
  now += 2;
  progress.update(132, "collision/two_sphere beta-f32", failures(3));
  EXPECT_EQ(out.str(), "\r\x1b[K[132/528] collision/two_sphere beta-f32 ... 3 failed, ETA 6 s");
  progress.end();
  EXPECT_THAT(out.str(), ::testing::EndsWith("\r\x1b[K"));
  const auto length = out.str().size();
  progress.end();
  EXPECT_EQ(out.str().size(), length);
}

TEST(Progress, DrawsAtMostTenTimesASecond) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, Mode::kRedraw, 80, [&] { return now; });
  progress.begin(1000);
  for (std::size_t k = 1; k <= 1000; ++k) {
    now += 0.001;
    progress.update(k, "x", {});
  }
  std::size_t drawn = 0;
  for (const char c : out.str()) drawn += c == '\r' ? 1 : 0;
  EXPECT_GE(drawn, 9U);
  EXPECT_LE(drawn, 11U);
}

TEST(Progress, NeverWrapsALineOfTheTerminal) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, Mode::kRedraw, 50, [&] { return now; });
  progress.begin(528);
  now = 1;
  progress.update(1, std::string(300, 'x') + "\n\x1b[31m", failures(3));
  const std::string line = out.str().substr(std::string("\r\x1b[K").size());
  EXPECT_LT(line.size(), 50U);
  EXPECT_EQ(line.find_first_of("\n\x1b"), std::string::npos);
  EXPECT_THAT(line, HasSubstr("3 failed, ETA"));
}

TEST(Progress, WithoutATerminalWritesAPlainLineEveryTenSeconds) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, Mode::kLines, 80, [&] { return now; });
  progress.begin(100);
  for (std::size_t k = 1; k <= 25; ++k) {
    now += 1;
    progress.update(k, "case", {});
  }
  progress.end();
  EXPECT_EQ(out.str(), "[ 10/100] case ... ETA 1 min 30 s\n[ 20/100] case ... ETA 1 min 20 s\n");
}

TEST(Progress, SilentWritesNothing) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, Mode::kSilent, 80, [&] { return now; });
  progress.begin(2);
  now = 100;
  progress.update(1, "case", failures(1));
  progress.end();
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace plumbline
