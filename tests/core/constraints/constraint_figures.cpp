// The figures of docs/course/constraints.md, as Markdown. Not a test: nothing here passes or fails.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "plumbline/core/constraints/chain.hpp"
#include "plumbline/core/constraints/penalty_springs.hpp"
#include "plumbline/core/constraints/tethered_particle.hpp"
#include "plumbline/core/constraints/verlet_relaxation.hpp"

namespace {

using namespace plumbline;
constexpr double kPi = std::numbers::pi;
constexpr double kG = 9.81;
const Vec3 kGravity(0, 0, -kG);

// Straight chains held at one end, every link 1 % too long.
void residual_against_sweeps() {
  std::printf("| sweeps |");
  for (const int links : {10, 30, 100}) std::printf(" N = %d |", links);
  std::printf("\n|---|---|---|---|\n");
  std::vector<RelaxationReport> reports;
  std::vector<double> theory;
  for (const std::size_t links : {10u, 30u, 100u}) {
    Assembly chain = make_chain(row_of_points(Vec3::Zero(), Vec3(static_cast<double>(links), 0, 0), links), 1);
    for (Vec3& p : chain.p_W) p *= 1.01;
    RelaxationOptions options;
    options.sweeps = 10000;
    reports.push_back(relax(chain.constraints, chain.inverse_masses, chain.p_W, options));
    theory.push_back(std::pow(std::cos(kPi / (2 * static_cast<double>(links))), 2));
  }
  for (const std::size_t k : {0u, 1u, 10u, 100u, 1000u, 10000u}) {
    std::printf("| %zu |", k);
    for (const RelaxationReport& report : reports) std::printf(" %.1e |", report.residuals[k]);
    std::printf("\n");
  }
  // Over the second half of the sweeps until 1e-9, where only the slowest mode is left.
  std::printf("| factor per sweep |");
  for (const RelaxationReport& report : reports) {
    std::size_t to = 0;
    while (to + 1 < report.residuals.size() && report.residuals[to] > 1e-9) ++to;
    const std::size_t from = to / 2;
    std::printf(" %.6f |", std::pow(report.residuals[to] / report.residuals[from], 1 / static_cast<double>(to - from)));
  }
  std::printf("\n| cos^2(pi/2N) |");
  for (const double rate : theory) std::printf(" %.6f |", rate);
  std::printf("\n\n");
}

void semi_implicit_step(const AccelerationField& field, double dt, std::vector<BodyState>& states,
                        std::vector<Acceleration>& a) {
  field(0, states, a);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].v_WB += dt * a[i].linear;
    states[i].p_WB += dt * states[i].v_WB;
  }
}

// The step at which a chain of penalty springs begins to grow, by bisection over whole runs.
double measured_threshold(const Assembly& chain, const PenaltySpring& spring, double low, double high) {
  const auto field = penalty_field(chain.constraints, chain.inverse_masses, Vec3::Zero(), spring);
  for (int k = 0; k < 16; ++k) {
    const double dt = 0.5 * (low + high);
    std::vector<BodyState> states(chain.p_W.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].p_WB = chain.p_W[i];
      if (i > 0) states[i].p_WB.x() += (i % 2 == 0 ? 1e-9 : -1e-9);
    }
    std::vector<Acceleration> a(states.size());
    bool grows = false;
    for (int step = 0; step < 4000 && !grows; ++step) {
      semi_implicit_step(field, dt, states, a);
      for (std::size_t i = 0; i < states.size(); ++i)
        grows = grows || !(std::abs(states[i].p_WB.x() - chain.p_W[i].x()) < 1e-4);
    }
    (grows ? high : low) = dt;
  }
  return low;
}

