// Who checks the reference? Each closed form against its own equation of motion, its conserved quantities, its limits
// and numbers computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/force_following.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

const std::string kFolder = PLUMBLINE_SOURCE_DIR "/scenarios/";
constexpr double kU = 0x1p-53;

std::vector<Case> cases_of(const std::string& id) { return read_scenario_file(kFolder + id + ".toml"); }

const Case& case_named(const std::vector<Case>& cases, const std::string& name) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.scenario.case_name() == name; });
  if (found == cases.end()) throw std::invalid_argument("no case " + name);
  return *found;
}

std::vector<BodyState> states_at(const Case& c, double t) {
  std::vector<BodyState> states;
  for (std::size_t b = 0; b < c.scenario.bodies.size(); ++b) states.push_back(c.reference->at(b, t));
  return states;
}

double parameter(const Case& c, const std::string& name) {
  for (const auto& [key, value] : c.scenario.parameters) {
    if (key == name) return value;
  }
  throw std::invalid_argument("no parameter " + name);
}

// The largest number that the evaluation of a position or of a velocity handles, in units of length.
double reach(const Scenario& s) {
  double largest = s.scales.length;
  for (const Body& b : s.bodies)
    largest = std::max(largest, b.initial.p_WB.norm() + b.initial.v_WB.norm() * s.duration);
  return largest + s.gravity.norm() * s.duration * s.duration;
}

// What the equations of motion give in the state of the reference: gravity, force laws, springs, drives and joints, and
// the gyroscopic term; but no contact.
std::vector<Acceleration> accelerations(const Case& c, const AccelerationField& field, double t) {
  std::vector<Acceleration> result(c.scenario.bodies.size());
  const auto states = states_at(c, t);
  field(t, states, result);
  return result;
}

// Times of free motion: away from events by 2 delta, and before the first event where the bodies stay in contact.
std::vector<double> free_times(const Scenario& s, double delta) {
  const bool rests = s.contact && s.contact->restitution == 0 && s.gravity.norm() > 0 && !s.events.empty();
  std::vector<double> times;
  for (int i = 1; i < 400; ++i) {
    const double t = s.duration * i / 400;
    if (rests && t > s.events.front().time - 2 * delta) break;
    if (std::all_of(s.events.begin(), s.events.end(),
                    [&](const Event& e) { return std::abs(e.time - t) > 2 * delta; })) {
      times.push_back(t);
    }
  }
  return times;
}

// Whether the reference is a formula for motion that is free between the stated events: not where nothing is said of
// the motion, not what is computed from these very equations, and not what touches from the start or turns about an
// edge on the ground: contact_truth_test.cpp looks at that.
bool moves_freely(const Case& c) {
  const Scenario& s = c.scenario;
  const std::string_view kind = c.reference->kind();
  const bool computed = kind == "events" || kind == "ode", held = s.contact && (s.events.empty() || kind == "solution");
  const bool stopped =
      std::any_of(s.joints.begin(), s.joints.end(), [](const Joint& j) { return j.range.has_value(); });
  return s.pointwise && s.known_at.empty() && !s.threshold && !computed && !held && !stopped;
}

class EveryScenario : public testing::TestWithParam<std::string> {};

// The id is how people find the file again.
TEST_P(EveryScenario, IsCalledAsItsFileIs) {
  for (const Case& c : cases_of(GetParam())) EXPECT_EQ(c.scenario.id, GetParam());
}

