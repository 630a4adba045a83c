// Engines that misbehave in known ways, to prove that each misbehaviour gets its verdict.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>

#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

// Free flight under gravity and forces by semi-implicit Euler: the honest part that all fakes share.
class FakeWorld : public World {
 public:
  FakeWorld(const Scenario& scenario, std::string kind) : scenario_(scenario), kind_(std::move(kind)) {
    for (const Body& body : scenario.bodies) states_.push_back(body.initial);
    wrenches_.resize(states_.size());
  }

  void apply(std::span<const Wrench> wrenches) override { wrenches_.assign(wrenches.begin(), wrenches.end()); }

  void step(double dt) override {
    if (++steps_ == 3) misbehave();
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Body& body = scenario_.bodies[i];
      if (body.fixed) continue;
      states_[i].v_WB += dt * (scenario_.gravity + wrenches_[i].f_W / body.mass);
      if (kind_ == "gains-energy") states_[i].v_WB *= 1.0 + 0.01 * dt;
      states_[i].p_WB += dt * states_[i].v_WB;
    }
  }

  void read(std::span<BodyState> states) const override {
    std::copy(states_.begin(), states_.end(), states.begin());
    if (kind_ == "lies") {
      for (BodyState& s : states) s.p_WB *= 1.01;
    }
  }

 private:
  void misbehave() {
    if (kind_ == "aborts") std::abort();
    if (kind_ == "segfaults") std::raise(SIGSEGV);
    if (kind_ == "exits") std::_Exit(5);
    if (kind_ == "throws") throw std::runtime_error("the solver lost its matrix");
    if (kind_ == "hangs") {
      while (true) pause();
    }
    if (kind_ == "nan") states_.back().v_WB.x() = std::numeric_limits<double>::quiet_NaN();
    if (kind_ == "random") {
      // Other bits in every run, far below any accuracy gate.
      states_.back().v_WB.x() *= 1.0 + 1e-15 * static_cast<double>(std::random_device{}() % 1000 + 1);
    }
    if (kind_ == "chatty") {
      std::puts("banner on standard output");
      std::fprintf(stderr, "warning on standard error\n");
    }
  }

  Scenario scenario_;
  std::string kind_;
  std::vector<BodyState> states_;
  std::vector<Wrench> wrenches_;
  int steps_ = 0;
};

class FakeEngine : public Engine {
 public:
  explicit FakeEngine(const std::string& kind) : kind_(kind) {
    info_.name = "fake-" + kind;
    info_.library = "fake";
    info_.version = "1";
    info_.scheme = "semi-implicit Euler";
    info_.features = FeatureSet{Feature::kSpatial, Feature::kForce, Feature::kTorque};
    info_.settings = {{"damping", 0.1, 0.0, "1/s", "not used by fakes: a setting to carry through"}};
  }
  const EngineInfo& info() const override { return info_; }
  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    setting_number(settings, "damping");
    return std::make_unique<FakeWorld>(scenario, kind_);
  }

 private:
  std::string kind_;
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  for (const char* kind : {"honest", "aborts", "segfaults", "exits", "throws", "hangs", "nan", "lies", "gains-energy",
                           "random", "chatty"}) {
    engines.push_back(std::make_unique<FakeEngine>(kind));
  }
  return engines;
}

}  // namespace plumbline
