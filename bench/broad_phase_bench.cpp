// What does each broad phase cost against the number of bodies, and which one wins where?
//
// Every figure is one call from scratch: new boxes in, the sorted list of pairs out, on memory that an earlier call has
// grown. "coherent" is the call after each box has moved by about a hundredth of its size. Beside each figure stands
// the number of pairs; a method that finds another number than the first one of its scene ends with an error.
//
// Peer: Bullet's btDbvtBroadphase, if it is installed. From scratch it gets new proxies and finds the pairs, in both of
// its modes; coherent, its proxies move. Its list is a hash table and stays unsorted.
//
//   build/release/bin/bench_broad_phase --benchmark_out=broad_phase.json --benchmark_out_format=json
//   python3 bench/plot_broad_phase.py broad_phase.json docs/figures/broad_phase.svg
#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>

#include "broad_phase_scenes.hpp"
#include "plumbline/core/broad_phase/broad_phase.hpp"

#ifdef PLUMBLINE_HAVE_BULLET
#include "bullet_broad_phase.hpp"
#endif

namespace plumbline {
namespace {

using Key = std::pair<std::string, std::size_t>;

// One scene is kept: the methods of one scene and size run one after the other.
const std::vector<Aabb>& boxes_of(const BroadPhaseScene& scene, std::size_t n) {
  static Key made;
  static std::vector<Aabb> boxes;
  if (const Key key{scene.name, n}; made != key) {
    boxes = scene.make(n);
    made = key;
  }
  return boxes;
}

void report(benchmark::State& state, const Key& key, std::size_t pairs) {
  static std::map<Key, std::size_t> expected;
  const auto [entry, first] = expected.try_emplace(key, pairs);
  if (!first && entry->second != pairs) {
    state.SkipWithError(("finds " + std::to_string(pairs) + " pairs, not " + std::to_string(entry->second)).c_str());
    return;
  }
  const auto n = static_cast<double>(key.second);
  state.counters["pairs"] = static_cast<double>(pairs);
  state.counters["pairs_per_body"] = static_cast<double>(pairs) / n;
  state.counters["s_per_body"] =
      benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void from_scratch(benchmark::State& state, const BroadPhaseScene& scene, const BroadPhaseMethod& method,
                  std::size_t n) {
  const std::vector<Aabb>& boxes = boxes_of(scene, n);
  std::vector<BodyPair> pairs;
  const auto broad_phase = method.make();
  broad_phase->pairs(boxes, pairs);
  // Sweep and prune must not find the order of its last call: a call with other boxes in between makes it forget.
  const std::vector<Aabb> other{{Vec3::Zero(), Vec3::Ones()}};
  std::vector<BodyPair> none;
  for (auto _ : state) {
    broad_phase->pairs(other, none);
    broad_phase->pairs(boxes, pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  report(state, {std::string(scene.name), n}, pairs.size());
}

// The boxes jump to and fro between two sets of places.
std::vector<Aabb> moved(const std::vector<Aabb>& boxes) {
  SceneDice dice;
  std::vector<Aabb> result;
  for (const Aabb& box : boxes) {
    const Vec3 edges = box.max - box.min;
    const Vec3 shift = 0.02 * (dice.in_cube(1).array() - 0.5).matrix().cwiseProduct(edges);
    result.push_back(box_at(box.min + shift, edges.x()));
  }
  return result;
}

void coherent(benchmark::State& state, const BroadPhaseScene& scene, const BroadPhaseMethod& method, std::size_t n) {
  const std::vector<Aabb> places[] = {boxes_of(scene, n), moved(boxes_of(scene, n))};
  std::vector<BodyPair> pairs;
  const auto broad_phase = method.make();
  broad_phase->pairs(places[1], pairs);
  std::size_t turn = 0;
  for (auto _ : state) {
    broad_phase->pairs(places[turn ^= 1], pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  broad_phase->pairs(places[1], pairs);
  report(state, {std::string(scene.name) + " coherent", n}, pairs.size());
}

#ifdef PLUMBLINE_HAVE_BULLET
void bullet_from_scratch(benchmark::State& state, const BroadPhaseScene& scene, bool deferred, std::size_t n) {
  const std::vector<Aabb>& boxes = boxes_of(scene, n);
  std::size_t pairs = 0;
  for (auto _ : state) {
    BulletBroadPhase peer(boxes, deferred);
    pairs = peer.find();
    state.PauseTiming();  // taking it down is not counted
    peer.clear();
    state.ResumeTiming();
  }
  report(state, {std::string(scene.name), n}, pairs);
}

void bullet_coherent(benchmark::State& state, const BroadPhaseScene& scene, std::size_t n) {
  const std::vector<Aabb> places[] = {boxes_of(scene, n), moved(boxes_of(scene, n))};
  BulletBroadPhase peer(places[1], false);
  peer.find();
  std::size_t turn = 0;
  for (auto _ : state) {
    peer.move(places[turn ^= 1]);
    benchmark::DoNotOptimize(peer.find());
  }
  // Its pairs are those of boxes that it enlarges by a margin as they move: another set, so it is shown and not
  // compared.
  state.counters["pairs"] = static_cast<double>(peer.find());
}
#endif

std::string name_of(std::string_view scene, std::string_view method, std::size_t n) {
  return std::string(scene) + "/" + std::string(method) + "/" + std::to_string(n);
}

template <typename Run>
void add(const std::string& name, std::size_t n, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->MinTime(n >= 300000 ? 0.01 : 0.1);
}

void add_all() {
  for (const BroadPhaseScene& scene : kBroadPhaseScenes) {
    for (const std::size_t n : {100u, 300u, 1000u, 3000u, 10000u, 30000u, 100000u, 300000u, 1000000u}) {
      for (const BroadPhaseMethod& method : broad_phases()) {
        if (method.name == "brute force" && n > 30000) continue;       // n^2: 30 minutes at 1e6
        if (method.name == "sweep and prune" && n > 100000) continue;  // n^(5/3): half a minute a call at 1e6
        add(name_of(scene.name, method.name, n), n,
            [=](benchmark::State& state) { from_scratch(state, scene, method, n); });
      }
#ifdef PLUMBLINE_HAVE_BULLET
      if (n <= 100000) {
        add(name_of(scene.name, "Bullet DBVT", n), n,
            [=](benchmark::State& state) { bullet_from_scratch(state, scene, false, n); });
        add(name_of(scene.name, "Bullet DBVT deferred", n), n,
            [=](benchmark::State& state) { bullet_from_scratch(state, scene, true, n); });
      }
#endif
    }
  }
  for (const std::size_t n : {10000u, 100000u}) {
    const BroadPhaseScene& scene = kBroadPhaseScenes[0];
    for (const BroadPhaseMethod& method : broad_phases().subspan(1)) {
      add(name_of("uniform coherent", method.name, n), n,
          [=](benchmark::State& state) { coherent(state, scene, method, n); });
    }
#ifdef PLUMBLINE_HAVE_BULLET
    add(name_of("uniform coherent", "Bullet DBVT", n), n,
        [=](benchmark::State& state) { bullet_coherent(state, scene, n); });
#endif
  }
}

}  // namespace
}  // namespace plumbline

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  plumbline::add_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
