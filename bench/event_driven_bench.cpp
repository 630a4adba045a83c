// What zero tolerance costs (course slide 33): the event-driven simulator against penalty springs on the same gas.
//
// For each: time for one time unit of the gas (n spheres, density 0.5, m = sigma = kT = 1) and for one impact, the
// change of energy, and for the springs the deepest overlap (events have none, which a test shows). Cost against n:
// EventDrivenGas/7, /14, /30 are 1372, 10976, 108000 spheres.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plumbline/core/events/event_driven_simulator.hpp"

namespace plumbline {
namespace {

void event_driven_gas(benchmark::State& state) {
  EventDrivenSimulator gas(hard_sphere_scene(hard_sphere_crystal(static_cast<int>(state.range(0)), 0.5, 1)));
  gas.run_until(1);  // melt
  const double energy = gas.kinetic_energy(), start = gas.time();
  const std::uint64_t before = gas.counts().impacts;
  const double span = 1000.0 / static_cast<double>(gas.size());
  for ([[maybe_unused]] auto unused : state) gas.run_until(gas.time() + span);
  const auto impacts = static_cast<double>(gas.counts().impacts - before);
  state.counters["s_per_impact"] =
      benchmark::Counter(impacts, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["s_per_unit"] =
      benchmark::Counter(gas.time() - start, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["energy_change"] = gas.kinetic_energy() / energy - 1;
}

// Linear springs that push overlapping spheres apart, velocity Verlet, a cell list made anew in every step.
class PenaltyGas {
 public:
  PenaltyGas(const HardSphereState& s, double stiffness)
      : p_(s.positions), v_(s.velocities), f_(p_.size(), Vec3::Zero()), box_(s.box_length), stiffness_(stiffness) {
    push();
  }

  void step(double dt) {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      v_[i] += 0.5 * dt * f_[i];
      p_[i] += dt * v_[i];
      p_[i] -= box_ * (p_[i] / box_).array().floor().matrix();
    }
    push();
    for (std::size_t i = 0; i < p_.size(); ++i) v_[i] += 0.5 * dt * f_[i];
  }

  double energy() const {
    double sum = potential_;
    for (const Vec3& v : v_) sum += 0.5 * v.squaredNorm();
    return sum;
  }
  double deepest() const { return deepest_; }

 private:
  void push() {
    const int n = static_cast<int>(p_.size());
    EventCells cells(Vec3::Zero(), Vec3::Constant(box_), 1.0, n, true);
    for (int i = 0; i < n; ++i) cells.insert(i, p_[static_cast<std::size_t>(i)]);
    potential_ = 0;
    for (int i = 0; i < n; ++i) {
      Vec3& force = f_[static_cast<std::size_t>(i)];
      force.setZero();
      cells.visit_near(i, [&](int j, const Vec3& shift) {
        const Vec3 d = p_[static_cast<std::size_t>(j)] + shift - p_[static_cast<std::size_t>(i)];
        const double square = d.squaredNorm();
        if (square >= 1) return;
        const double distance = std::sqrt(square), overlap = 1 - distance;
        force -= stiffness_ * overlap / distance * d;
        potential_ += 0.25 * stiffness_ * overlap * overlap;  // each pair comes twice
        deepest_ = std::max(deepest_, overlap);
      });
    }
  }

  std::vector<Vec3> p_, v_, f_;
  double box_, stiffness_, potential_ = 0, deepest_ = 0;
};

// range(0): overlap in thousandths of a diameter at which a typical impact (relative speed 2 sqrt(kT/m) along the
// normal) turns; range(1): steps for one contact, which lasts pi sqrt(mu/k).
void penalty_gas(benchmark::State& state) {
  const double typical = 1e-3 * static_cast<double>(state.range(0)), mu = 0.5;
  const double stiffness = mu * 4 / (typical * typical);
  const double dt = std::numbers::pi * std::sqrt(mu / stiffness) / static_cast<double>(state.range(1));
  PenaltyGas gas(hard_sphere_crystal(7, 0.5, 1), stiffness);
  const double energy = gas.energy();
  double time = 0;
  for ([[maybe_unused]] auto unused : state) {
    gas.step(dt);
    time += dt;
  }
  state.counters["s_per_unit"] = benchmark::Counter(time, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["energy_change"] = gas.energy() / energy - 1;
  state.counters["overlap"] = gas.deepest();
}

// The Zeno ball (h = 1, e = 0.5) until it rests, train by the series.
void zeno_ball(benchmark::State& state) {
  EventScene scene;
  scene.gravity_W = Vec3(0, 0, -9.81);
  scene.walls = {{{Vec3::UnitZ(), 0}, 0.5}};
  scene.balls = {{Vec3(0, 0, 1.1), Vec3::Zero(), 0.1, 1}};
  double stop = 0, impacts = 0;
  for ([[maybe_unused]] auto unused : state) {
    EventDrivenSimulator simulator(scene);
    for (const Impact& impact : simulator.record_until(2)) stop = impact.time;
    impacts = static_cast<double>(simulator.counts().impacts);
  }
  state.counters["impacts"] = impacts;
  state.counters["stop_error"] = stop - std::sqrt(2 / 9.81) * 3;
}

// The same with a spring and a damper in the floor, chosen for e = 0.5 and steps of dt = 2 s / range(0), fifty for a
// contact; what is reported is how far the second apex, at e^2 h, is off.
void zeno_penalty(benchmark::State& state) {
  const double dt = 2.0 / static_cast<double>(state.range(0)), contact = 50 * dt;
  const double decay = std::log(2) / contact, omega = std::numbers::pi / contact;
  const double stiffness = omega * omega + decay * decay;
  double apex = 0;
  for ([[maybe_unused]] auto unused : state) {
    double z = 1, v = 0;
    apex = 0;
    bool bounced = false;
    for (std::int64_t k = 0; k < state.range(0); ++k) {
      double a = -9.81;
      if (z < 0) a -= stiffness * z + 2 * decay * v;
      v += a * dt;
      z += v * dt;
      bounced = bounced || z < 0;
      if (bounced && k < state.range(0) / 2) apex = std::max(apex, z);
    }
    benchmark::DoNotOptimize(z);
  }
  state.counters["apex_error"] = apex - 0.25;
}

BENCHMARK(event_driven_gas)->Name("EventDrivenGas")->Arg(7)->Arg(14)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(penalty_gas)
    ->Name("PenaltyGas")
    ->Args({100, 20})
    ->Args({10, 20})
    ->Args({1, 20})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(zeno_ball)->Name("ZenoBall")->Unit(benchmark::kMicrosecond);
BENCHMARK(zeno_penalty)->Name("ZenoPenalty")->Arg(2000)->Arg(200000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace plumbline

BENCHMARK_MAIN();
