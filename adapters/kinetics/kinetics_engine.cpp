// The in-house core as an engine: two rows that differ in their integrator.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

constexpr const char* kMaxEvents = "max_events_per_step";
constexpr const char* kTolerance = "contact_tolerance";

class KineticsWorld final : public World {
 public:
  KineticsWorld(const Scenario& scenario, const Scheme& scheme, const SimulatorOptions& options)
      : simulator_(scenario, scheme, options) {}
  void apply(std::span<const Wrench> wrenches) override { simulator_.apply(wrenches); }
  void step(double dt) override { simulator_.step(dt); }
  void read(std::span<BodyState> states) const override {
    std::copy(simulator_.states().begin(), simulator_.states().end(), states.begin());
  }

 private:
  Simulator simulator_;
};

SimulatorOptions options_from(const Settings& settings) {
  const double events = setting_number(settings, kMaxEvents);
  const double tolerance = setting_number(settings, kTolerance);
  if (!(events >= 1 && events <= 1e6 && events == std::floor(events))) {
    throw std::invalid_argument(std::string(kMaxEvents) + " must be a whole number from 1 to 1000000");
  }
  if (!(tolerance > kImpactTolerance && tolerance < 1)) {
    throw std::invalid_argument(std::string(kTolerance) + " must lie above " + shortest(kImpactTolerance) +
                                ", to which times of impact are found, and below 1");
  }
  return {static_cast<int>(events), tolerance};
}

class KineticsEngine final : public Engine {
 public:
  KineticsEngine(std::string row, Scheme scheme) : scheme_(scheme) {
    const SimulatorOptions usual;
    const double events = usual.max_events_per_step;
    info_.name = std::move(row);
    info_.library = "Plumbline kinetics";
    info_.version = PLUMBLINE_VERSION;
    info_.scheme = plumbline::name(scheme);
    info_.features = simulator_features();
    info_.settings = {
        {kMaxEvents, events, events, "", "impacts within one step before the run is given up as an error"},
        {kTolerance, usual.contact_tolerance, usual.contact_tolerance, "",
         "bodies closer than this fraction of their size touch"},
    };
  }
  const EngineInfo& info() const override { return info_; }
  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return std::make_unique<KineticsWorld>(scenario, scheme_, options_from(settings));
  }

 private:
  Scheme scheme_;
  EngineInfo info_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(
      std::make_unique<KineticsEngine>("kinetics", Scheme{Integrator::kSemiImplicitEuler, ImpactRule::kExactTime}));
  engines.push_back(
      std::make_unique<KineticsEngine>("kinetics-verlet", Scheme{Integrator::kVelocityVerlet, ImpactRule::kExactTime}));
  return engines;
}

}  // namespace plumbline
