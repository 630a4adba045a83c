// Reduced coordinates against closed forms, published numbers and their own independent definitions.
#include "plumbline/core/joints/reduced_tree.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "jointed_scenes.hpp"
#include "plumbline/core/exact/lagrange_top.hpp"
#include "plumbline/core/exact/planar_pendulum.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"
#include "plumbline/core/integration/reference_integration.hpp"
#include "plumbline/core/joints/constrained_motion.hpp"
#include "plumbline/core/metric.hpp"

namespace plumbline {
namespace {

using namespace jointed;
using Vector = ReducedTree::Vector;

Vector vector_of(std::initializer_list<double> numbers) {
  Vector v(static_cast<Eigen::Index>(numbers.size()));
  Eigen::Index k = 0;
  for (const double x : numbers) v[k++] = x;
  return v;
}

Vector random_vector(Random& random, Eigen::Index n, double size) {
  Vector v(n);
  for (Eigen::Index k = 0; k < n; ++k) v[k] = random.in(-size, size);
  return v;
}

// (q, q') at time t.
Vector at(const ReducedTree& tree, const Vector& y0, double t, double tolerance = 1e-15) {
  DormandPrince<Vector> solver({tolerance, tolerance});
  solver.start(0, y0);
  solver.advance_to(tree, t);
  return solver.state();
}

TEST(ReducedTree, SwingsAsTheExactPendulumOverTenSeconds) {
  const ReducedTree tree(point_chain(1));
  const PlanarPendulum exact(std::sqrt(9.81), {-std::numbers::pi / 2, 0});
  EXPECT_NEAR(exact.period(), 2.367841947576, 5e-13);  // published with 13 digits
  double largest = 0;
  for (const double t : {1.0, 5.0, 10.0}) {
    const Vector y = at(tree, vector_of({-std::numbers::pi / 2, 0}), t);
    largest = std::max(largest, std::abs(y[0] - exact.at(t).angle));
    EXPECT_NEAR(y[0], exact.at(t).angle, 1e-12);  // asked of a reference
  }
  RecordProperty("error_1e-18", std::to_string(largest * 1e18));
  // IFToMM benchmark A01, as published to 1e-8; the last digit of its second number should be a 5.
  const BodyState bob = tree.states(vector_of({exact.at(1).angle}), vector_of({0}))[0];
  EXPECT_NEAR(bob.p_WB.x(), 0.98629175, 1e-8);
  EXPECT_NEAR(bob.p_WB.z(), -0.16501086, 1e-8);
}

TEST(ReducedTree, SwingsAsTheDoublePendulumToFourteenDigits) {
  const double right = std::numbers::pi / 2;
  for (const ArticulatedBody& body : {point_chain(2), equimomental_double_pendulum()}) {
    const Vector y = at(ReducedTree(body), vector_of({right, 0, 0, 0}), 1);
    // Angles from the vertical after 1 s from rest, from an extrapolation in 30 digits; the hinges know relative ones.
    // A disturbance grows by less than 50 in that second.
    EXPECT_NEAR(y[0], -0.6250876998063906, 2e-13);
    EXPECT_NEAR(y[0] + y[1], -1.034585085680012, 2e-13);
    EXPECT_NEAR(y[2], -3.922279572887977, 1e-12);
    EXPECT_NEAR(y[2] + y[3], -1.303099248696331, 1e-12);
  }
}

double laguerre(int n, double x) {
  double previous = 1, value = 1 - x;
  if (n == 0) return previous;
  for (int k = 1; k < n; ++k) {
    const double next = ((2 * k + 1 - x) * value - k * previous) / (k + 1);
    previous = value;
    value = next;
  }
  return value;
}

// Small swings of n point masses: det(K - w^2 M) vanishes where Laguerre's polynomial L_n(w^2 l/g) does; as polynomials
// of the same degree with the same roots, they are proportional.
TEST(ReducedTree, HasTheFrequenciesOfTheHangingChain) {
  for (int n = 1; n <= 6; ++n) {
    const ReducedTree tree(point_chain(static_cast<std::size_t>(n)));
    const Vector zero = Vector::Zero(n);
    const Eigen::MatrixXd M = tree.mass_matrix(zero);
    Eigen::MatrixXd K(n, n);
    const double h = 1e-3;
    for (int j = 0; j < n; ++j) {
      const auto c = [&](double x) { return tree.inverse_dynamics(x * Vector::Unit(n, j), zero, zero); };
      K.col(j) = (8 * (c(h) - c(-h)) - (c(2 * h) - c(-2 * h))) / (12 * h);
    }
    for (const double x : {0.3, 1.7, 4.0, 9.0}) {
      // Differences leave h^4/30 + eps/h = 3e-13 in K; det and L_n multiply that by their condition, below 1e3.
      const double ratio = (K - x * 9.81 * M).determinant() / K.determinant();
      EXPECT_NEAR(ratio, laguerre(n, x), 1e-9 * (1 + std::abs(ratio))) << n << " " << x;
    }
  }
  for (const double x : {0.41577456, 2.29428036, 6.28994508}) EXPECT_NEAR(laguerre(3, x), 0, 5e-8);  // as published
}

TEST(ReducedTree, HasTheMassMatrixThatItsInverseDynamicsImplies) {
  Random random(11);
  for (int n = 0; n < 50; ++n) {
    const ReducedTree tree(random_tree(random, 1 + random.below(8)));
    const Eigen::Index d = tree.freedoms();
    const Vector q = random_vector(random, d, 2), qd = random_vector(random, d, 2);
    const Eigen::MatrixXd M = tree.mass_matrix(q);
    const Vector c = tree.inverse_dynamics(q, qd, Vector::Zero(d));
    // Composite bodies against Newton-Euler: sums over bodies of up to 8 with arms up to 10 m.
    const double scale = 100 * kEps * (M.norm() + c.norm());
    for (Eigen::Index j = 0; j < d; ++j) {
      EXPECT_LT((tree.inverse_dynamics(q, qd, Vector::Unit(d, j)) - c - M.col(j)).norm(), scale);
    }
    // Kinetic energy, by the velocities of all bodies, is q'.M q'/2.
    const double kinetic = tree.energy(q, qd) - tree.energy(q, Vector::Zero(d));
    EXPECT_NEAR(kinetic, qd.dot(M * qd) / 2, 100 * kEps * (std::abs(tree.energy(q, qd)) + 100 * kinetic));
    const Vector tau = random_vector(random, d, 5);
    const Vector qdd = tree.accelerations(q, qd, tau);
    EXPECT_LT((tree.inverse_dynamics(q, qd, qdd) - tau).norm(), 100 * kEps * (M.norm() * qdd.norm() + c.norm() + 10));
  }
}

TEST(ReducedTree, KeepsTheEnergyOfRandomTrees) {
  Random random(12);
  double largest = 0;
  for (int n = 0; n < 10; ++n) {
    const ReducedTree tree(random_tree(random, 4));
    const Eigen::Index d = tree.freedoms();
    Vector y(2 * d);
    y << random_vector(random, d, 1), random_vector(random, d, 1);
    const Vector end = at(tree, y, 1);
    const double before = tree.energy(y.head(d), y.tail(d)), after = tree.energy(end.head(d), end.tail(d));
    const double scale = std::abs(before) + 100;  // [J]: what falls and rises within
    EXPECT_NEAR(after, before, 1e-12 * scale);
    largest = std::max(largest, std::abs(after - before) / scale);
  }
  RecordProperty("relative_1e-18", std::to_string(largest * 1e18));
}

// The same trees in maximal coordinates, with other equations and another state vector.
TEST(ReducedTree, FollowsThePathOfMaximalCoordinates) {
  Random random(13);
  double largest = 0;
  for (int n = 0; n < 5; ++n) {
    const ArticulatedBody body = random_tree(random, 3);
    const ReducedTree tree(body);
    const Eigen::Index d = tree.freedoms();
    Vector y(2 * d);
    y << random_vector(random, d, 1), random_vector(random, d, 1);
    const double times[] = {0.5};
    const ReferenceRun run =
        integrate_reference(constrained_field(body), 0, tree.states(y.head(d), y.tail(d)), times, 1e-14);
    const Vector end = at(tree, y, 0.5);
    const std::vector<BodyState> expected = tree.states(end.head(d), end.tail(d));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double error = max_or_nan((run.states[i].p_WB - expected[i].p_WB).norm(),
                                      geodesic_angle(run.states[i].q_WB, expected[i].q_WB));
      EXPECT_LT(error, 1e-10);  // asked of a reference
      largest = max_or_nan(largest, error);
    }
  }
  RecordProperty("path_1e-18", std::to_string(largest * 1e18));
}

// About z, then x, then y, with two bodies without mass between: the heavy top of constrained_motion_test.cpp, pushed
// differently. Pushed as there, L_z = -L_axis, it swings through the hanging position: a gimbal lock.
TEST(ReducedTree, MakesABallJointOfThreeHinges) {
  ArticulatedBody top;
  top.gravity_W = Vec3(0, 0, -9.81);
  const Vec3 axes[] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  for (std::size_t k = 0; k < 3; ++k) {
    const JointFrame frame = frame_along(Vec3::Zero(), axes[k]);
    top.bodies.push_back({0, Mat3::Zero()});
    top.joints.push_back({JointKind::kHinge, k == 0 ? kWorld : k - 1, k, frame, frame, std::nullopt, 0, {}});
  }
  top.bodies[2] = {15, Vec3(0.234375, 0.46875, 0.234375).asDiagonal()};
  top.joints[2].on_b.anchor = -Vec3::UnitY();
  const ReducedTree tree(top);
  const Vector start = vector_of({0, 0, 0, 2, 0, 150});
  const BodyState initial = tree.states(start.head(3), start.tail(3))[2];
  EXPECT_LT((initial.w_WB - Vec3(0, 150, 2)).norm(), 1e-13);
  const Vector end = at(tree, start, 1, 1e-13);  // products of w^2 = 22500 and 15 kg round to 1e-12
  const BodyState expected = LagrangeTop({15, Vec3::UnitY(), 0.46875, 0.234375, 9.81}, initial).at(1);
  const BodyState actual = tree.states(end.head(3), end.tail(3))[2];
  EXPECT_LT(geodesic_angle(actual.q_WB, expected.q_WB), 1e-10);  // asked of a reference
  EXPECT_LT((actual.p_WB - expected.p_WB).norm(), 1e-10);
  RecordProperty("attitude_1e-18", std::to_string(geodesic_angle(actual.q_WB, expected.q_WB) * 1e18));
}

TEST(ReducedTree, RefusesWhatIsNoTree) {
  const ArticulatedBody good = point_chain(3);
  const auto refused = [&](auto change) {
    ArticulatedBody bad = good;
    change(bad);
    EXPECT_THROW(ReducedTree{bad}, std::invalid_argument);
  };
  refused([](ArticulatedBody& bad) { bad.joints.push_back(bad.joints[0]); });  // a loop
  refused([](ArticulatedBody& bad) { std::swap(bad.joints[0], bad.joints[1]); });
  refused([](ArticulatedBody& bad) { bad.joints[1].a = 2; });
  refused([](ArticulatedBody& bad) { bad.joints[1].kind = JointKind::kBall; });
  refused([](ArticulatedBody& bad) { bad.bodies[1].mass = -1; });
  const ReducedTree tree(good);
  EXPECT_THROW(tree.mass_matrix(Vector::Zero(2)), std::invalid_argument);
  ArticulatedBody weightless = point_chain(1);
  weightless.bodies[0].mass = 0;
  EXPECT_THROW(ReducedTree(weightless).accelerations(vector_of({0}), vector_of({0})), std::runtime_error);
}

}  // namespace
}  // namespace plumbline
