// Second opinions: they hold on what is right, and name what is wrong.
#include "plumbline/harness/certification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

std::string catalogue(const std::string& id) {
  std::ifstream in(PLUMBLINE_SOURCE_DIR "/scenarios/" + id + ".toml", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& sound, const std::string& broken) {
  const std::size_t at = text.find(sound);
  if (at == std::string::npos) throw std::invalid_argument("not in the file: " + sound);
  return text.replace(at, sound.size(), broken);
}

Certification certified(const std::string& text) {
  const Case c = read_scenario(text, "f.toml").at(0);
  return certify(c.scenario, *c.reference);
}

const CertificationRow* row(const Certification& certification, const std::string& source) {
  const auto found = std::find_if(certification.rows.begin(), certification.rows.end(),
                                  [&](const CertificationRow& r) { return r.source == source; });
  return found == certification.rows.end() ? nullptr : &*found;
}

std::string described(const Certification& certification) {
  std::string text;
  for (const CertificationRow& r : certification.rows) {
    text += r.source + ": " + r.compared + ": " + std::to_string(r.figure) + " of " + std::to_string(r.bound) + "\n";
  }
  for (const std::string& why : certification.left_out) text += "left out: " + why + "\n";
  return text;
}

// A ball on a spring: every number below is by hand.
const std::string kOscillator = R"toml(id = "test/oscillator"
about = "a ball on a spring"
source = "none"
duration = 6
[parameters]
k = 4
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1
position = [1, 0, 0]
[[spring]]
name = "coil"
between = ["world", "ball"]
anchors = [[0, 0, 0], [1, 0, 0]]
stiffness = "k"
length = 0
[reference]
kind = "closed_form"
ball.x = "cos(2*t)"
ball.vx = "-2*sin(2*t)"
[[gate]]
metric = "position.max"
limit = 1
reason = "none"
)toml";

struct Slip {
  const char* name;
  std::string file, sound, broken, source;
};
void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.name; }

// One constant wrong, by a millionth or so; each must be found by the source that can.
const Slip kSlips[] = {
    {"ConstantForce", "particle/falling_box", "f/m*t^2/2\"", "f/m*t^2/2*(1 + 1e-6)\"", "motion"},
    {"VelocityOfConstantForce", "particle/falling_box", "3 - f/m*t\"", "3 - 1.000001*f/m*t\"", "motion"},
    {"TerminalVelocity", "particle/drag_ship", "ship.vx = \"terminal - (terminal",
     "ship.vx = \"1.000001*terminal - (1.000001*terminal", "motion"},
    {"TimeOfImpact", "collision/bouncing_ball", "time = \"t0*(1 + 2*e)\"", "time = \"1.000001*t0*(1 + 2*e)\"", "touch"},
    {"ReboundSpeed", "collision/bouncing_ball", "u = \"e^n*V\"  ", "u = \"(n == 0 ? 1 : 1.000001)*e^n*V\"  ",
     "simulation"},
    {"Impulse", "collision/two_sphere", "two.vx = \"u2 + J/m2*nx*hit\"", "two.vx = \"u2 + 1.00001*J/m2*nx*hit\"",
     "simulation"},
    {"HeightAtRest", "collision/box_drop", "g*t^2/2 : a/2\"", "g*t^2/2 : 0.50001*a\"", "simulation"},
    {"SlidingFriction", "friction/incline", "slides*g*(sin(slope) - mu*cos(slope))",
     "slides*g*(sin(slope) - 1.00001*mu*cos(slope))", "simulation"},
};

class Slips : public testing::TestWithParam<Slip> {};

TEST_P(Slips, IsFoundByTheSourceThatCan) {
  const Slip& slip = GetParam();
  const std::string text = catalogue(slip.file);
  const Certification sound = certified(text);
  EXPECT_TRUE(sound.holds()) << described(sound);
  const Certification broken = certified(replaced(text, slip.sound, slip.broken));
  EXPECT_FALSE(broken.holds()) << described(broken);
  EXPECT_TRUE(std::any_of(broken.rows.begin(), broken.rows.end(), [&](const CertificationRow& r) {
    return r.source == slip.source && !r.holds();
  })) << described(broken);
}

INSTANTIATE_TEST_SUITE_P(All, Slips, testing::ValuesIn(kSlips),
                         [](const auto& slip) { return std::string(slip.param.name); });

TEST(Certification, HoldsOfARightSolutionFarBelowWhatASlipWouldGive) {
  const Certification c = certified(kOscillator);
  EXPECT_TRUE(c.holds()) << described(c);
  ASSERT_NE(row(c, "motion"), nullptr);
  EXPECT_LE(row(c, "motion")->bound, 1e-11);
  EXPECT_EQ(row(c, "invariant")->independent, false) << "a wrong motion can keep the energy";
}

