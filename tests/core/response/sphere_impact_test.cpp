// The closed form of two spheres against the laws it stands for, and against the solver that knows no closed form.
#include "plumbline/core/response/sphere_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "kinetic_scenes.hpp"
#include "plumbline/core/invariant.hpp"
#include "plumbline/core/response/impulse.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum SphereImpact::Regime;

constexpr double kEps = std::numeric_limits<double>::epsilon();

// Uniform numbers from the raw bits: the standard distributions differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
    }
  }

 private:
  std::mt19937_64 bits_;
};

ImpactSphere solid_sphere(double radius, double mass, const Vec3& p_WB, const Vec3& v_WB, const Vec3& w_WB) {
  return {radius, mass, 0.4 * mass * radius * radius, {p_WB, Quat::Identity(), v_WB, w_WB}};
}

Body body_of(const ImpactSphere& s) {
  Body body = ball("ball", s.radius, s.mass, s.state.p_WB, s.state.v_WB);
  body.inertia = Vec3::Constant(s.moment);
  body.initial.w_WB = s.state.w_WB;
  return body;
}

struct Meeting {
  ImpactSphere first, second;
  ContactMaterial material;
  Vec3 n;
};

// Mass ratios to 1e4, radii to 20 : 1, moments from a heavy core to a thin shell (0.1 to 2/3 m r^2), surfaces that
// approach at up to 6 m/s and slide at up to 20. `oblique` = false: head-on and without spin.
Meeting random_meeting(Random& random, bool oblique, double largest_friction) {
  Meeting m;
  m.n = random.direction();
  const double r1 = random.in(0.1, 2), r2 = random.in(0.1, 2), mass1 = std::pow(10, random.in(-2, 2));
  const Vec3 p = random.vector(1), v1 = oblique ? random.vector(3) : Vec3(random.in(-3, 3) * m.n);
  const Vec3 v2 = oblique ? random.vector(3) : Vec3(random.in(-3, 3) * m.n);
  m.first = solid_sphere(r1, mass1, p + (r1 + r2) * m.n, v1, oblique ? Vec3(random.vector(3) / r1) : Vec3::Zero());
  m.second =
      solid_sphere(r2, std::pow(10, random.in(-2, 2)), p, v2, oblique ? Vec3(random.vector(3) / r2) : Vec3::Zero());
  if (oblique) {
    m.first.moment *= random.in(0.25, 5.0 / 3);
    m.second.moment *= random.in(0.25, 5.0 / 3);
  }
  m.material = {random.in(0, 1), random.in(0, largest_friction)};
  return m;
}

double energy_of(const Meeting& m) {
  Scenario s;
  s.bodies = {body_of(m.first), body_of(m.second)};
  const BodyState states[] = {m.first.state, m.second.state};
  return energy(s, states);
}

// What the solver makes of the same meeting, as a distance of all velocities, surfaces' speeds for the spins [m/s].
double distance_to_solver(const Meeting& m, ImpulseReport& report) {
  const Body bodies[] = {body_of(m.first), body_of(m.second)};
  std::vector<BodyState> states = {m.first.state, m.second.state};
  const Inertness inertness[] = {inertness_of(bodies[0], Quat::Identity()), inertness_of(bodies[1], Quat::Identity())};
  Contact contact = sphere_sphere_contact(states[0], m.first.radius, states[1], m.second.radius);
  contact.body_b = 1;
  const double u = approach_speed(contact, states);
  report =
      apply_impulses(std::vector<ImpactPoint>{{contact, u > 0 ? m.material.restitution * u : 0, m.material.friction}},
                     inertness, states);
  Meeting ours = m;
  collide_spheres(ours.first, ours.second, m.material);
  return std::max({(ours.first.state.v_WB - states[0].v_WB).norm(), (ours.second.state.v_WB - states[1].v_WB).norm(),
                   (ours.first.state.w_WB - states[0].w_WB).norm() * m.first.radius,
                   (ours.second.state.w_WB - states[1].w_WB).norm() * m.second.radius});
}

