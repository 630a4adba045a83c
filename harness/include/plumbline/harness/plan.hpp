// The plan of runs: every engine x profile x case x dt, in the order in which they are run.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

// One case as the harness sees it: the problem, the truth, and the text that a worker process reads it from.
struct CaseInput {
  Scenario scenario;
  std::shared_ptr<const Reference> reference;
  std::shared_ptr<const std::string> text;  // the scenario file, whole
  std::string file;
};

struct PlannedRun {
  std::size_t case_index = 0;
  std::size_t engine_index = 0;
  Profile profile = Profile::kDefault;
  double dt = 0;  // [s]
};

// "particle/drag_ship/v0=30/bullet-f32.matched.dt=0.02": what filters match and trajectory files are called.
std::string run_name(const Scenario& scenario, const std::string& engine, Profile profile, double dt);

// Runs of one case and dt stand together: they share the reference and are compared with each other. Cases beyond
// `tier` are left out; of the others smoke takes the first step only.
std::vector<PlannedRun> plan_runs(const std::vector<CaseInput>& cases, const std::vector<EngineInfo>& engines,
                                  const std::vector<Profile>& profiles, Tier tier,
                                  const std::function<bool(const std::string& name)>& selected);

}  // namespace plumbline
