// Are the limits of the rotating, jointed and sliding cases right? Plain first-order schemes must pass, some must come
// near, and a scheme that solves another problem must be noticed. gate_limit_test.cpp does the same for free flight and
// impacts.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "plumbline/core/kinetics/simulator.hpp"
#include "plumbline/core/metric.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

std::vector<Case> cases_of(const std::string& id, const Overrides& overrides = {}) {
  return read_scenario_file(PLUMBLINE_SOURCE_DIR "/scenarios/" + id + ".toml", overrides);
}

// |metric|/limit of one gate.
double ratio(const Case& c, const Trajectory& actual, const std::string& metric) {
  const Scenario& s = c.scenario;
  const Trajectory expected = sample(*c.reference, s.bodies.size(), actual.dt(), actual.samples());
  for (const Gate& gate : s.gates) {
    if (gate.metric != metric) continue;
    const double limit = gate.limit({actual.dt(), static_cast<double>(s.step_count(actual.dt())), 0x1p-53});
    return std::abs(find_metric(metric)->measure({s, actual, expected})) / limit;
  }
  throw std::invalid_argument("no gate " + metric);
}

// Euler's schemes with the gyroscopic term taken from the start of the step or from its end.
std::vector<Scheme> rotating_family() {
  std::vector<Scheme> schemes;
  for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kExplicitEuler}) {
    for (const GyroscopicTerm term : {GyroscopicTerm::kExplicit, GyroscopicTerm::kImplicit}) {
      schemes.push_back({integrator, ImpactRule::kExactTime, term});
    }
  }
  return schemes;
}

TEST(FreeRotationGates, PassFirstOrderSchemesAndAreReached) {
  const Case c = cases_of("rotation/free_rotation").at(0);
  double worst_attitude = 0;
  for (const double dt : c.scenario.steps) {
    for (const Scheme& scheme : rotating_family()) {
      const Trajectory actual = simulate(c.scenario, scheme, dt);
      for (const Gate& gate : c.scenario.gates) {
        EXPECT_LE(ratio(c, actual, gate.metric), 1) << gate.metric << ' ' << name(scheme) << " dt = " << dt;
      }
      worst_attitude = std::max(worst_attitude, ratio(c, actual, "attitude.max"));
    }
  }
  EXPECT_GT(worst_attitude, 0.5);
}

TEST(FreeRotationGates, NoticeThatTheGyroscopicTermIsMissing) {
  const Case c = cases_of("rotation/free_rotation").at(0);
  const Scheme without{Integrator::kSemiImplicitEuler, ImpactRule::kExactTime, GyroscopicTerm::kNone};
  for (const double dt : c.scenario.steps) {
    EXPECT_GT(ratio(c, simulate(c.scenario, without, dt), "attitude.max"), 1) << dt;
  }
}

TEST(FreeRotationGates, RestOnTheLargestRatesOfTheMotion) {
  const Case c = cases_of("rotation/free_rotation").at(0);
  // w_max and growth*w of the file, worked out by hand from its moments 97/120, 82/120 and 17/120 kg m^2.
  const double w_max = 5 * std::sqrt(82.0 * 15 / (17 * 80) + 82.0 * 65 / (97 * 80));
  const double growth = 5 * std::sqrt(15.0 * 65 / (97 * 17));
  double largest = 0, quickest = 0;
  for (double t = 0; t < 4; t += 1e-3) {
    const Vec3 now = c.reference->at(0, t).w_WB, later = c.reference->at(0, t + 1e-6).w_WB;
    largest = std::max(largest, now.norm());
    quickest = std::max(quickest, (later - now).norm() / 1e-6);
  }
  // The file leaves the small turn s = 0.1 out of both: (s/w)^2 of them, and the difference's own 1e-6.
  EXPECT_NEAR(largest, w_max, 2 * std::pow(0.1 / 5, 2) * w_max);
  EXPECT_NEAR(quickest, growth * 5, 2 * std::pow(0.1 / 5, 2) * growth * 5);
}

// The pendulum in its angle, by semi-implicit or explicit Euler, or in its place with the rod's direction held over the
// step: the velocity is made tangent to the circle, the step goes straight on, and the length is put right afterwards.
enum class Swing { kSemiImplicitAngle, kExplicitAngle, kHeldRod };

