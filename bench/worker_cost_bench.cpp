// What does a run cost through the worker program, against the same run in this process?
//
//   InProcess/h      one run of the falling box, 2 s in steps of 1/h s: building the world, stepping, recording
//   ThroughWorker/h  the same request to a worker that is running already: scenario text out, trajectory back
//   StartWorker      starting the program and asking it for its engines
//
// The counter `same` is 1 when both trajectories have the same bits.
#include <benchmark/benchmark.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>

#include "plumbline/harness/recording.hpp"
#include "plumbline/harness/worker_pool.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {
namespace {

const std::string kFile = PLUMBLINE_SOURCE_DIR "/scenarios/particle/falling_box.toml";

struct Subject {
  Subject() {
    std::ifstream stream(kFile, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(stream), {});
    scenario = read_scenario(text, kFile).front().scenario;
  }
  std::vector<std::unique_ptr<Engine>> engines = make_engines();
  std::string text;
  Scenario scenario;
};

Subject& subject() {
  static Subject kSubject;
  return kSubject;
}

Recording in_process(double dt) {
  const Engine& engine = *subject().engines.front();
  return record(engine, subject().scenario, settings_of(engine.info(), Profile::kDefault), dt);
}

Recording through(WorkerPool& pool, double dt) {
  const RunRequest request{
      0, subject().engines.front()->info().name, Profile::kDefault, dt, &subject().scenario, &subject().text, kFile,
      {}};
  RunOutcome outcome;
  pool.run(
      {request}, 1, WorkerPool::Seconds(60), [&](std::size_t, RunOutcome o) { outcome = std::move(o); }, false);
  return std::move(outcome.recording);
}

void InProcess(benchmark::State& state) {
  const double dt = 1.0 / static_cast<double>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(in_process(dt).trajectory.samples());
}

void ThroughWorker(benchmark::State& state) {
  const double dt = 1.0 / static_cast<double>(state.range(0));
  WorkerPool pool({PLUMBLINE_WORKER});
  const Trajectory ours = in_process(dt).trajectory;
  Trajectory theirs;
  for (auto _ : state) theirs = through(pool, dt).trajectory;
  state.counters["same"] = ours.states().size() == theirs.states().size() &&
                           std::memcmp(ours.states().data(), theirs.states().data(), ours.states().size_bytes()) == 0;
}

void StartWorker(benchmark::State& state) {
  for (auto _ : state) {
    const WorkerPool pool({PLUMBLINE_WORKER});
    benchmark::DoNotOptimize(pool.programs().front().engines.size());
  }
}

// Wall-clock time: the worker's is not this process's.
BENCHMARK(InProcess)->Arg(50)->Arg(1000)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(ThroughWorker)->Arg(50)->Arg(1000)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(StartWorker)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumbline

BENCHMARK_MAIN();