TEST(Certification, FindsAMotionThatKeepsTheEnergyButNotTheTime) {
  std::string text = replaced(kOscillator, "cos(2*t)", "cos(2.000001*t)");
  text = replaced(text, "-2*sin(2*t)", "-2*sin(2.000001*t)");
  const Certification c = certified(text);
  EXPECT_TRUE(row(c, "invariant")->holds()) << described(c);
  EXPECT_FALSE(row(c, "motion")->holds());
}

TEST(Certification, FollowsForcesThatJump) {
  // Pushed with 1 N for one second, and then not; t = 1 lies inside of a span.
  std::string text =
      replaced(kOscillator, "[[spring]]", "[[force]]\nbody = \"ball\"\nforce = [\"t < 1 ? k : 0\", 0, 0]\n[[spring]]");
  text = replaced(text, "stiffness = \"k\"", "stiffness = 0");
  text = replaced(text, "\"cos(2*t)\"", "\"1 + (t < 1 ? k*t^2/2 : k*(t - 0.5))\"");
  text = replaced(text, "\"-2*sin(2*t)\"", "\"k*min(t, 1)\"");
  const Certification sound = certified(text);
  EXPECT_TRUE(sound.holds()) << described(sound);
  const Certification late = certified(replaced(text, "t < 1 ? k : 0", "t < 1.001 ? k : 0"));
  EXPECT_FALSE(row(late, "motion")->holds()) << described(late);
}

TEST(Certification, WantsTheReferenceToStartWhereTheBodiesDo) {
  // Within what the reader lets pass, 1e-9, and a solution of the equation of motion all the same.
  const Certification c = certified(replaced(kOscillator, "position = [1, 0, 0]", "position = [1.0000000001, 0, 0]"));
  EXPECT_FALSE(row(c, "start")->holds()) << described(c);
}

TEST(Certification, HoldsCertificatesAtTheirTimeOrAtAllTimes) {
  const auto with = [](const std::string& quantity, const std::string& rest) {
    return certified(kOscillator + "[[certificate]]\nquantity = \"" + quantity + "\"\nequals = 0\nwithin = 1e-12\n" +
                     rest + "source = \"by hand\"\n");
  };
  EXPECT_TRUE(with("ball_x^2 + ball_vx^2/4 - 1", "").holds());
  EXPECT_TRUE(with("ball_x - cos(3)", "time = 1.5\n").holds());
  const Certification wrong = with("ball_x - 0.99*cos(3)", "time = 1.5\n");
  ASSERT_NE(wrong.failure(), nullptr);
  EXPECT_EQ(wrong.failure()->source, "certificate");
  EXPECT_NEAR(wrong.failure()->figure, -0.01 * std::cos(3), 1e-12);
  EXPECT_EQ(wrong.failure()->place.file, "f.toml");
  EXPECT_EQ(wrong.failure()->place.line, 31);
  EXPECT_FALSE(with("ball_x - 1", "").holds()) << "right at the start, and only there";
}

TEST(Certification, TakesNaNForAFailure) {
  const Certification c = certified(kOscillator +
                                    "[[certificate]]\nquantity = \"sqrt(ball_x - 2)\"\nequals = 0\nwithin = 1e9\n"
                                    "source = \"nobody\"\n");
  EXPECT_FALSE(c.holds());
  ASSERT_NE(c.failure(), nullptr);
  EXPECT_EQ(c.failure()->source, "certificate");
  EXPECT_TRUE(std::isnan(c.failure()->figure));
}

// Two cylinders that never meet: the core has no contact of cylinders, so that it cannot say anything about them.
TEST(Certification, FailsWithoutASecondSourceAndSaysWhatIsMissing) {
  std::string text = replaced(kOscillator, "shape = { sphere = 0.1 }", "shape = { cylinder = [0.1, 1] }");
  text = replaced(text, "[scales]", "[contact]\nrestitution = 0\nfriction = 0\n[scales]");
  text = replaced(text, "[reference]",
                  "[[body]]\nname = \"other\"\nshape = { cylinder = [0.1, 1] }\nmass = 1\nposition = [0, 9, 0]\n"
                  "[reference]");
  const Certification c = certified(text);
  EXPECT_EQ(c.failure(), nullptr) << described(c);
  EXPECT_FALSE(c.has_second_source());
  EXPECT_FALSE(c.holds());
  ASSERT_FALSE(c.left_out.empty());
  EXPECT_NE(c.left_out.front().find("cylinder"), std::string::npos) << c.left_out.front();
  const Certification helped = certified(text +
                                         "[[certificate]]\nquantity = \"ball_x\"\nequals = \"cos(2*t)\"\n"
                                         "within = 1e-12\nsource = \"by hand\"\n");
  EXPECT_TRUE(helped.holds()) << described(helped);
}

