// What a sound file turns into.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>

#include "plumbline/core/feature.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

constexpr const char* kHead = R"(
id = "test/small"
about = "a"
source = "s"
duration = 2
)";
constexpr const char* kTail = R"(
[scales]
length = 2
time = 4
mass = 3
[reference]
kind = "closed_form"
citation = "c"
)";
constexpr const char* kBox = R"(
[[body]]
name = "box"
shape = { box = [1, 2, 3] }
mass = 12
)";

std::string file_of(const std::string& middle) { return std::string(kHead) + middle + kTail; }

std::vector<Case> read(const std::string& middle, const Overrides& overrides = {}) {
  return read_scenario(file_of(middle), "f.toml", overrides);
}

std::vector<std::string> names(const std::vector<Case>& cases) {
  std::vector<std::string> result;
  for (const Case& c : cases) result.push_back(c.scenario.case_name());
  return result;
}

// The value of an expression, through the one door that there is. Parameters: a = 7, e = 0.5.
double value_of(const std::string& expression) {
  const auto cases =
      read("[parameters]\na = 7\ne = 0.5\n[derived]\nvalue = \"" + expression +
           "\"\n[[body]]\nname = \"b\"\nshape = { sphere = 1 }\nmass = 1\nposition = [\"value\", 0, 0]\n");
  return cases.at(0).scenario.bodies[0].initial.p_WB.x();
}

using Names = std::vector<std::string>;

TEST(Sweep, VariesTheLastParameterFastest) {
  EXPECT_EQ(names(read("[parameters]\ne = [0, 0.5]\nm = 1\nb = [0, 0.25]\n" + std::string(kBox))),
            (Names{"test/small/e=0,b=0", "test/small/e=0,b=0.25", "test/small/e=0.5,b=0", "test/small/e=0.5,b=0.25"}));
}

TEST(Sweep, OfNothingIsOneCaseNamedAfterTheFile) {
  EXPECT_EQ(names(read("[parameters]\nm = 1\n" + std::string(kBox))), Names{"test/small"});
}

TEST(Sweep, KeepsTheNameOfACaseWhenAnOverridePicksOneValue) {
  EXPECT_EQ(names(read("[parameters]\ne = [0, 0.5]\n" + std::string(kBox), {{"e", {0.5}}})), Names{"test/small/e=0.5"});
}

TEST(Sweep, ComesFromAnOverrideToo) {
  const auto cases = read("[parameters]\nm = 1\n" + std::string(kBox), {{"m", {2, 3}}});
  EXPECT_EQ(names(cases), (Names{"test/small/m=2", "test/small/m=3"}));
  EXPECT_EQ(cases[1].scenario.parameters, (Parameters{{"m", 3.0}}));
}

TEST(Sweep, IgnoresOverridesOfOtherFiles) {
  EXPECT_EQ(names(read(kBox, {{"somebody_elses", {1, 2}}})), Names{"test/small"});
}

TEST(Sweep, RefusesAnOverrideThatIsNotFinite) {
  try {
    read("[parameters]\nm = 1\n" + std::string(kBox), {{"m", {std::numeric_limits<double>::infinity()}}});
    FAIL() << "no error";
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(error.what(), "f.toml:7:5: /parameters/m: must be finite, is inf");
  }
}

TEST(Expressions, ComputeWhatTheySay) {
  EXPECT_EQ(value_of("a/2 + 1"), 4.5);
  EXPECT_EQ(value_of("2^3^2"), 512);  // powers bind to the right
  EXPECT_EQ(value_of("-2^2"), -4);    // and more tightly than the sign
  EXPECT_EQ(value_of("floor(-1.5)"), -2);
  EXPECT_EQ(value_of("ceil(-1.5)"), -1);
  EXPECT_EQ(value_of("mod(-1, 3)"), 2);
  EXPECT_EQ(value_of("a > 6 ? 1 : 0/0"), 1);
  EXPECT_EQ(value_of("a == 7 && a != 8"), 1);
  EXPECT_EQ(value_of("ln(exp(2))"), 2);
  EXPECT_EQ(value_of("log(a) - ln(a)"), 0);
  EXPECT_EQ(value_of("log10(1000)"), 3);
  EXPECT_EQ(value_of("pi"), std::numbers::pi);
}