TEST_P(EveryScenario, SatisfiesItsEquationOfMotion) {
  for (const Case& c : cases_of(GetParam())) {
    if (!moves_freely(c)) continue;
    const Scenario& s = c.scenario;
    const AccelerationField field = acceleration_field(s);
    const double delta = 1e-5 * s.scales.time;
    // A central difference is off by delta^2/6 of the third derivative (at most velocity/time^2 in these scenarios:
    // only the drag has one) and by the rounding of its two values; 32 operations is more than any expression has.
    const double truncation = delta * delta / 6 * s.scales.velocity() / (s.scales.time * s.scales.time);
    const double speed_error = truncation + 32 * kU * reach(s) / delta;
    const double acceleration_error = speed_error / s.scales.time + 32 * kU * (reach(s) / s.scales.time + 30) / delta;
    const auto times = free_times(s, delta);
    ASSERT_GT(times.size(), 100U);
    for (double t : times) {
      const auto expected = accelerations(c, field, t);
      for (std::size_t b = 0; b < s.bodies.size(); ++b) {
        if (s.bodies[b].fixed) continue;
        const BodyState before = c.reference->at(b, t - delta), now = c.reference->at(b, t),
                        after = c.reference->at(b, t + delta);
        ASSERT_LE(((after.p_WB - before.p_WB) / (2 * delta) - now.v_WB).norm(), speed_error)
            << s.case_name() << " t = " << t;
        ASSERT_LE(((after.v_WB - before.v_WB) / (2 * delta) - expected[b].linear).norm(), acceleration_error)
            << s.case_name() << " t = " << t;
        // Attitudes and their rates, in units of 1/time_scale: w reaches some 10 of them here, if it is not a fast
        // top's, and its third derivative their cube.
        const double w_scale = std::max(10 / s.scales.time, 2 * now.w_WB.norm());
        const double turn_error = delta * delta * std::pow(w_scale, 3) + 64 * kU / delta;
        const Quat turn = after.q_WB * before.q_WB.conjugate();  // by so small an angle that it is twice its vector
        ASSERT_LE((turn.vec() * std::copysign(1 / delta, turn.w()) - now.w_WB).norm(), turn_error)
            << s.case_name() << " t = " << t;
        ASSERT_LE(((after.w_WB - before.w_WB) / (2 * delta) - expected[b].angular).norm(), turn_error * w_scale)
            << s.case_name() << " t = " << t;
      }
    }
  }
}

TEST_P(EveryScenario, IsContinuousInPlaceAndJumpsInSpeedAtItsEvents) {
  for (const Case& c : cases_of(GetParam())) {
    const Scenario& s = c.scenario;
    const double eta = 1e-9;  // either side of the event, far above the rounding of t and far below any motion
    for (const Event& e : s.events) {
      double jump = 0;
      for (std::size_t b : {e.body_a, e.body_b}) {
        const BodyState before = c.reference->at(b, e.time - eta), after = c.reference->at(b, e.time + eta);
        const double travel = 2 * eta * std::max(before.v_WB.norm(), after.v_WB.norm());
        EXPECT_LE((after.p_WB - before.p_WB).norm(), travel + 32 * kU * reach(s)) << s.case_name() << ' ' << e.name;
        jump = std::max(jump, (after.v_WB - before.v_WB).norm());
      }
      EXPECT_GT(jump, 0.1 * s.scales.velocity()) << s.case_name() << ' ' << e.name;
    }
  }
}

TEST_P(EveryScenario, KeepsItsEventsOffTheStepBoundaries) {
  for (const Case& c : cases_of(GetParam())) {
    for (const Event& e : c.scenario.events) {
      for (double dt : c.scenario.steps) {
        const double phase = e.time / dt - std::floor(e.time / dt);
        EXPECT_GE(std::min(phase, 1 - phase), 0.1) << c.scenario.case_name() << ' ' << e.name << " dt = " << dt;
      }
    }
  }
}

// Every file there is: a new scenario is checked without a line of code.
std::vector<std::string> all_ids() {
  std::vector<std::string> ids;
  for (const auto& file : find_scenario_files(kFolder)) {
    ids.push_back((file.parent_path().filename() / file.stem()).generic_string());
  }
  return ids;
}

INSTANTIATE_TEST_SUITE_P(Files, EveryScenario, testing::ValuesIn(all_ids()),
                         [](const auto& row) { return row.param.substr(row.param.find('/') + 1); });