const std::string kIntegrated = "[reference]\nkind = \"ode\"\nuncertainty = 1e-12\n[[gate]]";

std::string integrated(const std::string& text) {
  const std::size_t from = text.find("[reference]"), to = text.find("[[gate]]");
  std::string result = text;
  return result.replace(from, to - from + 8, kIntegrated);
}

TEST(Certification, ComparesMethodsOfIntegration) {
  const Certification c = certified(integrated(kOscillator));
  EXPECT_TRUE(c.holds()) << described(c);
  ASSERT_NE(row(c, "agreement"), nullptr);
  EXPECT_EQ(std::count_if(c.rows.begin(), c.rows.end(), [](const auto& r) { return r.source == "agreement"; }), 2);
  // Nobody can be that sure.
  const Certification proud = certified(replaced(integrated(kOscillator), "1e-12", "1e-30"));
  EXPECT_FALSE(proud.holds()) << described(proud);
}

TEST(Certification, NamesATimeOfValidityThatIsNot) {
  const Certification c = certified(replaced(integrated(kOscillator), "duration = 6", "duration = 6\nt_valid = 3"));
  ASSERT_NE(c.failure(), nullptr) << described(c);
  EXPECT_EQ(c.failure()->source, "validity") << "an oscillator magnifies nothing: it is valid to the end";
  EXPECT_NEAR(c.failure()->figure, 0.5, 1e-12);
}

TEST(Certification, ComparesATableWithAnIntegration) {
  // Places only, at t = 1 and t = 2.5; cos(2) and cos(5) by a table of cosines.
  const auto table = [](const std::string& x) {
    std::string text = kOscillator;
    const std::size_t from = text.find("[reference]"), to = text.find("[[gate]]");
    text.replace(from, to - from,
                 "[reference]\nkind = \"table\"\nuncertainty = 1e-9\n[[reference.row]]\nt = 1\n"
                 "ball.x = -0.4161468365\n[[reference.row]]\nt = 2.5\nball.x = " +
                     x + "\n");
    return replaced(text, "duration = 6", "duration = 6\nsteps = [0.5]");
  };
  const Certification sound = certified(table("0.2836621855")), wrong = certified(table("0.2836621955"));
  EXPECT_TRUE(sound.holds()) << described(sound);
  ASSERT_NE(wrong.failure(), nullptr) << described(wrong);
  EXPECT_NE(wrong.failure()->compared.find("t = 2.5"), std::string::npos);
}

TEST(Certification, KnowsWhatNothingChanges) {
  const auto with = [](const std::string& metric, const std::string& change) {
    std::string text = kOscillator;
    const std::size_t from = text.find("[reference]"), to = text.find("[[gate]]");
    text.replace(from, to - from, "[reference]\nkind = \"invariants\"\n");
    text = replaced(replaced(text, "position.max", metric), "limit = 1", "limit = 1e-3");
    return certified(replaced(text, "length = 0", "length = 0\n" + change));
  };
  EXPECT_TRUE(with("energy.max", "").holds());
  EXPECT_FALSE(with("energy.max", "damping = 0.1").holds()) << "the damper takes it";
  EXPECT_FALSE(with("momentum.max", "").holds()) << "the spring hangs on the world";
}

TEST(Certification, FindsTheCriticalValueByItself) {
  // A box on a slope: gravity is tilted, mu = 0.5 holds it up to atan(0.5).
  const std::string slope = R"toml(id = "test/slope"
about = "a box on a slope"
source = "none"
duration = 1
gravity = ["10*sin(degrees*pi/180)", 0, "-10*cos(degrees*pi/180)"]
steps = [0.01]
[parameters]
degrees = 20
mu = 0.5
[scales]
length = 1
time = 1
mass = 1
[contact]
restitution = 0
friction = "mu"
[[body]]
name = "ground"
shape = { half_space = [0, 0, 1] }
[[body]]
name = "box"
shape = { box = [1, 1, 0.5] }
mass = 1
position = [0, 0, 0.25]
[threshold]
parameter = "degrees"
between = [20, 35]
exact = "atan(mu)*180/pi"
resolution = 0.1
body = "box"
question = "x > 0.001"
[reference]
kind = "threshold"
[[gate]]
metric = "threshold.error"
limit = 0.1
reason = "the resolution"
)toml";
  const Certification sound = certified(slope), wrong = certified(replaced(slope, "\"atan(mu)*180/pi\"", "27"));
  EXPECT_TRUE(sound.holds()) << described(sound);
  EXPECT_FALSE(wrong.holds()) << described(wrong);
}

}  // namespace
}  // namespace plumbline
