// [threshold]: what it becomes, and its faults.
#include <gtest/gtest.h>

#include <cmath>

#include "faulty_copy.hpp"

namespace plumbline {
namespace {

// The threshold begins in line 22.
const std::string kSound = R"(id = "test/reach"
about = "how fast a ball must be to get somewhere in time"
source = "none"
duration = 2
[parameters]
speed = 3
goal = 8
[derived]
double_speed = "2*speed"
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "ball"
shape = { sphere = 0.5 }
mass = 1
velocity = ["speed", 0, 0]
[[body]]
name = "floor"
shape = { half_space = [0, 0, 1] }
[threshold]
parameter = "speed"
between = [1, 10]
exact = "goal/2"
resolution = 0.25
body = "ball"
question = "x > goal"
[reference]
kind = "threshold"
[[gate]]
metric = "threshold.error"
limit = 0.5
reason = "the resolution"
)";

std::string fault(const std::string& sound, const std::string& faulty) {
  return fault_of(replaced(kSound, sound, faulty));
}

Threshold read(const std::string& text) { return read_scenario(text, "f.toml").at(0).scenario.threshold.value(); }

// One body at x after the duration, the floor where it is.
Trajectory ends_at(double x) {
  Trajectory trajectory(2, 2);
  for (const double place : {0.0, x}) trajectory.append()[0].p_WB.x() = place;
  return trajectory;
}

TEST(ThresholdReader, ReadsTheQuestionAndWhereItsAnswerChanges) {
  const Threshold threshold = read(kSound);
  EXPECT_EQ(threshold.parameter, "speed");
  EXPECT_EQ(threshold.question, "x > goal");
  EXPECT_EQ(threshold.low, 1);
  EXPECT_EQ(threshold.high, 10);
  EXPECT_EQ(threshold.exact, 4);
  EXPECT_EQ(threshold.resolution, 0.25);
  EXPECT_TRUE(threshold.exact_above);
  EXPECT_FALSE(read(replaced(kSound, "body = \"ball\"", "body = \"ball\"\nyes = \"below\"")).exact_above);
}

TEST(ThresholdReader, AsksTheStateAtTheEnd) {
  const Threshold threshold = read(kSound);
  EXPECT_TRUE(threshold.answer(ends_at(8.5)));
  EXPECT_FALSE(threshold.answer(ends_at(7.5)));
  EXPECT_FALSE(threshold.answer(ends_at(std::nan("")))) << "NaN is no yes";
}

TEST(ThresholdReader, MakesTheScenarioAnewForEveryValue) {
  const auto with = read(kSound).with(7);
  EXPECT_EQ(with->bodies.at(0).initial.v_WB.x(), 7);
  EXPECT_FALSE(with->threshold.has_value());
  EXPECT_EQ(read_scenario(kSound, "f.toml").at(0).scenario.bodies.at(0).initial.v_WB.x(), 3);
}

TEST(ThresholdReader, SaysWhatIsWrongAndTheWayOut) {
  EXPECT_EQ(
      fault("parameter = \"speed\"", "parameter = \"sped\""),
      "f.toml:23:13: /threshold/parameter: there is no parameter 'sped'; did you mean 'speed'? the parameters are: "
      "speed, goal");
  EXPECT_EQ(fault("speed = 3", "speed = [3, 4]"),
            "f.toml:23:13: /threshold/parameter: is swept already; the search varies it, so give it one value under "
            "[parameters]");
  EXPECT_EQ(fault("[1, 10]", "[10, 1]"), "f.toml:24:11: /threshold/between: must rise: [low, high]");
  EXPECT_EQ(fault("\"goal/2\"", "\"goal*2\""),
            "f.toml:25:9: /threshold/exact: is 16, outside the range 1 to 10 in which it is sought");
  EXPECT_EQ(fault("resolution = 0.25", "resolution = 1"),
            "f.toml:26:14: /threshold/resolution: is more than a tenth of the range; nothing would be found");
  EXPECT_EQ(fault("body = \"ball\"", "body = \"bal\""),
            "f.toml:27:8: /threshold/body: there is no body 'bal'; did you mean 'ball'? the bodies are: ball, floor");
  EXPECT_EQ(fault("body = \"ball\"", "body = \"ball\"\nyes = \"left\""),
            "f.toml:28:7: /threshold/yes: must be \"above\" or \"below\": where the answer is yes for the truth");
  EXPECT_EQ(
      fault("kind = \"threshold\"", "kind = \"closed_form\""),
      "f.toml:30:8: /reference/kind: a [threshold] asks for a value, not for a motion; write kind = \"threshold\"");
}

TEST(ThresholdReader, KeepsTheExactValueFreeOfWhatIsVaried) {
  EXPECT_NE(fault("\"goal/2\"", "\"goal/2 + 0*speed\"").find("f.toml:25:9: /threshold/exact: unknown symbol 'speed'"),
            std::string::npos);
}

}  // namespace
}  // namespace plumbline
