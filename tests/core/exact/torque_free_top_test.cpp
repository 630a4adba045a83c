#include "plumbline/core/exact/torque_free_top.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "independent_check.hpp"
#include "plumbline/core/body.hpp"

namespace plumbline {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// The box and the spin of the OSRF benchmark (10 kg, 0.1 x 0.4 x 0.9 m): it flips every three seconds.
const Vec3 kBoxInertia = solid_inertia(Box{Vec3(0.1, 0.4, 0.9)}, 10);
BodyState spinning(const Vec3& w_W) {
  BodyState state;
  state.w_WB = w_W;
  return state;
}

Vec3 momentum(const Vec3& inertia, const BodyState& s) {
  return s.q_WB * inertia.cwiseProduct(s.q_WB.conjugate() * s.w_WB);
}
double twice_energy(const Vec3& inertia, const BodyState& s) { return momentum(inertia, s).dot(s.w_WB); }

Vec3 any_inertia(std::mt19937_64& bits) {
  const Vec3 spread = 0.5 * (uniform_vector(bits) + 1.02 * Vec3::Ones());  // int x^2 dm, ...
  return Vec3::Constant(spread.sum()) - spread;
}

TEST(TorqueFreeTop, MatchesThePublishedDzhanibekovNumbers) {
  const TorqueFreeTop top(kBoxInertia, spinning(Vec3(0.1, 5, 0.1)));
  EXPECT_NEAR(top.rate(), 3.845815153072, 1e-12);
  EXPECT_NEAR(top.parameter(), 0.99985999398, 1e-11);
  EXPECT_NEAR(top.half_period(), 3.028422079, 1e-9);
  const BodyState s = top.at(1);
  EXPECT_LT((s.q_WB.coeffs() - Eigen::Vector4d(0.35235939, 0.52518419, -0.30248729, -0.71311)).norm(), 1e-8);
  EXPECT_LT((s.q_WB.conjugate() * s.w_WB - Vec3(3.42379844, 2.81918544, 3.92838445)).norm(), 1e-8);
  for (const double zero : {1.165960046, 4.194382125, 7.222804204}) {
    EXPECT_NEAR((top.at(zero).q_WB.conjugate() * top.at(zero).w_WB).y(), 0, 20 * 1e-9);  // |dw/dt| < 20
  }
}

TEST(TorqueFreeTop, StartsWhereItIsPut) {
  std::mt19937_64 bits(1);
  for (int k = 0; k < 500; ++k) {
    BodyState s = spinning(5 * uniform_vector(bits));
    s.p_WB = uniform_vector(bits);
    s.q_WB = uniform_attitude(bits);
    s.v_WB = uniform_vector(bits);
    const BodyState at0 = TorqueFreeTop(any_inertia(bits), s).at(0);
    EXPECT_LT(geodesic_angle(at0.q_WB, s.q_WB), 32 * kEps);
    // Rounding of the phase, u0 = F(phi0), moves w by its rate; close to the separatrix |F| reaches 20.
    EXPECT_LT((at0.w_WB - s.w_WB).norm(), 1e-13);
    EXPECT_EQ(at0.p_WB, s.p_WB);
  }
}

TEST(TorqueFreeTop, SatisfiesEulersEquations) {
  std::mt19937_64 bits(2);
  for (int k = 0; k < 300; ++k) {
    const Vec3 inertia = any_inertia(bits);
    BodyState s = spinning(uniform_vector(bits));
    s.q_WB = uniform_attitude(bits);
    const TorqueFreeTop top(inertia, s);
    const double t = 20 * uniform(bits) - 10;
    const auto w_B = [&](double x) { return (top.at(x).q_WB.conjugate() * top.at(x).w_WB).eval(); };
    const Vec3 w = w_B(t), residual = inertia.cwiseProduct(derivative(w_B, t, 0.02)) + w.cross(inertia.cwiseProduct(w));
    // |w| <= 1.8 rad/s: truncation (0.02 x 1.8)^8 x 9!/630 = 2e-9 at worst for the nearest pole, which random moments
    // come nowhere near; rounding 1e-14/0.02. Moments are < 3.
    EXPECT_LT(residual.norm(), 1e-10);
    // and the attitude follows w: dq/dt = w q/2, with the sign of q kept along the stencil.
    const auto q = [&](double x) {
      const Eigen::Vector4d c = top.at(x).q_WB.coeffs();
      return (c.dot(top.at(t).q_WB.coeffs()) < 0 ? -c : c).eval();
    };
    const BodyState here = top.at(t);
    const Quat w_quat(0, here.w_WB.x(), here.w_WB.y(), here.w_WB.z());
    EXPECT_LT((derivative(q, t, 0.02) - 0.5 * (w_quat * here.q_WB).coeffs()).norm(), 1e-10);
  }
}

TEST(TorqueFreeTop, KeepsMomentumAndEnergy) {
  std::mt19937_64 bits(3);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 inertia = any_inertia(bits);
    const BodyState s = spinning(5 * uniform_vector(bits));
    const TorqueFreeTop top(inertia, s);
    const BodyState later = top.at(10 * uniform(bits));
    const Vec3 l0 = momentum(inertia, s);
    // Algebraic identities of sn, cn, dn at one u: rounding only, whatever the time.
    EXPECT_LT((momentum(inertia, later) - l0).norm(), 1e-13 * l0.norm());
    EXPECT_NEAR(twice_energy(inertia, later), twice_energy(inertia, s), 1e-13 * twice_energy(inertia, s));
  }
}

