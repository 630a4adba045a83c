// The reference solver against Boost.odeint's Runge-Kutta-Fehlberg 7(8): time to 1e-12 after 10 s.
//
// Both get the loosest tolerance (in steps of a quarter of a decade) that ends within 1e-12 of the exact state,
// fixed-size states and inlined right-hand sides. They run in turns within one benchmark; `ratio` is that of the
// medians, ours/theirs, and the end errors stand beside it. The exact states come from Kepler's equation and from
// Taylor series in long double, which neither has had a hand in.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "known_motions.hpp"
#include "plumbline/core/integration/dormand_prince.hpp"

namespace {

using namespace plumbline;

constexpr double kEnd = 10;          // [s]
constexpr double kEndError = 1e-12;  // norm of the difference of all components

// theta'' = -sin theta
struct Pendulum {
  static constexpr std::size_t kSize = 2;
  using State = std::array<double, kSize>;
  static State start() { return {1.2, 0.7}; }
  static State exact() {
    const testing::KnownMotion m = testing::pendulum(kEnd);
    return {m.final.p_WB.x(), m.final.v_WB.x()};
  }
  template <class Y, class D>
  static void rate(const Y& y, D& d) {
    d[0] = y[1];
    d[1] = -std::sin(y[0]);
  }
};

// An orbit of semi-axis 1 and eccentricity 0.3 from its pericentre.
struct Kepler {
  static constexpr std::size_t kSize = 4;
  using State = std::array<double, kSize>;
  static constexpr double kE = 0.3;
  static State at(double t) {
    double E = t;
    for (int n = 0; n < 50; ++n) E -= (E - kE * std::sin(E) - t) / (1 - kE * std::cos(E));
    const double b = std::sqrt(1 - kE * kE), pace = 1 / (1 - kE * std::cos(E));
    return {std::cos(E) - kE, b * std::sin(E), -std::sin(E) * pace, b * std::cos(E) * pace};
  }
  static State start() { return at(0); }
  static State exact() { return at(kEnd); }
  template <class Y, class D>
  static void rate(const Y& y, D& d) {
    const double r2 = y[0] * y[0] + y[1] * y[1], pull = -1 / (r2 * std::sqrt(r2));
    d[0] = y[2];
    d[1] = y[3];
    d[2] = pull * y[0];
    d[3] = pull * y[1];
  }
};

// A free box of 0.1 x 0.4 x 0.9 m that tumbles: angular velocity in the body frame, a zero that makes the number of
// components even (neither is slower for it, ours is faster), and the attitude w x y z.
struct Top {
  static constexpr std::size_t kSize = 8;
  using State = std::array<double, kSize>;
  static State start() { return {1.1, 2, -0.6, 0, 1, 0, 0, 0}; }
  static State exact() {
    testing::TopSeries series(testing::box_inertia(), Vec3::Zero(), 0, Quat::Identity(), Vec3(1.1, 2, -0.6));
    series.advance_to(kEnd, 0.05);
    const Vec3 w = series.w_B();
    const Quat q = series.q_WB();
    return {w.x(), w.y(), w.z(), 0, q.w(), q.x(), q.y(), q.z()};
  }
  template <class Y, class D>
  static void rate(const Y& y, D& d) {
    constexpr double kX = 0.97, kY = 0.82, kZ = 0.17;  // moments in units of m/12
    d[0] = (kY - kZ) / kX * y[1] * y[2];
    d[1] = (kZ - kX) / kY * y[2] * y[0];
    d[2] = (kX - kY) / kZ * y[0] * y[1];
    d[3] = 0;
    d[4] = -0.5 * (y[5] * y[0] + y[6] * y[1] + y[7] * y[2]);
    d[5] = 0.5 * (y[4] * y[0] + y[6] * y[2] - y[7] * y[1]);
    d[6] = 0.5 * (y[4] * y[1] + y[7] * y[0] - y[5] * y[2]);
    d[7] = 0.5 * (y[4] * y[2] + y[5] * y[1] - y[6] * y[0]);
  }
};

template <class Problem>
double end_error(const typename Problem::State& y) {
  static const typename Problem::State exact = Problem::exact();
  double sum = 0;
  for (std::size_t i = 0; i < Problem::kSize; ++i) sum += (y[i] - exact[i]) * (y[i] - exact[i]);
  return std::sqrt(sum);
}

template <class Problem>
struct Ours {
  using Vector = Eigen::Matrix<double, static_cast<int>(Problem::kSize), 1>;
  static typename Problem::State solve(double tolerance) {
    DormandPrince<Vector> solver({tolerance, tolerance});
    typename Problem::State y = Problem::start();
    solver.start(0, Eigen::Map<const Vector>(y.data()));
    solver.advance_to([](double, const Vector& at, Vector& d) { Problem::rate(at, d); }, kEnd);
    Eigen::Map<Vector>(y.data()) = solver.state();
    return y;
  }
};

template <class Problem>
struct Theirs {
  static typename Problem::State solve(double tolerance) {
    namespace odeint = boost::numeric::odeint;
    using State = typename Problem::State;
    State y = Problem::start();
    odeint::integrate_adaptive(
        odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<State>()),
        [](const State& at, State& d, double) { Problem::rate(at, d); }, y, 0.0, kEnd, 0.1);
    return y;
  }
};

// The loosest tolerance that ends within kEndError; 0 when none does.
template <class Problem, template <class> class Solver>
double loosest_tolerance() {
  for (int quarter = 24; quarter <= 68; ++quarter) {
    const double tolerance = std::pow(10, -0.25 * quarter);
    if (end_error<Problem>(Solver<Problem>::solve(tolerance)) <= kEndError) return tolerance;
  }
  return 0;
}

template <class Problem, template <class> class Solver>
class Contestant {
 public:
  Contestant() : tolerance_(loosest_tolerance<Problem, Solver>()) {}
  bool ready() const { return tolerance_ > 0; }
  // One timed solution [s].
  double race() {
    const auto before = std::chrono::steady_clock::now();
    typename Problem::State y = Solver<Problem>::solve(tolerance_);
    benchmark::DoNotOptimize(y);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    seconds_.push_back(seconds);
    error_ = end_error<Problem>(y);
    return seconds;
  }
  double median() {
    const auto middle = seconds_.begin() + static_cast<std::ptrdiff_t>(seconds_.size() / 2);
    std::nth_element(seconds_.begin(), middle, seconds_.end());
    return *middle;
  }
  void report(benchmark::State& state, const std::string& who) {
    state.counters[who + "_us"] = median() * 1e6;
    state.counters[who + "_error"] = error_;
    state.counters[who + "_tol"] = tolerance_;
  }

 private:
  double tolerance_;
  double error_ = 0;
  std::vector<double> seconds_;
};

template <class Problem>
void solve_to_1e_12(benchmark::State& state) {
  Contestant<Problem, Ours> ours;
  Contestant<Problem, Theirs> theirs;
  if (!theirs.ready()) return state.SkipWithError("odeint does not reach 1e-12");
  if (!ours.ready()) return state.SkipWithError("ours does not reach 1e-12");
  for (auto _ : state) {
    state.SetIterationTime(ours.race());
    theirs.race();
  }
  ours.report(state, "ours");
  theirs.report(state, "odeint");
  state.counters["ratio"] = ours.median() / theirs.median();
}

BENCHMARK_TEMPLATE(solve_to_1e_12, Top)->UseManualTime()->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(solve_to_1e_12, Kepler)->UseManualTime()->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(solve_to_1e_12, Pendulum)->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
