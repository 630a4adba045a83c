#include "plumbline/core/exact/kepler_orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "independent_check.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kPi = std::numbers::pi;

// Semi-major axis 1, GM = 1, seen from the nearest place.
KeplerOrbit from_nearest_place(double e) {
  return KeplerOrbit(1, Vec3(1 - e, 0, 0), Vec3(0, 0, std::sqrt((1 + e) / (1 - e))));
}

Vec3 runge_lenz(double strength, const OrbitState& s) {
  return s.velocity.cross(s.position.cross(s.velocity)) / strength - s.position.normalized();
}

TEST(KeplerOrbit, MatchesAPublishedRootOfKeplersEquation) {
  // Meeus, Astronomical Algorithms, example 30.a: e = 0.1 and a mean anomaly of 5 degrees give E = 5.554589 degrees.
  const OrbitState s = from_nearest_place(0.1).at(5 * kPi / 180);
  const double anomaly = std::atan2(s.position.z() / std::sqrt(1 - 0.01), s.position.x() + 0.1);
  EXPECT_NEAR(anomaly * 180 / kPi, 5.554589, 5e-7);
}

TEST(KeplerOrbit, PassesThroughTheEndsOfItsAxes) {
  const double e = 0.6;
  const KeplerOrbit orbit = from_nearest_place(e);
  EXPECT_NEAR(orbit.eccentricity(), e, 4 * kEps);
  EXPECT_NEAR(orbit.period(), 2 * kPi, 16 * kEps);
  // Farthest after half a period; the end of the short axis where E = pi/2, at n t = pi/2 - e.
  EXPECT_LE((orbit.at(kPi).position - Vec3(-1 - e, 0, 0)).norm(), 64 * kEps);
  EXPECT_LE((orbit.at(kPi / 2 - e).position - Vec3(-e, 0, 0.8)).norm(), 64 * kEps);
  EXPECT_LE((orbit.at(200 * kPi).position - Vec3(1 - e, 0, 0)).norm(), 200 * kPi * 16 * kEps);
}

TEST(KeplerOrbit, SatisfiesItsEquationAndKeepsItsInvariants) {
  std::mt19937_64 bits(3);
  int ellipses = 0;
  for (int k = 0; k < 400; ++k) {
    const double strength = 0.5 + 2 * uniform(bits);
    const Vec3 p = uniform_vector(bits) + Vec3(1.5, 0, 0), v = uniform_vector(bits);
    if (v.squaredNorm() > 1.5 * strength / p.norm() || p.cross(v).norm() < 0.3) continue;
    ++ellipses;
    const KeplerOrbit orbit(strength, p, v);
    const OrbitState start{p, v}, now = orbit.at(orbit.period() * (2 * uniform(bits) - 1));
    const auto energy = [&](const OrbitState& s) {
      return 0.5 * s.velocity.squaredNorm() - strength / s.position.norm();
    };
    // Rounding of the start is worth up to 1/(1 - e)^2, a few hundred here.
    EXPECT_NEAR(energy(now), energy(start), 1e-12);
    EXPECT_LE((now.position.cross(now.velocity) - p.cross(v)).norm(), 1e-13);
    EXPECT_LE((runge_lenz(strength, now) - runge_lenz(strength, start)).norm(), 1e-12);
    EXPECT_NEAR(runge_lenz(strength, start).norm(), orbit.eccentricity(), 1e-14);
  }
  EXPECT_GT(ellipses, 100);

  const KeplerOrbit orbit = from_nearest_place(0.6);
  for (double t = -7; t < 7; t += 0.1) {
    const OrbitState now = orbit.at(t);
    const double r = now.position.norm();
    // The nearest singularity lies acosh(1/e) - sqrt(1 - e^2) = 0.3 of complex time away: truncation 9!/630
    // (0.005/0.3)^8 2/0.3 = 2e-11, rounding 1e-15/0.005.
    const Vec3 v = derivative([&](double x) { return orbit.at(x).position; }, t, 0.005);
    const Vec3 a = derivative([&](double x) { return orbit.at(x).velocity; }, t, 0.005);
    EXPECT_LE((v - now.velocity).norm(), 1e-10) << t;
    EXPECT_LE((a + now.position / (r * r * r)).norm(), 1e-10) << t;
  }
}

TEST(KeplerOrbit, IsACircleAtTheSpeedOfACircle) {
  const KeplerOrbit orbit(4, Vec3(0, 2, 0), Vec3(std::sqrt(2.0), 0, 0));
  const double rate = std::sqrt(4.0 / 8);
  for (const double t : {0.3, 2.0, 30.0}) {
    const Vec3 place(2 * std::sin(rate * t), 2 * std::cos(rate * t), 0);
    EXPECT_LE((orbit.at(t).position - place).norm(), 32 * kEps * (1 + rate * t));
  }
}

TEST(KeplerOrbit, RefusesWhatIsNoEllipse) {
  EXPECT_THROW(KeplerOrbit(0, Vec3(1, 0, 0), Vec3(0, 1, 0)), std::invalid_argument);
  EXPECT_THROW(KeplerOrbit(1, Vec3(1, 0, 0), Vec3(0, 1.5, 0)), std::invalid_argument);  // escapes
  EXPECT_THROW(KeplerOrbit(1, Vec3(1, 0, 0), Vec3(-0.5, 0, 0)), std::invalid_argument);
  EXPECT_THROW(KeplerOrbit(1, Vec3(0, 0, 0), Vec3(0, 1, 0)), std::invalid_argument);
  EXPECT_THROW(KeplerOrbit(1, Vec3(std::nan(""), 0, 0), Vec3(0, 1, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
