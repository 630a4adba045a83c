// What does one step of a free rigid body cost? Nanoseconds per body and step, at 1e3 to 1e6 bodies.
//
//   FreeBodies/n     one call a step; FreeBodies100/n: a hundred steps a call
//   Simulator/n      the readable form of the same scheme, and the end state that both must share
//
// Beside each figure: `energy`, the relative change of the kinetic energy of rotation over the run.
#include <benchmark/benchmark.h>

#include <random>

#ifdef PLUMBLINE_BENCH_ODE
#include <ode/ode.h>
#endif

#include "plumbline/core/invariant.hpp"
#include "plumbline/core/kinetics/free_bodies.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

constexpr double kStep = 1e-3;  // [s]

Scenario swarm(std::size_t count) {
  std::mt19937_64 bits(3);
  const auto uniform = [&] { return 2 * static_cast<double>(bits() >> 11) * 0x1p-53 - 1; };
  const auto vector = [&] { return Vec3(uniform(), uniform(), uniform()); };
  Scenario s;
  s.gravity = Vec3(0, 0, -9.81);
  s.bodies.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Body b{"", Box{Vec3(1.5, 1.2, 1) + 0.4 * vector()}, false, 1, Vec3::Zero(), {}};
    b.inertia = solid_inertia(b.shape, b.mass);
    b.initial = {vector(), rotation_by(3 * vector()), vector(), 3 * vector()};
    s.bodies.push_back(b);
  }
  return s;
}

// Without translation, whose energy has an error of its own.
double energy_of_rotation(const Scenario& scenario, std::vector<BodyState> states) {
  for (BodyState& s : states) s.p_WB = s.v_WB = Vec3::Zero();
  return energy(scenario, states);
}

void report(benchmark::State& state, const Scenario& scenario, const std::vector<BodyState>& end, std::size_t steps) {
  std::vector<BodyState> start;
  for (const Body& body : scenario.bodies) start.push_back(body.initial);
  const double work = static_cast<double>(scenario.bodies.size()) * static_cast<double>(steps);
  state.counters["per_body_and_step"] =
      benchmark::Counter(work, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);  // [s]
  state.counters["energy"] = energy_of_rotation(scenario, end) / energy_of_rotation(scenario, start) - 1;
}

void fly(benchmark::State& state, std::size_t steps_a_call) {
  const Scenario scenario = swarm(static_cast<std::size_t>(state.range(0)));
  FreeBodies flight(scenario.bodies, scenario.gravity);
  for (auto _ : state) flight.step(kStep, steps_a_call);
  std::vector<BodyState> end(flight.size());
  flight.read(end);
  report(state, scenario, end, steps_a_call);
}

void FreeBodiesOneStep(benchmark::State& state) { fly(state, 1); }
void FreeBodies100Steps(benchmark::State& state) { fly(state, 100); }

void ReadableSimulator(benchmark::State& state) {
  const Scenario scenario = swarm(static_cast<std::size_t>(state.range(0)));
  Simulator simulator(scenario, {});
  for (auto _ : state) simulator.step(kStep);
  report(state, scenario, {simulator.states().begin(), simulator.states().end()}, 1);
}

#ifdef PLUMBLINE_BENCH_ODE
void OdeQuickStep(benchmark::State& state) {
  const Scenario scenario = swarm(static_cast<std::size_t>(state.range(0)));
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, scenario.gravity.x(), scenario.gravity.y(), scenario.gravity.z());
  std::vector<dBodyID> bodies;
  for (const Body& body : scenario.bodies) {
    const dBodyID id = dBodyCreate(world);
    dMass mass;
    dMassSetParameters(&mass, body.mass, 0, 0, 0, body.inertia.x(), body.inertia.y(), body.inertia.z(), 0, 0, 0);
    dBodySetMass(id, &mass);
    const BodyState& s = body.initial;
    const dQuaternion q = {s.q_WB.w(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z()};
    dBodySetPosition(id, s.p_WB.x(), s.p_WB.y(), s.p_WB.z());
    dBodySetQuaternion(id, q);
    dBodySetLinearVel(id, s.v_WB.x(), s.v_WB.y(), s.v_WB.z());
    dBodySetAngularVel(id, s.w_WB.x(), s.w_WB.y(), s.w_WB.z());
    bodies.push_back(id);
  }
  for (auto _ : state) dWorldQuickStep(world, kStep);
  std::vector<BodyState> end(bodies.size());
  for (std::size_t i = 0; i < end.size(); ++i) {
    const dReal *q = dBodyGetQuaternion(bodies[i]), *w = dBodyGetAngularVel(bodies[i]);
    end[i].q_WB = Quat(q[0], q[1], q[2], q[3]);
    end[i].w_WB = Vec3(w[0], w[1], w[2]);
  }
  report(state, scenario, end, 1);
  dWorldDestroy(world);
  dCloseODE();
}
BENCHMARK(OdeQuickStep)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMicrosecond);
#endif

BENCHMARK(FreeBodiesOneStep)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMicrosecond);
BENCHMARK(FreeBodies100Steps)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMicrosecond);
BENCHMARK(ReadableSimulator)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace plumbline

BENCHMARK_MAIN();