TEST(FallingBox, StartsAndEndsWhereTheSlideSaysTurnedToZUp) {
  const auto cases = cases_of("particle/falling_box");
  const Case& c = cases.at(0);
  const auto turned = [](double x, double y, double z) { return Vec3(x, -z, y); };
  EXPECT_EQ(c.scenario.bodies[0].initial.p_WB, turned(0, 5, 0));
  EXPECT_EQ(c.scenario.bodies[0].initial.v_WB, turned(2, 3, -1));
  EXPECT_EQ(c.scenario.forces[0].evaluate(0, {}).f_W, turned(0, -9.8, 0));
  EXPECT_EQ(c.scenario.gravity, Vec3::Zero());
  EXPECT_EQ(c.scenario.step_count(0.02), 100U);
  // (0, 5, 0) + 2 (2, 3, -1) + 2 (0, -9.8, 0), by hand: (4, -8.6, -2). Ten roundings of numbers below 20.
  EXPECT_LE((c.reference->at(0, 2).p_WB - turned(4, -8.6, -2)).norm(), 10 * 20 * kU);
  EXPECT_LE((c.reference->at(0, 2).v_WB - turned(2, -16.6, -1)).norm(), 10 * 20 * kU);
}

TEST(FallingBox, KeepsTheEnergyInTheFieldOfItsForce) {
  const auto cases = cases_of("particle/falling_box");
  const auto energy_at = [&](double t) {
    const BodyState s = cases[0].reference->at(0, t);
    return 0.5 * s.v_WB.squaredNorm() + 9.8 * s.p_WB.z();
  };
  for (double t : {0.5, 1.0, 1.7, 2.0}) EXPECT_NEAR(energy_at(t), 7 + 49, 10 * 140 * kU);  // terms up to 140 J
}

// exp(-1) by its alternating series: the first term left out, 1/20!, is below the rounding.
double inverse_of_e() {
  double sum = 0, term = 1;
  for (int k = 1; k < 20; ++k) {
    sum += term;
    term *= -1.0 / k;
  }
  return sum;
}

TEST(DragShip, HasLeftOneEthOfTheWayToTerminalVelocityAfterOneTimeConstant) {
  for (const Case& c : cases_of("particle/drag_ship")) {
    const double v0 = parameter(c, "v0");
    EXPECT_NEAR(c.reference->at(0, 4).v_WB.x(), 20 + (v0 - 20) * inverse_of_e(), 10 * 30 * kU);
  }
}

TEST(DragShip, TravelsTheDistanceComputedByHand) {
  // s(4) = 80 + (20 - v0) 4 (1/e - 1): 80/e from rest, 120 - 40/e from 30 m/s.
  const auto cases = cases_of("particle/drag_ship");
  EXPECT_NEAR(case_named(cases, "particle/drag_ship/v0=0").reference->at(0, 4).p_WB.x(), 29.430355293715, 5e-13);
  EXPECT_NEAR(case_named(cases, "particle/drag_ship/v0=30").reference->at(0, 4).p_WB.x(), 105.284822353142, 5e-13);
}

TEST(DragShip, ApproachesItsTerminalVelocityAndNeitherSinksNorRises) {
  for (const Case& c : cases_of("particle/drag_ship")) {
    const BodyState s = c.reference->at(0, 160);  // 40 time constants: exp(-40) is below the rounding
    EXPECT_NEAR(s.v_WB.x(), 20, 10 * 20 * kU);
    EXPECT_EQ(s.p_WB.z(), 0);
    EXPECT_EQ(s.v_WB.z(), 0);
  }
}

TEST(DragShip, SpendsTheWorkOfThrustOnDragAndOnKineticEnergy) {
  for (const Case& c : cases_of("particle/drag_ship")) {
    const double m = 1000, thrust = 5000, drag = 250, t_end = 4;
    // Simpson's rule for the integral of c v^2; its error t_end h^4/180 |f''''| with f'''' <= 16 c 40^2/4^4 is 1e-6 J.
    const int n = 400;
    const double h = t_end / n;
    double dissipated = 0;
    for (int i = 0; i <= n; ++i) {
      const double v = c.reference->at(0, i * h).v_WB.x();
      dissipated += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * h / 3 * drag * v * v;
    }
    const double v0 = c.reference->at(0, 0).v_WB.x(), v1 = c.reference->at(0, t_end).v_WB.x();
    const double work = thrust * c.reference->at(0, t_end).p_WB.x();
    EXPECT_NEAR(work - dissipated, 0.5 * m * (v1 * v1 - v0 * v0), 1e-5);
  }
}