Trajectory swing(const Scenario& s, Swing how, double dt, double gravity) {
  const double r = 0.1, inertia = 1 + 0.4 * r * r;  // about the hinge, for 1 kg at 1 m
  Trajectory t(dt, 1);
  double angle = std::acos(0.0), w = 0;
  Vec3 p(1, 0, 0), v = Vec3::Zero();
  for (std::size_t k = 0; k <= s.step_count(dt); ++k) {
    BodyState& now = t.append()[0];
    if (how == Swing::kHeldRod) {
      now.p_WB = p;
      now.v_WB = v;
      // Of the ball's weight the share 1/inertia moves it along the circle; its own spin takes the rest.
      v += dt * Vec3(0, 0, -gravity / inertia);
      v -= p * p.dot(v);
      p = (p + dt * v).normalized();
      continue;
    }
    now.p_WB = Vec3(std::sin(angle), 0, -std::cos(angle));
    now.v_WB = w * Vec3(std::cos(angle), 0, std::sin(angle));
    now.w_WB = Vec3(0, -w, 0);
    const double old = w;
    w -= dt * gravity / inertia * std::sin(angle);
    angle += dt * (how == Swing::kSemiImplicitAngle ? w : old);
  }
  return t;
}

TEST(PendulumGates, PassFirstOrderSchemesAndAreReached) {
  const Case c = cases_of("joint/pendulum").at(0);
  double worst = 0;
  for (const double dt : c.scenario.steps) {
    for (const Swing how : {Swing::kSemiImplicitAngle, Swing::kExplicitAngle, Swing::kHeldRod}) {
      const double found = ratio(c, swing(c.scenario, how, dt, 9.81), "position.max");
      EXPECT_LE(found, 1) << static_cast<int>(how) << " dt = " << dt;
      worst = std::max(worst, found);
    }
  }
  EXPECT_GT(worst, 0.25);
}

TEST(PendulumGates, NoticeAGravityThatIsFivePercentOff) {
  const Case c = cases_of("joint/pendulum").at(0);
  EXPECT_GT(ratio(c, swing(c.scenario, Swing::kSemiImplicitAngle, 1e-3, 1.05 * 9.81), "position.max"), 1);
}

// One coordinate along the slope, by semi-implicit Euler; friction is missing or double in the first two steps.
Trajectory slide(const Scenario& s, double mu, double first_steps_friction, double dt) {
  const double slope = std::acos(-1.0) / 9, pull = 9.81 * std::sin(slope), hold = mu * 9.81 * std::cos(slope);
  Trajectory t(dt, 2);
  double x = 0, v = 0;
  for (std::size_t k = 0; k <= s.step_count(dt); ++k) {
    const auto now = t.append();
    now[0] = s.bodies[0].initial;
    now[1] = s.bodies[1].initial;
    now[1].p_WB.x() = x;
    now[1].v_WB.x() = v;
    const double friction = (k < 2 ? first_steps_friction : 1) * hold * dt;
    v += pull * dt;
    v = std::max(0.0, v - friction);
    x += v * dt;
  }
  return t;
}

TEST(InclineGates, PassFirstOrderSchemesAndNoticeAnotherFriction) {
  for (const Case& c : cases_of("friction/incline")) {
    const double mu = c.scenario.contact->friction;
    double worst = 0;
    for (const double dt : c.scenario.steps) {
      for (const double first : {0.0, 1.0, 2.0}) {
        const Trajectory actual = slide(c.scenario, mu, first, dt);
        for (const char* metric : {"position.final", "velocity.final"}) {
          EXPECT_LE(ratio(c, actual, metric), 1) << c.scenario.case_name() << ' ' << metric << " dt = " << dt;
          worst = std::max(worst, ratio(c, actual, metric));
        }
      }
    }
    if (mu < 0.3) {
      EXPECT_GT(worst, 0.25);
      EXPECT_GT(ratio(c, slide(c.scenario, 0.98 * mu, 1, 1e-3), "position.final"), 1);
    } else {
      // 0.36 lets go at tan(20 degrees) = 0.364.
      EXPECT_GT(ratio(c, slide(c.scenario, 0.36, 1, 1e-3), "position.final"), 1);
    }
  }
}

}  // namespace
}  // namespace plumbline