TEST(TorqueFreeTop, AgreesWithAnIntegrationOverTenSeconds) {
  // 50 rad turned: rounding 50 eps = 1e-14, times 1/sqrt of how far the flips stretch it; 1e-12 leaves room for 100.
  for (const Vec3& w : {Vec3(0.1, 5, 0.1), Vec3(0.1, 3, 2), Vec3(0.1, 5, 0.2), Vec3(0, 0.1, 5)}) {
    BodyState s = spinning(w);
    s.q_WB = rotation_by(Vec3(0.3, -0.2, 0.5));
    LongDoubleTop integration(kBoxInertia, Vec3::Zero(), Vec3::Zero(), s);
    integration.run(10, 150000);
    const BodyState exact = TorqueFreeTop(kBoxInertia, s).at(10);
    const double angle = geodesic_angle(exact.q_WB, integration.attitude());
    EXPECT_LT(angle, 1e-12) << w.transpose();
    EXPECT_LT((exact.w_WB - integration.w_W()).norm(), 5e-12) << w.transpose();
  }
}

TEST(TorqueFreeTop, PrecessesSteadilyWhenSymmetric) {
  // I = .04, .04, .02 (Kane): the axis goes round L at L/I_t, w goes round the axis at (I_t - I_s) w3/I_t.
  const Vec3 inertia(0.04, 0.04, 0.02);
  const BodyState s = spinning(Vec3(2, 0, 3));
  const TorqueFreeTop top(inertia, s);
  const Vec3 l = momentum(inertia, s);
  const double t = 1.7, body_rate = (0.04 - 0.02) * 3 / 0.04;
  const BodyState later = top.at(t);
  const Vec3 axis = rotation_by(l / 0.04 * t) * Vec3::UnitZ();
  EXPECT_LT((later.q_WB * Vec3::UnitZ() - axis).norm(), 100 * kEps);
  const Vec3 w_B = later.q_WB.conjugate() * later.w_WB;
  EXPECT_LT((w_B - Vec3(2 * std::cos(body_rate * t), -2 * std::sin(body_rate * t), 3)).norm(), 100 * kEps);
}

TEST(TorqueFreeTop, FollowsTheSeparatrixAndItsNeighbourhood) {
  // L^2 = 2 E I2 with moments 1, 2, 3: w1 = w3 sqrt(3). From there w decays to the middle axis as a sech.
  const Vec3 inertia(1, 2, 3);
  for (const double off : {0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-4}) {
    const BodyState s = spinning(Vec3(std::sqrt(3.0), 0, 1 + off));
    LongDoubleTop integration(inertia, Vec3::Zero(), Vec3::Zero(), s);
    integration.run(4, 20000);
    const TorqueFreeTop top(inertia, s);
    // Near the unstable axis a rounding of 1e-16 grows like exp(lambda t), lambda = 1.15: 100 after 4 s.
    EXPECT_LT(geodesic_angle(top.at(4).q_WB, integration.attitude()), 1e-12) << off;
    EXPECT_LT((top.at(4).w_WB - integration.w_W()).norm(), 1e-12) << off;
  }
}

TEST(TorqueFreeTop, SpinsSteadilyAboutPrincipalAxesAndAsASphere) {
  for (const Vec3& w : {Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, -3), Vec3(0, 0, 0)}) {
    const TorqueFreeTop top(Vec3(1, 2, 2.5), spinning(w));
    EXPECT_LT(geodesic_angle(top.at(2).q_WB, rotation_by(2 * w)), 16 * kEps);
    EXPECT_TRUE(std::isinf(top.half_period()));
  }
  const Vec3 w(1, 2, 3);
  EXPECT_LT(geodesic_angle(TorqueFreeTop(Vec3::Ones(), spinning(w)).at(2).q_WB, rotation_by(2 * w)), 16 * kEps);
}

TEST(TorqueFreeTop, KeepsItsDigitsNearASteadySpin) {
  // w1, w2 of 1e-9 beside w3 = 5: they must keep their own digits, not those of w3.
  const BodyState s = spinning(Vec3(1e-9, 0, 5));
  const TorqueFreeTop top(Vec3(1, 2, 2.5), s);
  const BodyState later = top.at(1);
  const double rate = 5 * std::sqrt(1.5 * 0.5 / 2.0);  // small oscillation: w3 sqrt((I3 - I1)(I3 - I2)/(I1 I2))
  EXPECT_NEAR((later.q_WB.conjugate() * later.w_WB).x(), 1e-9 * std::cos(rate), 1e-23);
}

TEST(TorqueFreeTop, RefusesWhatIsNoBody) {
  EXPECT_THROW(TorqueFreeTop(Vec3(1, 1, 3), BodyState{}), std::invalid_argument);
  EXPECT_THROW(TorqueFreeTop(Vec3(0, 1, 1), BodyState{}), std::invalid_argument);
  EXPECT_THROW(TorqueFreeTop(Vec3(1, 1, std::nan("")), BodyState{}), std::invalid_argument);
  EXPECT_THROW(TorqueFreeTop(Vec3(1, 1, 1), spinning(Vec3(std::nan(""), 0, 0))), std::invalid_argument);
  BodyState stretched;
  stretched.q_WB.coeffs() *= 2;
  EXPECT_THROW(TorqueFreeTop(Vec3(1, 1, 1), stretched), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