// Both sides round speeds of 10 m/s a few dozen times; the solver stops at 1e-14 of its impulse, which is worth
// 1e-14 of the approach, times m/I r^2 <= 10 for the spin: 1e-12 holds with a factor of three to spare.
TEST(SphereImpacts, AreTheSolversOnTenThousandRandomMeetings) {
  Random random(2718);
  int parting = 0, grip = 0, slip = 0;
  double worst = 0;
  for (int k = 0; k < 10000; ++k) {
    const Meeting m = random_meeting(random, k % 5 != 0, k % 3 == 0 ? 0.2 : 2);
    Meeting after = m;
    const auto regime = collide_spheres(after.first, after.second, m.material).regime;
    ++(regime == kParting ? parting : regime == kGrip ? grip : slip);
    ImpulseReport report;
    const double distance = distance_to_solver(m, report);
    ASSERT_TRUE(report.converged) << k;
    ASSERT_LT(distance, 1e-12) << k;
    worst = std::max(worst, distance);
  }
  RecordProperty("worst", std::to_string(worst * 1e15) + "e-15 m/s");
  EXPECT_GT(std::min({parting, grip, slip}), 1000);
}

TEST(SphereImpacts, KeepMomentumAndAngularMomentumAndLoseTheStatedEnergy) {
  Random random(3141);
  for (int k = 0; k < 10000; ++k) {
    const Meeting m = random_meeting(random, true, 1);
    Meeting after = m;
    const SphereImpact impact = collide_spheres(after.first, after.second, m.material);
    const auto momentum_of = [](const Meeting& x) -> Vec3 {
      return x.first.mass * x.first.state.v_WB + x.second.mass * x.second.state.v_WB;
    };
    const auto about_origin = [](const Meeting& x) {
      Vec3 sum = Vec3::Zero();
      for (const ImpactSphere* s : {&x.first, &x.second}) {
        sum += s->mass * s->state.p_WB.cross(s->state.v_WB) + s->moment * s->state.w_WB;
      }
      return sum;
    };
    const double mass = m.first.mass + m.second.mass, before = energy_of(m);
    ASSERT_LT((momentum_of(after) - momentum_of(m)).norm(), 64 * kEps * mass * 6) << k;
    ASSERT_LT((about_origin(after) - about_origin(m)).norm(), 64 * kEps * mass * 40) << k;
    ASSERT_NEAR(before - energy_of(after), impact.lost_along + impact.lost_across, 64 * kEps * before) << k;
    ASSERT_GE(impact.lost_across, 0) << k;
  }
}

// What defines the regimes, read off the surfaces afterwards.
TEST(SphereImpacts, ObeyNewtonsRestitutionAndCoulombsLaw) {
  Random random(1618);
  for (int k = 0; k < 10000; ++k) {
    const Meeting m = random_meeting(random, true, 0.6);
    Meeting after = m;
    const SphereImpact impact = collide_spheres(after.first, after.second, m.material);
    const auto surfaces = [&](const Meeting& x) -> Vec3 {
      return point_velocity(x.first.state, x.first.state.p_WB - x.first.radius * m.n) -
             point_velocity(x.second.state, x.second.state.p_WB + x.second.radius * m.n);
    };
    const Vec3 v = surfaces(m), u = surfaces(after);
    const double left = 1e-12;  // as above
    if (impact.regime == kParting) {
      ASSERT_GE(m.n.dot(v), -left) << k;
      ASSERT_EQ(after.first.state.v_WB, m.first.state.v_WB) << k;
      continue;
    }
    ASSERT_NEAR(m.n.dot(u), -m.material.restitution * m.n.dot(v), left) << k;
    const double along = m.n.dot(impact.impulse_W), across = (impact.impulse_W - along * m.n).norm();
    const Vec3 u_t = u - m.n.dot(u) * m.n;
    ASSERT_LE(across, m.material.friction * along * (1 + 8 * kEps) + 8 * kEps * along) << k;
    if (impact.regime == kGrip) {
      ASSERT_LT(u_t.norm(), left) << k;
    } else {
      ASSERT_NEAR(across, m.material.friction * along, 16 * kEps * along) << k;
      ASSERT_NEAR(impact.impulse_W.dot(u_t), -across * u_t.norm(), left * along) << k;
    }
  }
}

