// [reference] of every kind but closed_form, t_valid and tier: what they become, and their faults.
#include <gtest/gtest.h>

#include <cmath>

#include "faulty_copy.hpp"

namespace plumbline {
namespace {

// The reference begins in line 18.
const std::string kSound = R"(id = "test/fall"
about = "a ball falls"
source = "a book"
duration = 2
gravity = [0, 0, -10]
steps = [0.5, 0.25]
[parameters]
h = [20, 30]
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "ball"
shape = { sphere = 0.5 }
mass = 1
position = [0, 0, "h"]
[reference]
kind = "ode"
uncertainty = 1e-12
[[gate]]
metric = "energy.max"
limit = 1
reason = "none"
)";

const std::string kOde = "kind = \"ode\"\nuncertainty = 1e-12\n";
const std::string kTable = "kind = \"table\"\nuncertainty = 1e-3\n[[reference.row]]\nt = 1.5\nball.z = \"h - 11.25\"\n";

std::string fault(const std::string& sound, const std::string& faulty) {
  return fault_of(replaced(kSound, sound, faulty));
}

Case read(const std::string& reference) { return read_scenario(replaced(kSound, kOde, reference), "f.toml").at(0); }

TEST(ReferenceReader, IntegratesWhatNoFormulaStates) {
  const Case c = read(kOde);
  EXPECT_EQ(c.reference->kind(), "ode");
  EXPECT_EQ(c.reference->uncertainty(), 1e-12);
  EXPECT_EQ(c.reference->citation(), "a book");
  EXPECT_NEAR(c.reference->at(0, 1).p_WB.z(), 15, 1e-12);
  EXPECT_NEAR(c.reference->at(0, 2).v_WB.z(), -20, 1e-12);
}

TEST(ReferenceReader, FollowsTheImpactsOfSmoothSpheres) {
  const std::string ground =
      "[contact]\nrestitution = 0.5\nfriction = 0\n[[body]]\nname = \"ground\"\n"
      "shape = { half_space = [0, 0, 1] }\nposition = [0, 0, 9.5]\n";
  const std::string text =
      replaced(replaced(kSound, kOde, "kind = \"events\"\n"), "[reference]", ground + "[reference]");
  const Case c = read_scenario(text, "f.toml").at(0);
  EXPECT_EQ(c.reference->kind(), "events");
  // 10 m down in sqrt(2) s, up again with half of the speed.
  const double t0 = std::sqrt(2.0), s = 0.25;
  EXPECT_NEAR(c.reference->at(0, t0 + s).p_WB.z(), 10 + 5 * t0 * s - 5 * s * s, 1e-12);
}

TEST(ReferenceReader, KnowsATableAtItsTimesOnly) {
  // Energy is known throughout or not at all.
  const Case c = read_scenario(replaced(replaced(kSound, kOde, kTable), "energy.max", "position.max"), "f.toml").at(0);
  EXPECT_EQ(c.reference->kind(), "table");
  EXPECT_EQ(c.reference->uncertainty(), 1e-3);
  EXPECT_EQ(c.scenario.known_at, std::vector<double>{1.5});
  EXPECT_EQ(c.reference->at(0, 1.5).p_WB, Vec3(0, 0, 8.75));
}

TEST(ReferenceReader, SaysWhatIsWrongWithATable) {
  EXPECT_EQ(fault(kOde, "kind = \"table\"\n"),
            "f.toml:18:1: /reference/uncertainty: is missing; add uncertainty = 1e-6  # half a unit of the last digit "
            "printed");
  EXPECT_EQ(fault(kOde, "kind = \"table\"\nuncertainty = 1\n"),
            "f.toml:18:1: /reference: has no row; add [[reference.row]] with t and what is known then");
  EXPECT_EQ(fault(kOde, replaced(kTable, "t = 1.5", "t = 3")),
            "f.toml:22:5: /reference/row/0/t: is 3, outside the duration of 2 s");
  EXPECT_EQ(fault(kOde, replaced(kTable, "t = 1.5", "t = 1.25")),
            "f.toml:18:1: /reference: t = 1.25 is no whole number of steps of 0.5; change steps");
  EXPECT_EQ(fault(kOde, replaced(kTable, "ball.z", "bal.z")),
            "f.toml:23:1: /reference/row/0/bal: there is no body 'bal'; did you mean 'ball'? the bodies are: ball");
  EXPECT_EQ(
      fault(kOde, replaced(kTable, "ball.z", "ball.height")),
      "f.toml:23:6: /reference/row/0/ball/height: unknown key; allowed here: x, y, z, qw, qx, qy, qz, vx, vy, vz, "
      "wx, wy, wz");
}

TEST(ReferenceReader, SaysNothingOfAMotionOfWhichOnlyInvariantsAreKnown) {
  const Case c = read("kind = \"invariants\"\n");
  EXPECT_EQ(c.reference->kind(), "invariants");
  EXPECT_FALSE(c.scenario.pointwise);
  EXPECT_EQ(c.reference->at(0, 2).p_WB, c.scenario.bodies.at(0).initial.p_WB);
  const std::string text = replaced(replaced(kSound, kOde, "kind = \"invariants\"\n"), "energy.max", "position.max");
  EXPECT_NE(fault_of(text).find("f.toml:21:10: /gate/0/metric: position.max means nothing here"), std::string::npos)
      << fault_of(text);
}

TEST(ReferenceReader, RefusesWhatAKindCannotSolve) {
  const auto said = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const std::string contact = "[contact]\nrestitution = 1\nfriction = 0\n[reference]";
  said(fault("[reference]", contact), "f.toml:22:8: /reference/kind: ode does not solve this scenario: ");
  said(fault(kOde, "kind = \"ode\"\n"), "f.toml:18:1: /reference/uncertainty: is missing; add uncertainty = 1e-12");
  said(fault("\"ode\"", "\"odd\""), "f.toml:19:8: /reference/kind: unknown kind 'odd'; did you mean 'ode'? known: ");
  said(fault("\"ode\"", "\"threshold\""),
       "f.toml:19:8: /reference/kind: there is no [threshold]; add the question and its exact answer");
}

TEST(CaseReader, StatesHowLongTheMotionCanBeCompared) {
  EXPECT_EQ(read(kOde).scenario.t_valid, 2);
  EXPECT_EQ(read_scenario(replaced(kSound, "steps", "t_valid = \"h/25\"\nsteps"), "f.toml").at(0).scenario.t_valid,
            0.8);
  EXPECT_EQ(fault("steps", "t_valid = 2.5\nsteps"),
            "f.toml:6:11: /t_valid: is beyond the duration, 2 s; remove this line");
  EXPECT_EQ(fault("steps", "t_valid = 0\nsteps"), "f.toml:6:11: /t_valid: must be > 0, is 0");
}

TEST(CaseReader, PutsTheFirstCaseOfASweepIntoTheFirstTier) {
  const auto tiers = [](const std::string& line) {
    std::vector<Tier> result;
    for (const Case& c : read_scenario(replaced(kSound, "steps", line + "steps"), "f.toml")) {
      result.push_back(c.scenario.tier);
    }
    return result;
  };
  EXPECT_EQ(tiers(""), (std::vector{Tier::kSmoke, Tier::kStandard}));
  EXPECT_EQ(tiers("tier = \"smoke\"\n"), (std::vector{Tier::kSmoke, Tier::kStandard}));
  EXPECT_EQ(tiers("tier = \"standard\"\n"), (std::vector{Tier::kStandard, Tier::kStandard}));
  EXPECT_EQ(tiers("tier = \"full\"\n"), (std::vector{Tier::kFull, Tier::kFull}));
  EXPECT_EQ(fault("steps", "tier = \"ful\"\nsteps"),
            "f.toml:6:8: /tier: unknown tier 'ful'; did you mean 'full'? known: smoke, standard, full");
}

}  // namespace
}  // namespace plumbline