void penalty_thresholds() {
  std::printf(
      "| links | damping ratio | w_max [rad/s] | limit of theory [s] | measured [s] |\n|---|---|---|---|---|\n");
  for (const std::size_t links : {1u, 2u, 10u, 40u}) {
    for (const double zeta : {0.0, 0.5}) {
      if (zeta > 0 && links == 2) continue;
      const Assembly chain = make_chain(row_of_points(Vec3::Zero(), Vec3(static_cast<double>(links), 0, 0), links), 1);
      PenaltySpring spring{1e4, 0};
      const double w = largest_penalty_frequency(chain.constraints, chain.inverse_masses, chain.p_W, spring);
      spring.damping = 2 * zeta * spring.stiffness / w;
      const double limit = largest_stable_step(w, zeta);
      std::printf("| %zu | %.1f | %.3f | %.6f | %.6f |\n", links, zeta, w, limit,
                  measured_threshold(chain, spring, 0.5 * limit, 1.5 * limit));
    }
  }
  std::printf("\n");
}

struct Outcome {
  Vec3 p_W;
  double steps;
};

template <class Run>
void row(const char* name, const Vec3& exact, const Run& run) {
  double best = 1e9;
  Outcome outcome{};
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
    outcome = run();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("| %s | %.0f | %.0f | %.1e |\n", name, outcome.steps, 1e6 * best, (outcome.p_W - exact).norm());
}

// A pendulum of 1 m and 1 kg let go level, for one second, by each way to hold it.
void three_ways() {
  const auto by_events = [] {
    TetheredParticle pendulum({}, kGravity, Vec3(-1, 0, 0), Vec3::Zero());
    pendulum.advance_to(1);
    return Outcome{pendulum.position(), 0};
  };
  const Vec3 exact = by_events().p_W;
  const Assembly pendulum = make_chain(std::vector<Vec3>{Vec3::Zero(), Vec3(-1, 0, 0)}, 1);
  std::printf("| way | steps | time [us] | error at 1 s [m] |\n|---|---|---|---|\n");
  for (const double k : {1e4, 1e6, 1e8}) {
    const auto by_penalty = [&] {
      const PenaltySpring spring{k, 0};
      const auto steps = static_cast<int>(std::ceil(1 / (0.1 * largest_stable_step(std::sqrt(k)))));
      const auto field = penalty_field(pendulum.constraints, pendulum.inverse_masses, kGravity, spring);
      std::vector<BodyState> states(2);
      states[1].p_WB = pendulum.p_W[1];
      std::vector<Acceleration> a(2);
      for (int n = 0; n < steps; ++n) semi_implicit_step(field, 1.0 / steps, states, a);
      return Outcome{states[1].p_WB, static_cast<double>(steps)};
    };
    char name[64];
    std::snprintf(name, sizeof name, "penalty spring, k = %.0e N/m", k);
    row(name, exact, by_penalty);
  }
  for (const Pull pull : {Pull::kMinimal, Pull::kStart}) {
    for (const int steps : {100, 1000, 10000}) {
      const auto by_relaxation = [&] {
        VerletOptions options;
        options.pull = pull;
        options.relaxation.sweeps = 1;
        VerletRelaxation run(pendulum, 1.0 / steps, options);
        for (int n = 0; n < steps; ++n) run.step();
        return Outcome{run.positions()[1], static_cast<double>(steps)};
      };
      row(pull == Pull::kMinimal ? "relaxation, the slide's pull" : "relaxation, SHAKE's pull", exact, by_relaxation);
    }
  }
  row("exact between events", exact, by_events);
  std::printf("\n");
}

// A chain of ten links of 1 m at rest under its weight, dt = 0.01 s.
void stretch_against_sweeps() {
  std::printf("| sweeps a step | largest stretch of a link [m] |\n|---|---|\n");
  for (const int sweeps : {1, 4, 16, 64, 256}) {
    VerletOptions options;
    options.drag = 5;
    options.relaxation.sweeps = sweeps;
    VerletRelaxation run(make_chain(row_of_points(Vec3::Zero(), Vec3(0, 0, -10), 10), 1), 0.01, options);
    double stretch = 0;
    for (int k = 0; k < 2000; ++k) stretch = run.step().residuals.back();
    std::printf("| %d | %.1e |\n", sweeps, stretch);
  }
}

}  // namespace

int main() {
  residual_against_sweeps();
  penalty_thresholds();
  three_ways();
  stretch_against_sweeps();
}
