// Who checks a reference that is in contact from its start? What the ground must exert, from the reference's own
// accelerations, has to be what contact can do: it pushes, friction stays within its cone, and where bodies slip it is
// at the edge of the cone, against the slip; and its moment turns the bodies as the reference says.
#include <gtest/gtest.h>

#include <cmath>

#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

// Everything at one instant, with accelerations by central differences.
struct Instant {
  std::vector<BodyState> states;
  std::vector<Vec3> linear, angular;
};

Instant instant(const Case& c, double t, double delta) {
  Instant now;
  for (std::size_t b = 0; b < c.scenario.bodies.size(); ++b) {
    const BodyState before = c.reference->at(b, t - delta), after = c.reference->at(b, t + delta);
    now.states.push_back(c.reference->at(b, t));
    now.linear.push_back((after.v_WB - before.v_WB) / (2 * delta));
    now.angular.push_back((after.w_WB - before.w_WB) / (2 * delta));
    // The velocities belong to the places and attitudes.
    const BodyState& s = now.states.back();
    EXPECT_LE(((after.p_WB - before.p_WB) / (2 * delta) - s.v_WB).norm(), 1e-7) << c.scenario.case_name() << t;
    const Quat turn = after.q_WB * before.q_WB.conjugate();
    EXPECT_LE((turn.vec() * std::copysign(1 / delta, turn.w()) - s.w_WB).norm(), 1e-5) << c.scenario.case_name() << t;
  }
  return now;
}

// Force that must come from contact: what gravity and the force laws leave to explain.
Vec3 contact_force(const Scenario& s, const Instant& now, std::size_t body, double t) {
  Vec3 force = s.bodies[body].mass * (now.linear[body] - s.gravity);
  for (const ForceLaw& law : s.forces) {
    if (law.body == body) force -= law.evaluate(t, now.states[body]).f_W;
  }
  return force;
}

void expect_coulomb(const std::string& what, const Vec3& force, const Vec3& slip, double mu, double tolerance) {
  const double pressure = force.z();
  const Vec3 along(force.x(), force.y(), 0);
  EXPECT_GT(pressure, 0) << what << ": the ground pulls";
  EXPECT_LE(along.norm(), mu * pressure + tolerance) << what << ": more friction than there is";
  if (slip.norm() > 1e-6) {
    EXPECT_LE((along + mu * pressure * slip.normalized()).norm(), tolerance)
        << what << ": friction is not against the slip";
  }
}

void expect_contact_explains(const Case& c, double t) {
  const Scenario& s = c.scenario;
  // A central difference over 2 delta: truncation 1e-10 of what changes within a time scale, rounding 1e-16/1e-5.
  const double delta = 1e-5 * s.scales.time, tolerance = 1e-6 * s.scales.mass * 9.81;
  const Instant now = instant(c, t, delta);
  const std::string when = s.case_name() + " t = " + std::to_string(t);
  const double mu = s.contact->friction;
  std::size_t carrier = s.bodies.size();  // a box that moves and may carry spheres
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    if (!s.bodies[b].fixed && std::holds_alternative<Box>(s.bodies[b].shape)) carrier = b;
  }
  Vec3 on_carrier = Vec3::Zero(), moment_on_carrier = Vec3::Zero();
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const auto* sphere = std::get_if<Sphere>(&s.bodies[b].shape);
    if (sphere == nullptr) continue;
    const BodyState& state = now.states[b];
    const Vec3 arm(0, 0, -sphere->radius), force = contact_force(s, now, b, t);
    Vec3 support = Vec3::Zero();
    if (carrier < s.bodies.size()) {
      const Vec3 point = state.p_WB + arm - now.states[carrier].p_WB;
      support = now.states[carrier].v_WB + now.states[carrier].w_WB.cross(point);
      on_carrier -= force;
      moment_on_carrier -= point.cross(force);
    }
    expect_coulomb(when + ' ' + s.bodies[b].name, force, state.v_WB + state.w_WB.cross(arm) - support, mu, tolerance);
    const Mat3 inertia_W = inertia_in_world(s.bodies[b], state.q_WB);
    const Vec3 moment = inertia_W * now.angular[b] + state.w_WB.cross(inertia_W * state.w_WB);
    EXPECT_LE((moment - arm.cross(force)).norm(), tolerance * 10) << when << ": contact does not turn it so";
  }
  if (carrier == s.bodies.size()) return;
  if (!s.joints.empty()) {  // on a bearing: only the moment about its axis is left
    EXPECT_NEAR(moment_on_carrier.z(), s.bodies[carrier].inertia.z() * now.angular[carrier].z(), tolerance);
    return;
  }
  const Vec3 force = contact_force(s, now, carrier, t) - on_carrier;
  expect_coulomb(when + ' ' + s.bodies[carrier].name, force, now.states[carrier].v_WB, mu, tolerance);
}

class EveryContact : public testing::TestWithParam<std::string> {};

TEST_P(EveryContact, IsExplainedByPressureAndFriction) {
  for (const Case& c : read_scenario_file(PLUMBLINE_SOURCE_DIR "/scenarios/" + GetParam() + ".toml")) {
    for (int k = 1; k < 100; ++k) expect_contact_explains(c, c.scenario.duration * (k + 0.003) / 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, EveryContact,
                         testing::Values("friction/incline", "friction/slide", "friction/slip_to_roll",
                                         "friction/rolling_incline", "friction/plank", "friction/turntable",
                                         "friction/static_hold", "friction/dragged_box"),
                         [](const auto& row) { return row.param.substr(row.param.find('/') + 1); });

// The check itself: a ball whose spin grows a thousandth too fast is not explained.
TEST(ContactTruth, NoticesASpinThatFrictionCannotCause) {
  const auto cases = read_scenario_file(PLUMBLINE_SOURCE_DIR "/scenarios/friction/slip_to_roll.toml");
  const Scenario& s = cases.front().scenario;
  Instant now = instant(cases.front(), 0.1, 1e-6);
  const Vec3 arm(0, 0, -std::get<Sphere>(s.bodies[1].shape).radius), force = contact_force(s, now, 1, 0.1);
  const auto unexplained = [&] { return (s.bodies[1].inertia.cwiseProduct(now.angular[1]) - arm.cross(force)).norm(); };
  const double tolerance = 1e-5 * s.scales.mass * 9.81;
  EXPECT_LT(unexplained(), tolerance);
  now.angular[1] *= 1.001;
  EXPECT_GT(unexplained(), tolerance);
}

}  // namespace
}  // namespace plumbline
