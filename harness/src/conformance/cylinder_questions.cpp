// Cylinders: mass properties about all axes, and contact on the side, on the end and with others.
#include <fmt/format.h>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kShortStep = 1.0 / 256;  // [s]

// z, the axis of the cylinder, turned to y: a disc in the x-z plane.
Quat lying() { return Quat(std::sqrt(0.5), -std::sqrt(0.5), 0, 0); }

Body cylinder(std::string name, double radius, double height, double mass, const Vec3& p_WB) {
  Body body = ball(std::move(name), 1, mass, p_WB);
  body.shape = Cylinder{radius, height};
  body.inertia = solid_inertia(body.shape, mass);
  return body;
}

void cylinder_echoes_its_inertia(Interview& row) {
  row.require(Feature::kForce);
  row.require(Feature::kTorque);
  Scenario scenario;
  scenario.bodies = {cylinder("drum", 0.3, 0.8, 4, Vec3(0.2, 0, -0.1))};
  Body& drum = scenario.bodies[0];
  drum.initial.q_WB = lying();
  drum.inertia = Vec3(0.3, 0.5, 0.7);  // of no homogeneous cylinder
  const double limit = kOneStepRoundings * row.roundoff();
  for (const Vec3& axis : axes_of_motion(row)) {
    const BodyState s = push(*row.build(scenario), scenario, 0, {axis, Vec3::Zero()}, kStep, 1)[0];
    row.within("the change of velocity by 1 N along " + name_of(axis), s.v_WB, kStep / drum.mass * axis,
               limit * kStep / drum.mass);
  }
  for (const Vec3& axis : axes_of_rotation(row)) {
    const BodyState s = push(*row.build(scenario), scenario, 0, {Vec3::Zero(), axis}, kStep, 1)[0];
    const Vec3 in_body = drum.initial.q_WB.conjugate() * axis;
    const double dw = kStep / in_body.cwiseAbs2().dot(drum.inertia);
    // The attitude is a rounded one: besides 16 roundings, what it tilts.
    row.within("the change of angular velocity by 1 N m about " + name_of(axis), s.w_WB, dw * axis, 2 * limit * dw);
  }
}

void cylinder_rolls_on_its_side(Interview& row) {
  row.require(Feature::kCylinderHalfSpace);
  row.require(Feature::kFriction);
  const double slope = 0.2, radius = 0.3;  // [rad], [m]
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -kGravity);
  scenario.contact = ContactMaterial{0, 0.6};
  const Vec3 normal(std::sin(slope), 0, std::cos(slope)), down(std::cos(slope), 0, -std::sin(slope));
  scenario.bodies = {half_space(normal), cylinder("drum", radius, 0.8, 5, radius * normal)};
  Body& drum = scenario.bodies[1];
  drum.initial.q_WB = lying();
  // A slender rim outside, so that no radius or moment but the stated ones gives the answer.
  drum.inertia.z() = 0.8 * drum.mass * radius * radius;
  const int steps = 128;
  const BodyState s = run(*row.build(scenario), scenario, kShortStep, steps)[1];
  // m a = m g sin - f, I w' = f r, a = r w'. mu = 0.6 holds it: what is needed is tan(slope) 0.8/1.8 = 0.09.
  const double speed = kGravity * std::sin(slope) / 1.8 * steps * kShortStep;
  // Two steps' worth, while the contact settles, and 1 % of the rolling radius for shells around shapes.
  const double limit = (2.0 / steps + 0.01) * speed;
  row.within("the velocity after rolling for 1/2 s", s.v_WB, speed * down, limit);
  row.within("the spin after rolling for 1/2 s", s.w_WB, speed / radius * Vec3::UnitY(), limit / radius);
  row.within("the height over the slope", s.p_WB.dot(normal), radius, 0.01);
}

// Dropped from a height of 5 cm, so that it lands for certain.
void expect_rest(Interview& row, const Quat& q_WB, double height_at_rest, const std::string& how) {
  Scenario scenario;
  scenario.gravity = Vec3(0, 0, -kGravity);
  scenario.contact = ContactMaterial{0, 0.5};
  const double drop = 0.05;
  scenario.bodies = {half_space(Vec3::UnitZ()), cylinder("drum", 0.4, 0.6, 50, Vec3(0, 0, height_at_rest + drop))};
  scenario.bodies[1].initial.q_WB = q_WB;
  const auto world = row.build(scenario);
  BodyState s;
  for (int k = 0; k < 256; ++k) s = run(*world, scenario, kShortStep, 1)[1];
  row.within("the height" + how, s.p_WB.z(), height_at_rest, 0.01);
  // At rest: no faster than gravity makes it within two steps, one that is still to be answered and one that was
  // answered twice; a point of the rim neither.
  row.within("the speed" + how, s.v_WB, Vec3::Zero(), 2 * kGravity * kShortStep);
  row.within("the spin" + how, s.w_WB, Vec3::Zero(), 2 * kGravity * kShortStep / 0.4);
  row.within("the tilt" + how, (s.q_WB * Vec3::UnitZ()).cross(q_WB * Vec3::UnitZ()).norm(), 0,
             0.1 * std::sqrt(2 * kGravity * drop) * kShortStep / 0.4);
}

void cylinder_rests_on_its_side(Interview& row) {
  row.require(Feature::kCylinderHalfSpace);
  expect_rest(row, lying(), 0.4, " at rest on its side");
}

void cylinder_rests_on_its_end(Interview& row) {
  row.require(Feature::kCylinderHalfSpace);
  row.require(Feature::kSpatial);
  expect_rest(row, Quat::Identity(), 0.3, " at rest on its end");
}

