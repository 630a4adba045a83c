#include "plumbline/harness/plan.hpp"

namespace plumbline {

std::string run_name(const Scenario& scenario, const std::string& engine, Profile profile, double dt) {
  return scenario.case_name() + '/' + engine + '.' + std::string(profile_name(profile)) + ".dt=" + shortest(dt);
}

std::vector<PlannedRun> plan_runs(const std::vector<CaseInput>& cases, const std::vector<EngineInfo>& engines,
                                  const std::vector<Profile>& profiles, Tier tier,
                                  const std::function<bool(const std::string&)>& selected) {
  std::vector<PlannedRun> plan;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    if (cases[c].scenario.tier > tier) continue;
    for (double dt : cases[c].scenario.steps) {
      for (Profile profile : profiles) {
        for (std::size_t e = 0; e < engines.size(); ++e) {
          if (selected(run_name(cases[c].scenario, engines[e].name, profile, dt))) plan.push_back({c, e, profile, dt});
        }
      }
      if (tier == Tier::kSmoke) break;
    }
  }
  return plan;
}

}  // namespace plumbline
