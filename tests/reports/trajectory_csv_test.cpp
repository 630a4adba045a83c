#include "plumbline/reports/trajectory_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "approved.hpp"
#include "literal_report.hpp"

namespace plumbline {
namespace {

using testing::file_text;
using testing::fresh_folder;

TEST(TrajectoryCsv, IsAsApproved) {
  const auto path = fresh_folder() / "made" / "on demand" / "trajectory.csv";
  write_trajectory(testing::two_body_trajectory(), testing::two_body_scenario(), path);
  EXPECT_TRUE(testing::matches_approved(file_text(path), "trajectory.csv"));
}

TEST(TrajectoryCsv, NumbersReadBackAsTheSameDoubles) {
  Scenario scenario;
  scenario.bodies = {{"ball", Sphere{1}, false, 1, Vec3::Zero(), {}}};
  Trajectory trajectory(0.02, 1);
  for (int k = 0; k < 500; ++k) {
    // Awkward magnitudes of either sign over the whole range of doubles.
    const double value = std::ldexp((k % 2 == 0 ? 1.0 : -1.0) / (3 + k), 4 * k - 1000);
    trajectory.append()[0].p_WB.x() = value;
  }
  const auto path = fresh_folder() / "t.csv";
  write_trajectory(trajectory, scenario, path);

  std::istringstream lines(file_text(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
  std::size_t k = 0;
  for (; std::getline(lines, line); ++k) {
    std::istringstream fields(line);
    std::string t, body, x;
    std::getline(fields, t, ',');
    std::getline(fields, body, ',');
    std::getline(fields, x, ',');
    double value = 0;
    std::from_chars(x.data(), x.data() + x.size(), value);
    EXPECT_EQ(value, trajectory.at(k, 0).p_WB.x());
    EXPECT_EQ(body, "ball");
  }
  EXPECT_EQ(k, trajectory.samples());
}

TEST(TrajectoryCsv, AFullDiskIsReportedWithThePath) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  try {
    write_trajectory(testing::two_body_trajectory(), testing::two_body_scenario(), "/dev/full");
    FAIL() << "a full disk went unnoticed";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("/dev/full: cannot be written: No space left"));
  }
}

TEST(TrajectoryCsv, RefusesAMotionOfOtherBodies) {
  EXPECT_THROW(write_trajectory(Trajectory(0.1, 1), testing::two_body_scenario(), fresh_folder() / "t.csv"),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