TEST(TwoSphere, FollowsMomentumRestitutionAndTheEnergyLaw) {
  for (const Case& c : cases_of("collision/two_sphere")) {
    const Scenario& s = c.scenario;
    ASSERT_EQ(s.events.size(), 1U);
    const double tc = s.events[0].time, e = parameter(c, "e");
    const auto before = states_at(c, 0), touch = states_at(c, tc), after = states_at(c, s.duration);
    const double tolerance = 100 * kU;  // numbers up to 6, about 16 operations each

    const Vec3 between = touch[1].p_WB - touch[0].p_WB;
    EXPECT_NEAR(between.norm(), 0.8, tolerance);
    const Vec3 n = between / between.norm();
    const Vec3 w0 = before[1].v_WB - before[0].v_WB, w1 = after[1].v_WB - after[0].v_WB;
    EXPECT_LT(n.dot(w0), 0) << "they must approach";
    EXPECT_NEAR(n.dot(w1), -e * n.dot(w0), tolerance);
    for (std::size_t b : {0U, 1U}) {  // without friction nothing happens along the surface
      const Vec3 change = after[b].v_WB - before[b].v_WB;
      EXPECT_LE((change - n * n.dot(change)).norm(), tolerance);
    }
    EXPECT_LE((momentum(s, after) - momentum(s, before)).norm(), tolerance);
    EXPECT_LE((angular_momentum(s, after) - angular_momentum(s, before)).norm(), tolerance);
    const double mu = 2.0 / 3.0, approach = n.dot(w0);
    EXPECT_NEAR(energy(s, before) - energy(s, after), 0.5 * mu * (1 - e * e) * approach * approach, tolerance);
    EXPECT_EQ(c.reference->at(0, tc).v_WB, after[0].v_WB) << "at the event itself the value after it counts";
    for (int i = 0; i <= 1000; ++i) {
      const auto now = states_at(c, s.duration * i / 1000);
      ASSERT_GE((now[1].p_WB - now[0].p_WB).norm(), 0.8 - tolerance) << "spheres overlap";
    }
  }
}

TEST(TwoSphere, HasTheVelocitiesComputedByHand) {
  const auto cases = cases_of("collision/two_sphere");
  const auto expect = [&](const std::string& name, const Vec3& one, const Vec3& two) {
    const auto after = states_at(case_named(cases, "collision/two_sphere/" + name), 1.5);
    EXPECT_LE((after[0].v_WB - one).norm(), 100 * kU) << name;
    EXPECT_LE((after[1].v_WB - two).norm(), 100 * kU) << name;
  };
  // 2 kg at 2 m/s meets 1 kg at -1 m/s: the common velocity is 1 m/s.
  expect("e=0,b=0", {1, 0, 0}, {1, 0, 0});
  expect("e=0.5,b=0", {0.5, 0, 0}, {2, 0, 0});
  expect("e=1,b=0", {0, 0, 0}, {3, 0, 0});
  // sin = 0.48/0.8 = 0.6, a 3-4-5 triangle: J = 2 * 2/3 * 3 * 0.8 = 3.2 along (0.8, 0, 0.6).
  expect("e=1,b=0.48", {0.72, 0, -0.96}, {1.56, 0, 1.92});
}

TEST(BoxDrop, TouchesWhenItHasFallenTheGapAndThenRests) {
  const auto cases = cases_of("collision/box_drop");
  const Case& c = cases.at(0);
  const double t0 = c.scenario.events.at(0).time;
  EXPECT_NEAR(t0, 1.0276503489, 5e-11);                              // sqrt(10.36/9.81) by hand
  EXPECT_NEAR(c.reference->at(1, t0 - 1e-12).p_WB.z(), 0.5, 2e-11);  // 10 m/s for 1e-12 s
  EXPECT_NEAR(c.reference->at(1, t0 - 1e-12).v_WB.z(), -std::sqrt(2 * 9.81 * 5.18), 2e-11);
  for (double t : {t0, 1.5, 2.5}) {
    EXPECT_EQ(c.reference->at(1, t).p_WB, Vec3(0, 0, 0.5));
    EXPECT_EQ(c.reference->at(1, t).v_WB, Vec3::Zero());
    EXPECT_EQ(c.reference->at(1, t).q_WB.coeffs(), Quat::Identity().coeffs());
  }
}

