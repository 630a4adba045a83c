// Springs that the engine computes itself: each against the force that its law gives at the beginning of a step.
#include <fmt/format.h>

#include "conformance_scenes.hpp"
#include "plumbline/core/joints/constrained_motion.hpp"

namespace plumbline::conformance {
namespace {

// So soft that a step changes the pull little: an implicit rule answers with 1/(1 + k dt^2/m + c dt/m) of the force.
constexpr double kStiffness = 8;   // [N/m], [N m/rad]
constexpr double kDamping = 0.25;  // [N s/m], [N m s/rad]
// A typical lever of the scenes: it turns angles into lengths [m].
constexpr double kArm = 0.4;

std::vector<BodyState> initial_states(const Scenario& scenario) {
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  return states;
}

// What the moving ends add up to against a force: 1/m + r^2/I of every body that is pulled.
double compliance(const Scenario& scenario) {
  double sum = 0;
  for (const Body& body : scenario.bodies) sum += 1 / body.mass + kArm * kArm / body.inertia.minCoeff();
  return sum;
}

// One step from the start, beside dt times the exact accelerations.
void expect_pull(Interview& row, const Scenario& scenario, const std::string& how) {
  const std::vector<BodyState> start = initial_states(scenario);
  std::vector<Wrench> pulls(start.size());
  evaluate_forces(scenario, 0, start, pulls);
  const auto exact = constrained_accelerations(articulated_body(scenario), start, pulls).accelerations;
  const auto world = row.build(scenario);
  world->step(kStep);
  const auto states = states_of(*world, scenario);
  double free = 0;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const Body& body = scenario.bodies[i];
    free = std::max(free,
                    kStep * (pulls[i].f_W.norm() / body.mass + kArm * pulls[i].tau_W.norm() / body.inertia.minCoeff()));
  }
  // What an implicit rule, or one that looks at the place half a step on, leaves or adds; a sign, an end or a constant
  // that is wrong changes the answer by a large part of it.
  const double softened = (kStiffness * kStep * kStep + kDamping * kStep) * compliance(scenario);
  const double limit = (0.02 + 2 * softened + std::abs(row.info().velocity_offset)) * free;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::string who = " of '" + scenario.bodies[i].name + "' after one step, " + how;
    row.within("the change of velocity" + who, states[i].v_WB - start[i].v_WB, kStep * exact[i].linear, limit);
    row.within("the change of spin" + who, states[i].w_WB - start[i].w_WB, kStep * exact[i].angular, limit / kArm);
  }
}

Body swinging(const Interview& row) {
  Body body = box("arm", Vec3(0.4, 0.3, 0.5), 2, Vec3(0.3, 0, -0.2));
  body.inertia = Vec3(0.2, 0.3, 0.25);
  body.initial.q_WB = rotation_by(row.planar() ? Vec3(0, 0.4, 0) : Vec3(0.3, -0.5, 0.4));
  return body;
}
Body carrying(const Interview& row) {
  Body body = box("base", Vec3(0.3, 0.4, 0.5), 3, Vec3(-0.3, 0, 0.25));
  body.inertia = Vec3(0.3, 0.4, 0.25);
  body.initial.q_WB = rotation_by(row.planar() ? Vec3(0, -0.7, 0) : Vec3(-0.2, 0.6, 0.9));
  return body;
}

Spring spring_of(std::size_t a, std::size_t b, double length) {
  Spring spring;
  spring.name = "spring";
  spring.a = a;
  spring.b = b;
  spring.on_a = a == kWorld ? Vec3(-1, 0, 0.5) : Vec3(0.1, 0, 0.1);
  spring.on_b = Vec3(-0.1, 0, 0.2);
  spring.stiffness = kStiffness;
  spring.damping = kDamping;
  spring.length = length;
  return spring;
}

void spring_acts_as_stated(Interview& row) {
  row.require(Feature::kSpring);
  for (const double length : {0.2, 3.0}) {  // it pulls, it pushes
    Scenario scenario;
    scenario.bodies = {swinging(row)};
    // In the plane of a planar row no anchor may leave it, turned bodies or not.
    scenario.springs = {spring_of(kWorld, 0, length)};
    if (!row.planar()) scenario.springs[0].on_b.y() = 0.15;
    expect_pull(row, scenario, fmt::format("a spring to the world, at rest {} m long", length));
    scenario.bodies[0].initial.v_WB = Vec3(0.5, 0, -0.3);
    expect_pull(row, scenario, fmt::format("the same on a body that moves, {} m", length));
    scenario.bodies = {swinging(row), carrying(row)};
    scenario.springs = {spring_of(1, 0, length)};
    expect_pull(row, scenario, fmt::format("a spring between two bodies, at rest {} m long", length));
  }
}

void spring_keeps_momentum(Interview& row) {
  row.require(Feature::kSpring);
  Scenario scenario;
  scenario.bodies = {swinging(row), carrying(row)};
  scenario.springs = {spring_of(1, 0, 0.2)};
  const auto world = row.build(scenario);
  const int steps = 16;
  const auto states = run(*world, scenario, kStep, steps);
  double size = 0;
  Vec3 momentum = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    momentum += scenario.bodies[i].mass * states[i].v_WB;
    size += scenario.bodies[i].mass * states[i].v_WB.norm();
  }
  row.expect(size > 0, "nothing moves");
  row.within("the momentum of two bodies that pull each other", momentum, Vec3::Zero(),
             steps * kOneStepRoundings * row.roundoff() * size);
}

void joint_spring_acts_as_stated(Interview& row) {
  row.require(Feature::kJointSpring);
  for (const JointKind kind : {JointKind::kHinge, JointKind::kSlider}) {
    for (const double rest : {0.5, -0.25}) {
      for (const bool between : {false, true}) {
        Scenario scenario;
        scenario.bodies = {swinging(row)};
        if (between) scenario.bodies.push_back(carrying(row));
        const Vec3 axis = kind == JointKind::kSlider ? Vec3(0.6, 0, 0.8)
                          : row.planar()             ? Vec3(0, -1, 0)
                                                     : Vec3(1, 2, -2);
        scenario.joints = {joint_at(kind, between ? 1 : kWorld, 0, initial_states(scenario), Vec3(0.1, 0, 0.15), axis)};
        scenario.joint_springs = {{0, kStiffness, kDamping, rest}};
        expect_pull(row, scenario,
                    fmt::format("a spring on a {}{}, at rest at {}", joint_name(kind),
                                between ? " between two bodies" : "", rest));
      }
    }
  }
}

constexpr const char* kPull = "2 % of a free body's answer, and twice what an implicit rule makes of the force";

const Question kQuestions[] = {
    {{"spring_acts_as_stated", "springs",
      "Does a spring that the engine has itself pull and push as its law says, on both its ends?", kPull, false},
     spring_acts_as_stated},
    {{"spring_keeps_momentum", "springs", "Does a spring between two free bodies keep their momentum?",
      "16 roundings a step", false},
     spring_keeps_momentum},
    {{"joint_spring_acts_as_stated", "springs",
      "Does a spring on a hinge or slider turn or push towards its rest, the right way?", kPull, false},
     joint_spring_acts_as_stated},
};

}  // namespace

std::span<const Question> spring_questions() { return kQuestions; }

}  // namespace plumbline::conformance
