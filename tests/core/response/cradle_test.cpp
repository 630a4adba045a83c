// Newton's cradle with gaps: a chain of exact impacts, each of two balls at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;
using enum Integrator;
using enum ImpactRule;

constexpr double kRadius = 0.1, kSpeed = 2;

// Five balls in a row, gaps of 5 to 20 mm between them; the first comes in from the left.
Scenario cradle(double restitution, double duration) {
  Scenario s;
  s.id = "test/cradle";
  s.contact = ContactMaterial{restitution, 0.3};  // head-on: there is nothing for friction to do
  s.duration = duration;
  double x = -1;
  for (const double gap : {0.5, 0.005, 0.02, 0.01, 0.0}) {
    s.bodies.push_back(ball("ball", kRadius, 0.7, Vec3(x, 0, 0), Vec3(s.bodies.empty() ? kSpeed : 0, 0, 0)));
    x += 2 * kRadius + gap;
  }
  return s;
}

// Points on a line that exchange momentum: an event at a time, in long double, with nothing of the core in it.
struct Line {
  std::vector<long double> x, v;
  int impacts = 0;

  void run(long double duration, long double e) {
    for (;;) {
      long double first = duration;
      std::size_t hit = 0;
      for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        const long double closing = v[k] - v[k + 1];
        if (closing <= 0) continue;
        const long double t = (x[k + 1] - x[k]) / closing;
        if (t < first) {
          first = t;
          hit = k + 1;
        }
      }
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += first * v[k];
      duration -= first;
      if (hit == 0) return;
      const long double sum = v[hit - 1] + v[hit], difference = e * (v[hit - 1] - v[hit]);
      v[hit - 1] = (sum - difference) / 2;
      v[hit] = (sum + difference) / 2;
      ++impacts;
    }
  }
};

Line line_of(const Scenario& s) {
  Line line;
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    // Without the balls' extent, so that gaps are distances.
    line.x.push_back(static_cast<long double>(s.bodies[k].initial.p_WB.x()) -
                     2 * kRadius * static_cast<long double>(k));
    line.v.push_back(static_cast<long double>(s.bodies[k].initial.v_WB.x()));
  }
  return line;
}

TEST(Cradle, PassesItsMomentumToTheLastBall) {
  const Scenario s = cradle(1, 1);
  for (const Integrator integrator : {kSemiImplicitEuler, kExplicitEuler, kVelocityVerlet}) {
    for (const double dt : {0.25, 0.01}) {
      const Trajectory path = simulate(s, {integrator, kExactTime}, dt);
      const std::size_t end = path.samples() - 1;
      // Every ball takes the place of the next, 535 mm of gaps take the time of one flight.
      for (std::size_t k = 0; k < 4; ++k) EXPECT_LT(path.at(end, k).v_WB.norm(), 1e-13);
      EXPECT_NEAR(path.at(end, 4).v_WB.x(), kSpeed, 1e-13);
      EXPECT_NEAR(path.at(end, 4).p_WB.x(), s.bodies[4].initial.p_WB.x() + kSpeed * (1 - 0.535 / kSpeed), 1e-13);
    }
  }
}

// Before the first ball catches up with the second again: v_k = (1-e)/2 ((1+e)/2)^k v, and the last ((1+e)/2)^4 v.
TEST(Cradle, LosesByTheProductFormula) {
  for (const double e : {0.0, 0.5, 0.9, 0.99}) {
    const Scenario s = cradle(e, 2);
    const Trajectory path = simulate(s, {kSemiImplicitEuler, kExactTime}, 1e-3);
    double fastest = 0;
    for (std::size_t n = 0; n < path.samples(); ++n) fastest = std::max(fastest, path.at(n, 4).v_WB.x());
    if (e == 0) continue;  // glued balls arrive together and push on: its own case below
    EXPECT_GE(fastest, std::pow((1 + e) / 2, 4) * kSpeed - 1e-13) << e;
    std::size_t n = 0;
    while (path.at(n, 4).v_WB.x() == 0) ++n;
    EXPECT_NEAR(path.at(n, 4).v_WB.x(), std::pow((1 + e) / 2, 4) * kSpeed, 1e-13) << e;
  }
}

// The whole story, later catches included, against the line of points. Times of impact carry the rounding of
// positions, 2e-16 m, over the speed at which two balls meet: catches among slow balls are at a few cm/s here. Below
// e = 0.3 or so five balls collapse, meeting infinitely often before they touch for good (S. McNamara, W. R. Young,
// Phys. Fluids A 4, 1992, 496): there a list of impacts is no description any more.
TEST(Cradle, IsTheLineOfPointsToTheEnd) {
  for (const double e : {0.5, 0.7, 0.9, 1.0}) {
    const Scenario s = cradle(e, 3);
    Line line = line_of(s);
    line.run(3, static_cast<long double>(e));
    const Trajectory path = simulate(s, {kVelocityVerlet, kExactTime}, 0.05);
    EXPECT_GE(line.impacts, 4);
    for (std::size_t k = 0; k < 5; ++k) {
      const BodyState& end = path.at(path.samples() - 1, k);
      EXPECT_NEAR(end.v_WB.x(), static_cast<double>(line.v[k]), 1e-12) << e << ", ball " << k;
      EXPECT_NEAR(end.p_WB.x() - 2 * kRadius * static_cast<double>(k), static_cast<double>(line.x[k]), 1e-12)
          << e << ", ball " << k;
      EXPECT_LT(std::hypot(end.p_WB.y(), end.p_WB.z()) + end.w_WB.norm(), 1e-15);
    }
    RecordProperty("impacts_at_e_" + std::to_string(e), line.impacts);
  }
}

// Plastic impacts leave the balls together: 1/5 of the speed for all of them at the end.
TEST(Cradle, OfPlasticBallsMovesOnAsOne) {
  const Trajectory path = simulate(cradle(0, 3), {kSemiImplicitEuler, kExactTime}, 0.01);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(path.at(path.samples() - 1, k).v_WB.x(), kSpeed / 5, 1e-13);
}

}  // namespace
}  // namespace plumbline