TEST(BouncingBall, LosesTheRightShareOfSpeedAndHeightAtEachImpact) {
  const auto cases = cases_of("collision/bouncing_ball");
  const Case& c = cases.at(0);
  const double e = 0.8, g = 9.81, h = 4.94, r = 0.1, eta = 1e-9;
  ASSERT_EQ(c.scenario.events.size(), 3U);
  const double tolerance = 2 * 10 * eta + 100 * 20 * kU;  // 10 m/s or m/s^2 for eta, and rounding
  double share = 1;
  for (const Event& event : c.scenario.events) {
    const BodyState before = c.reference->at(1, event.time - eta), after = c.reference->at(1, event.time + eta);
    EXPECT_NEAR(after.p_WB.z(), r, tolerance);
    EXPECT_NEAR(after.v_WB.z(), -e * before.v_WB.z(), tolerance);
    share *= e * e;
    const double apex = event.time + after.v_WB.z() / g;
    EXPECT_NEAR(c.reference->at(1, apex).p_WB.z(), r + share * h, tolerance) << event.name;
    EXPECT_NEAR(c.reference->at(1, apex).v_WB.z(), 0, tolerance) << event.name;
    // From here to the last bounce the flights 2u/g, 2eu/g, ... add up to 2u/g/(1 - e), t0 (1 + e)/(1 - e) in all.
    const double zeno = std::sqrt(2 * h / g) * (1 + e) / (1 - e);
    EXPECT_NEAR(zeno - event.time, 2 * after.v_WB.z() / g / (1 - e), tolerance / (1 - e)) << event.name;
  }
  for (int i = 0; i <= 1000; ++i) ASSERT_GE(c.reference->at(1, 4.3 * i / 1000).p_WB.z(), r - 100 * 5 * kU);
}

TEST(BouncingBall, AgreesWithTheGeometricSeriesForAnotherRestitution) {
  // h = 25 m, e = 0.5: impacts at t0, 2 t0, 2.5 t0 by hand.
  const auto cases = read_scenario_file(kFolder + "collision/bouncing_ball.toml", {{"h", {25}}, {"e", {0.5}}});
  const double t0 = 2.2576182049286;  // sqrt(50/9.81) by hand
  const auto& events = cases[0].scenario.events;
  ASSERT_EQ(events.size(), 3U);
  EXPECT_NEAR(events[0].time, t0, 5e-13 * 10);
  EXPECT_NEAR(events[1].time, 2 * t0, 5e-13 * 10);
  EXPECT_NEAR(events[2].time, 2.5 * t0, 5e-13 * 10);
  // Half a flight after the first impact: the apex at a quarter of the height.
  EXPECT_NEAR(cases[0].reference->at(1, 1.5 * t0).p_WB.z(), 0.1 + 6.25, 1e-11);
}

TEST(BouncingBall, WithoutLossComesBackToItsHeight) {
  const auto cases = read_scenario_file(kFolder + "collision/bouncing_ball.toml", {{"e", {1}}});
  const Case& c = cases[0];
  const double t0 = c.scenario.events.at(0).time, h = parameter(c, "h");
  ASSERT_EQ(c.scenario.events.size(), 3U);
  EXPECT_NEAR(c.scenario.events[2].time, 5 * t0, 32 * kU * 5 * t0);
  for (int apex : {2, 4}) {
    EXPECT_NEAR(c.reference->at(1, apex * t0).p_WB.z(), 0.1 + h, 32 * kU * reach(c.scenario)) << apex;
    EXPECT_NEAR(c.reference->at(1, (apex + 0.5) * t0).p_WB.z(), 0.1 + 0.75 * h, 32 * kU * reach(c.scenario)) << apex;
  }
}

}  // namespace
}  // namespace plumbline
