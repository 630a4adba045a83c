// Time-stepped elastic gas: time per body and step against Bullet and ODE (spheres), Box2D and Chipmunk (discs).
//
//   bench_elastic_gas                              everything (some minutes); the ratios come last
//   bench_elastic_gas --benchmark_filter=planar
//
// One run is 180 steps of 1/60 s from the same start: spheres of radius 0.5 on a jittered lattice of edge 2, each
// component of the velocity within 2 m/s, e = 1, no friction, no gravity, elastic walls. Times are processor time.
// Beside each stands where it ended: energy over that of the start, and how many bodies are still inside.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "elastic_gas_peer.hpp"

namespace {

using namespace plumbline;
using bench::GasWorld;

constexpr int kSteps = 180;
constexpr double kDt = 1.0 / 60, kSpacing = 2, kRadius = 0.5;
constexpr int kSizes[] = {1000, 8000, 32768, 100000};
constexpr int kLargestForPeers = 32768;

SphereBoxScene gas(int n, bool planar) {
  const double count = n;
  const int edge = static_cast<int>(std::ceil((planar ? std::sqrt(count) : std::cbrt(count)) - 1e-9));
  std::mt19937_64 bits(1);
  const auto random = [&] { return 0x1p-52 * static_cast<double>(bits() >> 11) - 1; };  // in [-1, 1)
  SphereBoxScene scene;
  scene.upper_W = kSpacing * Vec3(edge, edge, planar ? 1 : edge);
  for (int i = 0; i < n; ++i) {
    const double a = random(), b = random(), c = random(), u = random(), v = random(), w = random();
    const Vec3 place(i % edge + 0.5, i / edge % edge + 0.5, i / edge / edge + 0.5);
    const double across = planar ? 0 : 1;
    scene.spheres.push_back({kSpacing * place + 0.45 * Vec3(a, b, across * c), 2 * Vec3(u, v, across * w), kRadius, 1});
  }
  return scene;
}

class OwnGas final : public GasWorld {
 public:
  explicit OwnGas(const SphereBoxScene& scene) : stepper_(scene) {}
  void step(double dt) override { stepper_.step(dt); }
  void read(std::span<SteppedSphere> spheres) const override {
    const std::vector<SteppedSphere> now = stepper_.spheres();
    std::copy(now.begin(), now.end(), spheres.begin());
  }

 private:
  SphereStepper stepper_;
};

struct Contestant {
  std::string name;
  bool planar, own;
  std::function<std::unique_ptr<GasWorld>(const SphereBoxScene&)> make;
};

std::vector<Contestant> contestants() {
  const auto own = [](const SphereBoxScene& scene) { return std::make_unique<OwnGas>(scene); };
  std::vector<Contestant> all = {{"plumbline", false, true, own}, {"plumbline", true, true, own}};
#ifdef PLUMBLINE_BENCH_BULLET
  all.push_back({"bullet-f32", false, false, bench::make_bullet_gas});
#endif
#ifdef PLUMBLINE_BENCH_ODE
  all.push_back({"ode", false, false, bench::make_ode_gas});
#endif
#ifdef PLUMBLINE_BENCH_BOX2D
  all.push_back({"box2d", true, false, bench::make_box2d_gas});
#endif
#ifdef PLUMBLINE_BENCH_CHIPMUNK
  all.push_back({"chipmunk", true, false, bench::make_chipmunk_gas});
#endif
  return all;
}

// Nanoseconds per body and step, of every run.
using Key = std::pair<bool, int>;  // planar, n
std::map<Key, std::map<std::string, std::vector<double>>> times;

double energy(const std::vector<SteppedSphere>& spheres) {
  double twice = 0;
  for (const SteppedSphere& s : spheres) twice += s.mass * s.v_W.squaredNorm();
  return twice / 2;
}

void run(benchmark::State& state, const Contestant& who, int n) {
  const SphereBoxScene scene = gas(n, who.planar);
  std::vector<SteppedSphere> end = scene.spheres;
  for (auto _ : state) {
    const std::unique_ptr<GasWorld> world = who.make(scene);
    const std::clock_t start = std::clock();
    for (int k = 0; k < kSteps; ++k) world->step(kDt);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    state.SetIterationTime(seconds);
    times[{who.planar, n}][who.name].push_back(seconds / kSteps / n * 1e9);
    world->read(end);
  }
  const auto outside = std::count_if(end.begin(), end.end(), [&](const SteppedSphere& s) {
    const Eigen::Index axes = who.planar ? 2 : 3;
    return !((s.p_W - scene.lower_W).head(axes).minCoeff() >= 0 && (scene.upper_W - s.p_W).head(axes).minCoeff() >= 0);
  });
  state.counters["ns_per_body_step"] = times[{who.planar, n}][who.name].back();
  state.counters["energy_ratio"] = energy(end) / energy(scene.spheres);
  state.counters["inside"] = static_cast<double>(n - outside);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void print_ratios() {
  std::printf("\nmedians, ns per body and step\n");
  for (const auto& [key, by_name] : times) {
    double own = 0, fastest = 0;
    std::string peer;
    for (const auto& [name, all] : by_name) {
      const double ns = median(all);
      if (name == "plumbline") {
        own = ns;
      } else if (peer.empty() || ns < fastest) {
        fastest = ns;
        peer = name;
      }
    }
    std::printf("%-8s n = %6d  plumbline %6.1f", key.first ? "planar" : "spheres", key.second, own);
    if (!peer.empty() && own > 0) std::printf("  %-10s %7.1f  ratio %.3f", peer.c_str(), fastest, own / fastest);
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const Contestant& who : contestants()) {
    for (const int n : kSizes) {
      if (!who.own && n > kLargestForPeers) continue;
      const std::string name = std::string(who.planar ? "planar/" : "spheres/") + who.name + "/" + std::to_string(n);
      benchmark::RegisterBenchmark(name.c_str(), [who, n](benchmark::State& state) { run(state, who, n); })
          ->UseManualTime()
          ->Iterations(1)
          ->Repetitions(3)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  print_ratios();
  return 0;
}
