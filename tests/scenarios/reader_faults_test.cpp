// Every way to get a scenario file wrong, with the whole message that the author sees.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

// A file without a fault; each row below puts one in.
constexpr const char* kSound = R"toml(id = "test/base"
about = "a ball"
source = "none"
duration = 2
[parameters]
v0 = 3
c = 0.5
[derived]
half = "v0/2"
[scales]
length = 1
time = 1
mass = 1
[contact]
restitution = 0
friction = 0
[[body]]
name = "ball"
shape = { sphere = 0.5 }
mass = 1
velocity = ["v0", 0, 0]
[[body]]
name = "floor"
shape = { half_space = [0, 0, 1] }
[[force]]
body = "ball"
force = ["-c*vx", 0, 0]
[reference]
kind = "closed_form"
citation = "none"
ball.x = "v0/c*(1 - exp(-c*t))"
ball.vx = "v0*exp(-c*t)"
[[event]]
name = "touch"
between = ["ball", "floor"]
time = 1
[[gate]]
metric = "position.max"
limit = "v0*dt"
reason = "first order"
)toml";

struct Fault {
  const char* name;
  std::string sound, faulty;  // the first occurrence of `sound` is replaced
  std::string message;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

const Fault kFaults[] = {
    {"SyntaxError", "duration = 2", "duration = ",
     R"x(f.toml:4:12: /: this is not TOML (Error while parsing key-value pair: expected value, saw '\n'); the form is `key = value`, with "quotes" around text and expressions)x"},
    {"WrongTypeOfId", "id = \"test/base\"", "id = 3", "f.toml:1:6: /id: must be text in quotes, is a number"},
    {"IdThatClimbsOut", "id = \"test/base\"", "id = \"../base\"",
     "f.toml:1:6: /id: must be \"family/case\", each of small letters, digits and _"},
    {"WrongTypeOfNumber", "mass = 1\nvelocity", "mass = true\nvelocity",
     "f.toml:20:8: /body/0/mass: must be a number or an expression in quotes"},
    {"UnknownKeyWithNearMiss", "mass = 1\nvelocity", "mas = 1\nvelocity",
     "f.toml:20:1: /body/0/mas: unknown key; did you mean 'mass'? allowed here: name, shape, mass, inertia, position, "
     "attitude, velocity, angular_velocity, fixed"},
    {"UnknownKeyAtTheTop", "duration = 2", "duration = 2\ncolour = 1",
     "f.toml:5:1: /colour: unknown key; allowed here: id, about, source, duration, t_valid, tier, steps, gravity, "
     "parameters, derived, scales, contact, body, joint, spring, force, threshold, reference, event, gate, "
     "certificate"},
    {"UnknownShape", "{ sphere = 0.5 }", "{ spere = 0.5 }",
     "f.toml:19:11: /body/0/shape/spere: unknown shape; did you mean 'sphere'? write { sphere = r }, { box = [x, y, z] "
     "}, { cylinder = [r, h] } or { half_space = [nx, ny, nz] }"},
    {"TwoShapes", "{ sphere = 0.5 }", "{ sphere = 0.5, box = [1, 1, 1] }",
     "f.toml:19:9: /body/0/shape: must name one shape: { sphere = r }, { box = [x, y, z] }, { cylinder = [r, h] } or { "
     "half_space = [nx, ny, nz] }"},
    {"TooFewComponents", "[\"v0\", 0, 0]", "[\"v0\", 0]",
     "f.toml:21:12: /body/0/velocity: must have 3 components, has 2"},
    {"TooManyEdges", "{ sphere = 0.5 }", "{ box = [1, 1, 1, 1] }",
     "f.toml:19:17: /body/0/shape/box: must have 3 components, has 4"},
    {"UndefinedSymbol", "\"-c*vx\"", "\"-c*v_x\"",
     R"x(f.toml:27:10: /force/0/force/0: unknown symbol 'v_x' in "-c*v_x"; did you mean 'vx'? known here: v0, c, half, t, x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz, pi)x"},
    {"UndefinedFunction", "exp(-c*t)\"\n[[event", "expo(-c*t)\"\n[[event",
     R"x(f.toml:32:11: /reference/ball/vx: unknown function 'expo' in "v0*expo(-c*t)"; did you mean 'exp'? known here: abs, acos, acosh, asin, asinh, atan, atan2, atanh, avg, ceil, cos, cosh, exp, floor, ln, log, log10, log2, max, min, mod, rint, sign, sin, sinh, sqrt, sum, tan, tanh)x"},
    {"ExpressionSyntax", "\"-c*vx\"", "\"-c**vx\"",
     R"x(f.toml:27:10: /force/0/force/0: cannot read the expression "-c**vx" (Unexpected operator "*" found at position 3); write it like "T/c*(1 - exp(-c*t/m))")x"},
    {"Assignment", "\"v0/2\"", "\"v0 = 2\"",
     "f.toml:9:8: /derived/half: \"v0 = 2\" assigns with '='; to compare, write '=='"},
    {"SeveralExpressions", "\"v0/2\"", "\"v0, 2\"",
     R"x(f.toml:9:8: /derived/half: "v0, 2" holds several expressions; write one, without commas outside of calls)x"},
    {"EmptyExpression", "\"v0/2\"", "\" \"", "f.toml:9:8: /derived/half: is empty; write what it stands for"},
    {"DerivedReadsALaterName", "half = \"v0/2\"",
     R"x(half = "quarter*2"
quarter = "v0/4")x",
     "f.toml:9:8: /derived/half: unknown symbol 'quarter' in \"quarter*2\"; known here: v0, c, pi"},
    {"NotFiniteExpression", "\"v0/2\"", "\"v0/0\"",
     "f.toml:9:8: /derived/half: must be finite, is inf; check the parameters"},
    {"BodyNameTwice", "name = \"floor\"", "name = \"ball\"",
     "f.toml:23:8: /body/1/name: the name 'ball' is used twice; give each body its own"},
    {"EventNameTwice", "[[gate]]",
     R"x([[event]]
name = "touch"
between = ["ball", "floor"]
time = 1.5
[[gate]])x",
     "f.toml:38:8: /event/1/name: the name 'touch' is used twice; give each event its own"},
    {"ParameterAndDerivedShareName", "half = ", "c = ",
     "f.toml:9:1: /derived/c: this name is used twice; [parameters] and [derived] share their names"},
    {"ReservedName", "c = 0.5", "dt = 0.5",
     "f.toml:7:1: /parameters/dt: this name already means something in expressions; choose another, for instance dt0"},
    {"NameThatIsNoWord", "c = 0.5", "\"c-1\" = 0.5",
     "f.toml:7:1: /parameters/c-1: cannot be used in expressions; a name has letters, digits and _, and begins with a "
     "letter"},
    {"MissingDuration", "duration = 2\n", "", "f.toml:1:1: /duration: is missing; add duration = 1.0  # s"},
    {"MissingMass", "mass = 1\nvelocity", "velocity", "f.toml:17:1: /body/0/mass: is missing; add mass = 1.0  # kg"},
    {"MissingScales", "[scales]\nlength = 1\ntime = 1\nmass = 1\n", "",
     "f.toml:1:1: /scales: is missing; add [scales] with length, time and mass: they make tolerances dimensionless"},
    {"MissingReference", R"x([reference]
kind = "closed_form"
citation = "none"
ball.x = "v0/c*(1 - exp(-c*t))"
ball.vx = "v0*exp(-c*t)"
)x",
     "", "f.toml:1:1: /reference: is missing; add [reference] with kind = \"closed_form\" and the solution"},
    {"NegativeMass", "mass = 1\nvelocity", "mass = -1\nvelocity", "f.toml:20:8: /body/0/mass: must be > 0, is -1"},
    {"ZeroDuration", "duration = 2", "duration = 0", "f.toml:4:12: /duration: must be > 0, is 0"},
    {"ZeroStep", "duration = 2", "duration = 2\nsteps = [0.01, 0]", "f.toml:5:16: /steps/1: must be > 0, is 0"},
    {"NoSteps", "duration = 2", "duration = 2\nsteps = []",
     "f.toml:5:9: /steps: is empty; give at least one dt, or remove the line for the default"},
    {"StepBeyondDuration", "duration = 2", "duration = 2\nsteps = [3]",
     "f.toml:5:10: /steps/0: is longer than the duration, 2 s"},
    {"RestitutionBeyondOne", "restitution = 0", "restitution = 1.5",
     "f.toml:15:15: /contact/restitution: must be in [0, 1], is 1.5; 0 is plastic, 1 elastic"},
    {"NegativeFriction", "friction = 0", "friction = -0.1", "f.toml:16:12: /contact/friction: must be >= 0, is -0.1"},
    {"ForceOnNobody", "body = \"ball\"", "body = \"bal\"",
     "f.toml:26:8: /force/0/body: there is no body 'bal'; did you mean 'ball'? the bodies are: ball, floor"},
    {"ForceOnFixedBody", "body = \"ball\"", "body = \"floor\"",
     "f.toml:26:8: /force/0/body: 'floor' is fixed, no force moves it; name another"},
    {"EventWithNobody", R"x(["ball", "floor"])x", R"x(["ball", "flor"])x",
     "f.toml:35:20: /event/0/between/1: there is no body 'flor'; did you mean 'floor'? the bodies are: ball, floor"},
    {"EventWithItself", R"x(["ball", "floor"])x", R"x(["ball", "ball"])x",
     "f.toml:35:11: /event/0/between: a body cannot meet itself; name two bodies"},
    {"EventWithoutContact", "[contact]\nrestitution = 0\nfriction = 0\n", "",
     "f.toml:32:11: /event/0/between: without [contact] nothing collides; add [contact] or remove the event"},
    {"EventBeforeTheStart", "time = 1\n[[gate", "time = -1\n[[gate", "f.toml:36:8: /event/0/time: must be >= 0, is -1"},
    {"ReferenceOfNobody", "ball.x = ", "bal.x = ",
     "f.toml:31:1: /reference/bal: there is no body 'bal'; did you mean 'ball'? the bodies are: ball, floor; other "
     "keys here: kind, citation, uncertainty, let"},
    {"ReferenceOfFixedBody", "[[event]]", "floor.z = \"0\"\n[[event]]",
     "f.toml:33:1: /reference/floor: 'floor' is fixed and keeps its place; remove this"},
    {"UnknownComponent", "ball.vx = ", "ball.speed = ",
     "f.toml:32:6: /reference/ball/speed: unknown key; allowed here: x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz"},
    {"UnknownReferenceKind", "\"closed_form\"", "\"guess\"",
     "f.toml:29:8: /reference/kind: unknown kind 'guess'; known: closed_form, solution, ode, events, table, "
     "invariants, "
     "threshold"},
    {"ReferenceStartsElsewhere", "\"v0/c*(1 - exp(-c*t))\"", "\"v0/c*(2 - exp(-c*t))\"",
     "f.toml:31:10: /reference/ball/x: ball.x is 6 at t = 0, but the body starts with 0; correct one of them"},
    {"ReferenceEndsInNothing", "\"v0/c*(1 - exp(-c*t))\"", "\"v0*t/(2 - t)\"",
     "f.toml:31:10: /reference/ball/x: ball.x is inf at the end, t = 2; the solution must hold for the whole duration"},
    {"GateWithoutReason", "reason = \"first order\"\n", "",
     "f.toml:37:1: /gate/0/reason: is missing; add reason = \"why this limit and no other\""},
    {"GateWithEmptyReason", "\"first order\"", "\"\"",
     "f.toml:40:10: /gate/0/reason: is empty; write what it stands for"},
    {"UnknownMetric", "\"position.max\"", "\"positon.max\"",
     "f.toml:38:10: /gate/0/metric: unknown metric 'positon.max'; did you mean 'position.max'? known: position.max, "
     "position.rms, position.final, velocity.max, velocity.rms, velocity.final, attitude.max, attitude.rms, "
     "attitude.final, angular_velocity.max, angular_velocity.rms, angular_velocity.final, energy.max, energy.final, "
     "momentum.max, momentum.final, angular_momentum.max, angular_momentum.final, event_time.max, events.missed, "
     "joint_gap.max, threshold.value, threshold.error"},
    {"EventMetricWithoutEvent", "time = 1\n[[gate]]\nmetric = \"position.max\"",
     "time = 3\n[[gate]]\nmetric = \"event_time.max\"",
     "f.toml:38:10: /gate/0/metric: event_time.max means nothing here: there is no event within the duration; add an "
     "[[event]]"},
    {"LimitThatIsZero", "\"v0*dt\"", "\"0*dt\"",
     "f.toml:39:9: /gate/0/limit: must be finite and > 0, is 0 at dt = 0.016666666666666666; a rounding term such as "
     "steps*unit_roundoff*length_scale keeps it above zero"},
    {"EmptySweep", "v0 = 3", "v0 = []", "f.toml:6:6: /parameters/v0: is an empty sweep; give at least one value"},
    {"ValueTwiceInSweep", "v0 = 3", "v0 = [3, 3.0]",
     "f.toml:6:6: /parameters/v0: the value 3 is there twice; name each value once"},
    {"ParameterNotFinite", "v0 = 3", "v0 = nan", "f.toml:6:6: /parameters/v0: must be finite, is nan"},
    {"ParameterThatIsText", "v0 = 3", "v0 = \"3\"",
     "f.toml:6:6: /parameters/v0: must be a number or an array of numbers, is a string; expressions belong under "
     "[derived]"},
    {"ZeroAttitude", "velocity = [", "attitude = [0, 0, 0, 0]\nvelocity = [",
     "f.toml:21:12: /body/0/attitude: must not be zero; [1, 0, 0, 0] (w, x, y, z) is no rotation"},
    {"ZeroNormal", "[0, 0, 1]", "[0, 0, 0]",
     "f.toml:24:24: /body/1/shape/half_space: must not be the zero vector; [0, 0, 1] points up"},
    {"MassOfHalfSpace", "{ half_space = [0, 0, 1] }", "{ half_space = [0, 0, 1] }\nmass = 1",
     "f.toml:25:8: /body/1/mass: a half_space is always fixed; remove this line"},
    {"ImpossibleInertia", "velocity = [", "inertia = [1, 1, 3]\nvelocity = [",
     "f.toml:21:11: /body/0/inertia: no body has these moments: the largest exceeds the sum of the other two"},
    {"SingleTableForBody", "[[force]]", "[force]",
     "f.toml:25:1: /force: must be an array of tables; write the header as [[force]]"},
    {"DateForANumber", "duration = 2", "duration = 2026-01-01",
     "f.toml:4:12: /duration: must be a number or an expression in quotes"},
};

class ReaderFaults : public testing::TestWithParam<Fault> {};

TEST_P(ReaderFaults, IsReportedWithItsPlaceAndTheWayOut) {
  std::string text = kSound;
  const std::size_t at = text.find(GetParam().sound);
  ASSERT_NE(at, std::string::npos) << "the row does not fit the file above";
  text.replace(at, GetParam().sound.size(), GetParam().faulty);
  try {
    read_scenario(text, "f.toml");
    FAIL() << "no error";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.what(), GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReaderFaults, testing::ValuesIn(kFaults),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Reader, AcceptsTheFileThatTheFaultsArePutInto) { EXPECT_EQ(read_scenario(kSound, "f.toml").size(), 1U); }

}  // namespace
}  // namespace plumbline