// Straight at each other, `gap` apart: the centre of `disc` flies along `direction` with 3 m/s, that of `other`, whose
// surface is `reach` away from it, against it with 1 m/s or stands fixed.
void expect_parting(Interview& row, Body disc, Body other, double reach, const Vec3& direction,
                    const std::string& how) {
  const double e = 0.5, gap = 0.63, radius = std::get<Cylinder>(disc.shape).radius;
  Scenario scenario;
  scenario.contact = ContactMaterial{e, 0};
  const double approach = other.fixed ? 3 : 4;
  disc.initial.p_WB = -0.5 * direction;
  disc.initial.v_WB = 3 * direction;
  other.initial.p_WB = (gap + radius + reach - 0.5) * direction;
  if (!other.fixed) other.initial.v_WB = -direction;
  scenario.bodies = {disc, other};
  const int steps = 160;
  const auto s = run(*row.build(scenario), scenario, kShortStep, steps);
  // Where surfaces are round the nearest points are found by a search that ends somewhere: 1 % of the motion may turn.
  const double aside = 0.01 * approach;
  row.within("the speed of separation" + how, (s[1].v_WB - s[0].v_WB).dot(direction), e * approach, aside);
  // One step late to see the impact, one to answer.
  const double parted = e * (approach * steps * kShortStep - gap);
  row.within("the distance after" + how, (s[1].p_WB - s[0].p_WB).dot(direction) - radius - reach, parted,
             2 * approach * kShortStep * (1 + e) + aside * steps * kShortStep);
  for (std::size_t i = 0; i < 2; ++i) {
    // Centre on centre nothing turns and nothing is thrown aside.
    const std::string who = " of '" + scenario.bodies[i].name + "'" + how;
    row.within("the spin" + who, s[i].w_WB, Vec3::Zero(), aside / radius);
    row.within("the drift" + who, Vec3(s[i].v_WB - s[i].v_WB.dot(direction) * direction), Vec3::Zero(), aside);
  }
}

// Along x, where such a search may end before it has begun, and askew.
void for_each_direction(const std::function<void(const Vec3&, const Quat&, const std::string&)>& ask) {
  for (double angle : {0.0, 0.3}) {
    ask(Vec3(std::cos(angle), 0, std::sin(angle)), rotation_by(Vec3(0, -angle, 0)),
        fmt::format(", {} rad from x", angle));
  }
}

Body disc_of(std::string name, double radius) {
  Body disc = cylinder(std::move(name), radius, 0.5, 2, Vec3::Zero());
  disc.initial.q_WB = lying();
  return disc;
}

void parallel_cylinders_part_as_stated(Interview& row) {
  row.require(Feature::kCylinderCylinder);
  row.require(Feature::kRestitution);
  for_each_direction([&](const Vec3& direction, const Quat&, const std::string& where) {
    Body other = disc_of("other", 0.1);
    expect_parting(row, disc_of("one", 0.2), other, 0.1, direction, " of parallel cylinders" + where);
    other.fixed = true;
    expect_parting(row, disc_of("one", 0.2), other, 0.1, direction, " of a cylinder and a fixed one" + where);
  });
}

void cylinder_meets_other_shapes(Interview& row) {
  row.require(Feature::kCylinderOther);
  row.require(Feature::kRestitution);
  for_each_direction([&](const Vec3& direction, const Quat& turn, const std::string& where) {
    expect_parting(row, disc_of("disc", 0.2), ball("ball", 0.1, 1, Vec3::Zero()), 0.1, direction,
                   " of a cylinder and a ball" + where);
    Body other = box("box", Vec3(0.2, 0.4, 0.3), 3, Vec3::Zero());
    other.initial.q_WB = turn;
    expect_parting(row, disc_of("disc", 0.2), other, 0.1, direction, " of a cylinder and a box" + where);
  });
}

const Question kQuestions[] = {
    {{"cylinder_echoes_its_inertia", "cylinders",
      "Does a cylinder answer 1 N and 1 N m with the stated mass and moments about all axes, its own being z?",
      "16 roundings; 32 for the spin, since its attitude is rounded too", false},
     cylinder_echoes_its_inertia},
    {{"cylinder_rolls_on_its_side", "cylinders",
      "Does a cylinder roll down a slope straight on, as fast as its moment of inertia lets it?",
      "two of 128 steps' worth while the contact settles, and 1 % of the radius for shells", true},
     cylinder_rolls_on_its_side},
    {{"cylinder_rests_on_its_side", "cylinders",
      "Does a cylinder that is dropped on its side rest there at its radius?",
      "1 cm in height, two steps of gravity in speed, 0.1 v/radius of a step in tilt", true},
     cylinder_rests_on_its_side},
    {{"cylinder_rests_on_its_end", "cylinders",
      "Does a cylinder that is dropped on its end stand there at half its height?",
      "1 cm in height, two steps of gravity in speed, 0.1 v/radius of a step in tilt", true},
     cylinder_rests_on_its_end},
    {{"parallel_cylinders_part_as_stated", "cylinders",
      "Do parallel cylinders meet where their sides touch, and part straight with the stated e?",
      "1 % of the speed, in size, aside or into spin, where the search for the nearest points may end; the place to "
      "two steps",
      true},
     parallel_cylinders_part_as_stated},
    {{"cylinder_meets_other_shapes", "cylinders",
      "Do a cylinder and a ball or box meet where they touch, and part straight with the stated e?",
      "1 % of the speed, in size, aside or into spin, where the search for the nearest points may end; the place to "
      "two steps",
      true},
     cylinder_meets_other_shapes},
};

}  // namespace

std::span<const Question> cylinder_questions() { return kQuestions; }

}  // namespace plumbline::conformance