// The textbook's numbers for homogeneous spheres: two sevenths, whatever the sizes.
TEST(SphereImpacts, OfSolidSpheresGripUpToTwoSeventhsOfTheSlide) {
  const double e = 0.6, mu = 0.25, v_n = 1.5, m1 = 2, m2 = 7, reduced = m1 * m2 / (m1 + m2);
  const double limit = 3.5 * mu * (1 + e) * v_n;
  for (const double share : {0.5, 1 - 1e-12, 1 + 1e-12, 2.0}) {
    ImpactSphere a = solid_sphere(0.3, m1, Vec3(0, 0, 1.2), Vec3(share * limit, 0, -v_n), Vec3::Zero());
    ImpactSphere b = solid_sphere(0.9, m2, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
    const SphereImpact impact = collide_spheres(a, b, {e, mu});
    EXPECT_EQ(impact.regime, share < 1 ? kGrip : kSlip);
    EXPECT_NEAR(impact.impulse_W.z(), (1 + e) * reduced * v_n, 8 * kEps * 10);
    EXPECT_NEAR(impact.impulse_W.x(), -std::min(2.0 / 7 * reduced * share * limit, mu * impact.impulse_W.z()),
                8 * kEps * 10);
    EXPECT_NEAR(impact.lost_along, 0.5 * (1 - e * e) * reduced * v_n * v_n, 8 * kEps * 10);
  }
}

// A ball without spin on a plane: grips v_t' = 5/7 v_t = r w, slips v_t' = v_t - mu (1 + e) v_n.
TEST(SphereImpacts, OnAPlaneLeaveFiveSeventhsOfTheSlide) {
  const double e = 0.5, v_n = 2, v_t = 3, r = 0.5;
  for (const double mu : {0.1, 0.6}) {
    ImpactSphere s = solid_sphere(r, 2, Vec3(0, 0, r), Vec3(v_t, 0, -v_n), Vec3::Zero());
    const SphereImpact impact = bounce_sphere(s, Vec3::UnitZ(), {e, mu});
    const bool grips = 2.0 / 7 * v_t <= mu * (1 + e) * v_n;
    EXPECT_EQ(impact.regime, grips ? kGrip : kSlip);
    const double change = grips ? 2.0 / 7 * v_t : mu * (1 + e) * v_n;
    EXPECT_NEAR(s.state.v_WB.x(), v_t - change, 16 * kEps * v_t);
    EXPECT_NEAR(s.state.w_WB.y() * r, 2.5 * change, 16 * kEps * v_t);
    EXPECT_NEAR(s.state.v_WB.z(), e * v_n, 16 * kEps * v_n);
  }
}

TEST(SphereImpacts, OnAPlaneAreTheLimitOfAHeavySphere) {
  Random random(5772);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 n = random.direction();
    ImpactSphere s = solid_sphere(0.4, 1, 1.4 * n, random.vector(3), random.vector(5));
    ImpactSphere twin = s, wall = solid_sphere(1, 1e18, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
    const ContactMaterial material{random.in(0, 1), random.in(0, 1)};
    bounce_sphere(s, n, material);
    collide_spheres(twin, wall, material);
    ASSERT_LT((s.state.v_WB - twin.state.v_WB).norm(), 64 * kEps * 6) << k;
    ASSERT_LT((s.state.w_WB - twin.state.w_WB).norm(), 64 * kEps * 40) << k;
  }
}

// Slide 23 as it is printed: Lambda = -m1 m2 (1 + e) ((v1 - v2) . n) / (m1 + m2) n, always.
Vec3 slide_impulse(const ImpactSphere& a, const ImpactSphere& b, const Vec3& n, double e) {
  return -(a.mass * b.mass * (1 + e) * (a.state.v_WB - b.state.v_WB).dot(n)) / (a.mass + b.mass) * n;
}

TEST(SphereImpacts, LeavePartingSpheresAloneWhereTheSlideGluesThem) {
  const double e = 0.5;
  ImpactSphere a = solid_sphere(0.5, 1, Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3::Zero());
  ImpactSphere b = solid_sphere(0.5, 3, Vec3::Zero(), Vec3(-1, 0, 0), Vec3::Zero());
  const Vec3 lambda = slide_impulse(a, b, Vec3::UnitX(), e);
  const double parting = 3, slides = (a.state.v_WB + lambda / a.mass - b.state.v_WB + lambda / b.mass).x();
  EXPECT_NEAR(slides, -e * parting, 1e-15);  // they parted; by the slide they now fly into each other
  EXPECT_EQ(collide_spheres(a, b, {e, 0.3}).regime, kParting);
  EXPECT_EQ((a.state.v_WB - b.state.v_WB).x(), parting);
}

TEST(SphereImpacts, TakeTheSlidesSignsAndNoOthers) {
  const double e = 0.5;
  const ImpactSphere a = solid_sphere(0.5, 1, Vec3(1, 0, 0), Vec3(-2, 0, 0), Vec3::Zero());
  const ImpactSphere b = solid_sphere(0.5, 3, Vec3::Zero(), Vec3(1, 0, 0), Vec3::Zero());
  Meeting m{a, b, {e, 0}, Vec3::UnitX()};
  const Vec3 lambda = slide_impulse(a, b, m.n, e);
  collide_spheres(m.first, m.second, m.material);
  EXPECT_LT((m.first.state.v_WB - (a.state.v_WB + lambda / a.mass)).norm(), 4 * kEps);
  EXPECT_LT((m.second.state.v_WB - (b.state.v_WB - lambda / b.mass)).norm(), 4 * kEps);
  // The formula holds n twice, so that it does not care which way n points; "they approach" does: with n reversed a
  // test of the sign of (v1 - v2) . n lets bodies pass through each other.
  EXPECT_EQ(slide_impulse(a, b, -m.n, e), lambda);
  EXPECT_GT((a.state.v_WB - b.state.v_WB).dot(-m.n), 0);
  // Added to body 2 and subtracted from body 1, it speeds them up: (2 + e) times the approach, and energy is made.
  Meeting wrong{a, b, m.material, m.n};
  wrong.first.state.v_WB -= lambda / a.mass;
  wrong.second.state.v_WB += lambda / b.mass;
  EXPECT_NEAR((wrong.first.state.v_WB - wrong.second.state.v_WB).x(), -(2 + e) * 3, 8 * kEps);
  const double before = energy_of({a, b, m.material, m.n});
  EXPECT_GT(energy_of(wrong), before);
  EXPECT_LT(energy_of(m), before);
  // Exchanged, ours finds the same impulse with the other sign.
  Meeting exchanged{b, a, m.material, m.n};
  collide_spheres(exchanged.first, exchanged.second, m.material);
  EXPECT_EQ(exchanged.first.state.v_WB, m.second.state.v_WB);
  EXPECT_EQ(exchanged.second.state.v_WB, m.first.state.v_WB);
}

TEST(SphereImpacts, RefuseWhatIsNoSphereAndNoMaterial) {
  const ImpactSphere good = solid_sphere(0.5, 1, Vec3(1, 0, 0), Vec3(-2, 0, 0), Vec3::Zero());
  const ImpactSphere other = solid_sphere(0.5, 1, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  const auto refuses = [&](ImpactSphere a, ImpactSphere b, ContactMaterial m) {
    EXPECT_THROW(collide_spheres(a, b, m), std::invalid_argument);
  };
  ImpactSphere light = good, point = good, hollow = good;
  light.mass = 0;
  point.radius = 0;
  hollow.moment = -1;
  refuses(light, other, {});
  refuses(point, other, {});
  refuses(hollow, other, {});
  refuses(good, good, {});
  refuses(good, other, {1.5, 0});
  refuses(good, other, {-0.1, 0});
  refuses(good, other, {0, -0.1});
  refuses(good, other, {std::numeric_limits<double>::quiet_NaN(), 0});
}

TEST(SphereImpacts, AreNanWhereAVelocityIs) {
  ImpactSphere a = solid_sphere(0.5, 1, Vec3(1, 0, 0), Vec3(std::nan(""), 0, 0), Vec3::Zero());
  ImpactSphere b = solid_sphere(0.5, 1, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  collide_spheres(a, b, {0.5, 0.1});
  EXPECT_FALSE(is_finite(a.state));
  EXPECT_FALSE(is_finite(b.state));
}

}  // namespace
}  // namespace plumbline