TEST(Expressions, TellTheParameterEFromTheExponentOfANumber) {
  EXPECT_EQ(value_of("2e1 + e"), 20.5);
  EXPECT_EQ(value_of("1e-1*e"), 0.05);
  EXPECT_EQ(value_of("2.E+1"), 20);
}

TEST(Derived, NamesBuildOnEarlierOnesInTheOrderOfTheFile) {
  // zz is read first though it sorts last.
  const auto cases =
      read("[derived]\nzz = \"2\"\naa = \"zz*3\"\n[[body]]\nname = \"b\"\nshape = { sphere = \"aa\" }\nmass = 1\n");
  EXPECT_EQ(std::get<Sphere>(cases[0].scenario.bodies[0].shape).radius, 6);
}

TEST(Scenario, HasTheUsualStepsUnlessTheFileStatesThem) {
  EXPECT_EQ(read(kBox)[0].scenario.steps, (std::vector<double>{1.0 / 60, 0.02, 1.0 / 240, 1.0 / 1000}));
  EXPECT_EQ(read("steps = [\"1/8\", 0.5]\n" + std::string(kBox))[0].scenario.steps, (std::vector<double>{0.125, 0.5}));
}

TEST(Scenario, CarriesWhatTheFileStates) {
  const Scenario s =
      read(
          "gravity = [0, 0, -9.81]\n[contact]\nrestitution = 0.5\nfriction = 0.25\n[[body]]\nname = \"box\"\n"
          "shape = { box = [1, 2, 3] }\nmass = 12\nposition = [1, 2, 3]\nattitude = [0, 0, 0, 2]\n"
          "velocity = [4, 5, 6]\nangular_velocity = [7, 8, 9]\n[[body]]\nname = \"ground\"\n"
          "shape = { half_space = [0, 3, 4] }\nposition = [0, 0, -1]\n")[0]
          .scenario;
  EXPECT_EQ(s.gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(s.scales.length, 2);
  EXPECT_EQ(s.scales.time, 4);
  EXPECT_EQ(s.scales.mass, 3);
  EXPECT_EQ(s.contact->restitution, 0.5);
  EXPECT_EQ(s.contact->friction, 0.25);
  const Body& box = s.bodies[0];
  EXPECT_FALSE(box.fixed);
  EXPECT_EQ(box.mass, 12);
  EXPECT_EQ(box.inertia, Vec3(13, 10, 5));  // 12/12 (4 + 9, 9 + 1, 1 + 4)
  EXPECT_EQ(box.initial.p_WB, Vec3(1, 2, 3));
  EXPECT_EQ(box.initial.q_WB.coeffs(), Quat(0, 0, 0, 1).coeffs());
  EXPECT_EQ(box.initial.v_WB, Vec3(4, 5, 6));
  EXPECT_EQ(box.initial.w_WB, Vec3(7, 8, 9));
  EXPECT_TRUE(s.bodies[1].fixed);
  EXPECT_LE((std::get<HalfSpace>(s.bodies[1].shape).normal - Vec3(0, 0.6, 0.8)).norm(), 0x1p-52);  // one rounding
}

TEST(Scenario, DropsEventsBeyondItsEndAndSortsTheOthers) {
  const auto event = [](const std::string& name, const std::string& time) {
    return "[[event]]\nname = \"" + name + "\"\nbetween = [\"box\", \"ground\"]\ntime = " + time + "\n";
  };
  const Scenario s = read("[contact]\nrestitution = 0\nfriction = 0\n" + std::string(kBox) +
                          "[[body]]\nname = \"ground\"\nshape = { half_space = [0, 0, 1] }\n" + event("late", "1.5") +
                          event("never", "2.001") + event("early", "0.5"))[0]
                         .scenario;
  ASSERT_EQ(s.events.size(), 2U);
  EXPECT_EQ(s.events[0].name, "early");
  EXPECT_EQ(s.events[1].name, "late");
  EXPECT_EQ(s.events[1].body_b, 1U);
}

ForceLaw law_of(const std::string& force) {
  return read(std::string(kBox) + "[[force]]\nbody = \"box\"\n" + force)[0].scenario.forces.at(0);
}

TEST(ForceLaw, ReadsTimeAndTheWholeState) {
  const ForceLaw law = law_of(
      "force = [\"t + 10*x + 100*y\", \"z + 10*vx + 100*vy + 1000*vz\", \"wx + 10*wy + 100*wz\"]\n"
      "torque = [\"qw + 10*qx\", \"qy\", \"qz\"]\n");
  BodyState s;
  s.p_WB = {2, 3, 4};
  s.v_WB = {5, 6, 7};
  s.w_WB = {8, 9, 1};
  s.q_WB = Quat(0.5, 0.5, -0.5, 0.25);
  const Wrench w = law.evaluate(1, s);
  EXPECT_EQ(w.f_W, Vec3(1 + 20 + 300, 4 + 50 + 600 + 7000, 8 + 90 + 100));
  EXPECT_EQ(w.tau_W, Vec3(5.5, -0.5, 0.25));
}

TEST(ForceLaw, OffTheCentreOfMassTurnsTheBody) {
  const ForceLaw law = law_of("force = [0, 0, 5]\nat = [2, 0, 0]\n");
  BodyState s;
  s.q_WB = rotation_by({0, 0, std::numbers::pi / 2});  // the arm points along y now: y x z = x
  const Wrench w = law.evaluate(0, s);
  EXPECT_LE((w.tau_W - Vec3(10, 0, 0)).norm(), 10 * 8 * 0x1p-53);  // a rotation is a handful of products
  EXPECT_TRUE(law.has_torque);
}

TEST(ForceLaw, KnowsWhetherItLeavesThePlane) {
  const auto couples = [](const std::string& force) { return law_of(force).couples_out_of_plane; };
  EXPECT_FALSE(couples("force = [\"-vx\", \"-vy\", \"-z + qy + wy\"]\n"));  // y feels y only
  EXPECT_TRUE(couples("force = [\"vy\", 0, 0]\n"));
  EXPECT_TRUE(couples("force = [0, 0, \"wx\"]\n"));
  EXPECT_TRUE(couples("force = [\"qz\", 0, 0]\n"));
  EXPECT_FALSE(couples("force = [0, 0, 0]\ntorque = [\"0*2\", \"-wy\", 0]\n"));
  EXPECT_TRUE(couples("force = [0, 0, 0]\ntorque = [0, \"y\", 0]\n"));
  EXPECT_TRUE(couples("force = [0, 0, 0]\ntorque = [\"t\", 0, 0]\n"));
  EXPECT_TRUE(couples("force = [0, 0, 0]\ntorque = [0, 0, 1]\n"));
  EXPECT_FALSE(couples("force = [1, 0, 1]\nat = [1, 0, 1]\n"));
  EXPECT_TRUE(couples("force = [1, 0, 1]\nat = [0, 1, 0]\n"));
  EXPECT_TRUE(couples("force = [0, \"vy\", 0]\nat = [1, 0, 0]\n"));
}

TEST(ForceLaw, HasATorqueOnlyWhenOneCanAct) {
  EXPECT_FALSE(law_of("force = [1, 0, 0]\n").has_torque);
  EXPECT_FALSE(law_of("force = [1, 0, 0]\ntorque = [0, 0, 0]\nat = [0, 0, 0]\n").has_torque);
  EXPECT_TRUE(law_of("force = [1, 0, 0]\ntorque = [0, \"t\", 0]\n").has_torque);
}

TEST(ForceLaw, IsIndependentOfItsCopiesInOtherCases) {
  const auto cases =
      read("[parameters]\nc = [2, 3]\n" + std::string(kBox) + "[[force]]\nbody = \"box\"\nforce = [\"-c*vx\", 0, 0]\n");
  BodyState s;
  s.v_WB = {1, 0, 0};
  EXPECT_EQ(cases[0].scenario.forces[0].evaluate(0, s).f_W.x(), -2);
  EXPECT_EQ(cases[1].scenario.forces[0].evaluate(0, s).f_W.x(), -3);
  EXPECT_EQ(cases[0].scenario.forces[0].text, "force = [-c*vx, 0, 0] N");
}

TEST(Reference, KeepsTheInitialValueOfWhatIsNotStated) {
  const auto c = read_scenario(
      file_of(
          "[[body]]\nname = \"b\"\nshape = { sphere = 1 }\nmass = 1\nposition = [1, 2, 3]\nvelocity = [0, 4, 0]\n") +
          "b.y = \"2 + 4*t\"\n",
      "f.toml")[0];
  EXPECT_EQ(c.reference->at(0, 0.5).p_WB, Vec3(1, 4, 3));
  EXPECT_EQ(c.reference->at(0, 0.5).v_WB, Vec3(0, 4, 0));
  EXPECT_EQ(c.reference->kind(), "closed_form");
  EXPECT_EQ(c.reference->citation(), "c");
  EXPECT_EQ(c.reference->uncertainty(), 1e-14);
}

TEST(Reference, UsesTheNamesUnderLet) {
  const auto c = read_scenario(file_of("[[body]]\nname = \"b\"\nshape = { sphere = 1 }\nmass = 1\n") +
                                   "b.x = \"twice^2\"\n[reference.let]\nonce = \"3*t\"\ntwice = \"once + once\"\n",
                               "f.toml")[0];
  EXPECT_EQ(c.reference->at(0, 0.5).p_WB.x(), 9);
}

TEST(Gate, KnowsTheScalesTheDurationAndTheRun) {
  const auto c =
      read(std::string(kBox) +
           "[[gate]]\nmetric = \"position.max\"\nreason = \"r\"\n"
           "limit = \"dt + 10*steps + 1000*unit_roundoff + 1e4*duration + 1e5*length_scale + 1e6*time_scale + "
           "1e7*mass_scale + 1e8*velocity_scale + 1e9*energy_scale + 1e10*momentum_scale\"\n")[0];
  // length 2, time 4, mass 3: velocity 0.5, energy 0.75, momentum 1.5
  EXPECT_EQ(c.scenario.gates[0].limit({0.25, 8, 0.5}),
            0.25 + 80 + 500 + 2e4 + 2e5 + 4e6 + 3e7 + 0.5e8 + 0.75e9 + 1.5e10);
  EXPECT_EQ(c.scenario.gates[0].place.line, 14);
  EXPECT_EQ(c.scenario.gates[0].place.column, 9);
}

TEST(Documentation, ShowsAnExampleThatCanBeRead) {
  std::ifstream stream(PLUMBLINE_SOURCE_DIR "/docs/writing_a_scenario.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  const std::string fence = "```toml\n";
  const std::size_t begin = page.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::string example =
      page.substr(begin + fence.size(), page.find("\n```", begin + fence.size()) - begin - fence.size());
  EXPECT_EQ(names(read_scenario(example, "example.toml")),
            (Names{"particle/coasting/v0=1", "particle/coasting/v0=10"}));
}

class ScenarioFolder : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(root_ / "family"); }
  void TearDown() override { std::filesystem::remove_all(root_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ / name) << text;
    return root_ / name;
  }
  const std::filesystem::path root_ =
      std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(ScenarioFolder, HoldsItsFilesAndThoseOfItsFamiliesSortedByPath) {
  const auto b = write("family/b.toml", ""), a = write("family/a.toml", "");
  write("family/notes.md", "");
  const auto loose = write("loose.toml", "");
  EXPECT_EQ(find_scenario_files(root_), (std::vector<std::filesystem::path>{a, b, loose}));
}

TEST_F(ScenarioFolder, ThatIsMissingIsAnError) {
  EXPECT_THROW(find_scenario_files(root_ / "nowhere"), ScenarioError);
  EXPECT_THROW(read_scenario_file(root_ / "family/nothing.toml"), ScenarioError);
}

}  // namespace
}  // namespace plumbline
