// What does a stack cost? Reported, without an aim yet.
//
//   Stack/n    n unit cubes on the ground, mu = 0.5, one step of 1/60 s of Simulator; drift: how far any has moved over
//              the run [m]
#include <benchmark/benchmark.h>

#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

void Stack(benchmark::State& state) {
  Scenario s;
  s.gravity = Vec3(0, 0, -9.81);
  s.contact = ContactMaterial{0, 0.5};
  s.bodies.push_back({"ground", HalfSpace{Vec3::UnitZ()}, true, 0, Vec3::Zero(), {}});
  for (int k = 0; k < static_cast<int>(state.range(0)); ++k) {
    Body cube{"cube", Box{Vec3::Ones()}, false, 1, Vec3::Zero(), {}};
    cube.inertia = solid_inertia(cube.shape, 1);
    cube.initial.p_WB = Vec3(0, 0, 0.5 + k);
    s.bodies.push_back(cube);
  }
  Simulator simulator(s, {Integrator::kSemiImplicitEuler, ImpactRule::kStepStart});
  for (auto _ : state) simulator.step(1.0 / 60);
  double drift = 0;
  for (std::size_t i = 1; i < s.bodies.size(); ++i) {
    const double moved = (simulator.states()[i].p_WB - s.bodies[i].initial.p_WB).norm();
    if (!(moved <= drift)) drift = moved;
  }
  state.counters["drift"] = drift;
}

BENCHMARK(Stack)->Arg(1)->Arg(2)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace plumbline

BENCHMARK_MAIN();
