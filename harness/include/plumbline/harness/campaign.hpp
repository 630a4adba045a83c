// A whole comparison: the plan carried out, each run assessed, engines compared with each other.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "plumbline/core/deviation.hpp"
#include "plumbline/core/run_result.hpp"
#include "plumbline/harness/plan.hpp"
#include "plumbline/harness/worker_pool.hpp"

namespace plumbline {

struct CampaignOptions {
  unsigned jobs = 1;
  WorkerPool::Seconds limit{30};      // wall clock of one run [s]
  unsigned repeat = 1;                // every run must give the same bits that many times
  bool deviations_must_apply = true;  // false for parameters or steps that the lists were not made for
};

// What the campaign tells while it runs.
struct CampaignObserver {
  // A run has its result (numbering is that of the plan). The trajectory is empty when there is none.
  std::function<void(RunResult&, const Trajectory&)> finished;
};

// An engine row and the worker program that offers it.
struct EngineRow {
  EngineInfo info;
  std::size_t program = 0;
  std::vector<Deviation> deviations;
  std::vector<KnownFailure> known_failures = {};
  std::string worker_name = info.name;  // what the worker calls it: info.name unless settings were changed
  Settings changed = {};                // these, over those of the profile
};

// Fills report.runs (in plan order), report.convergence and report.divergence. When `stop` is set the runs that
// were not reached are left out and report.interrupted is set.
void run_campaign(const std::vector<CaseInput>& cases, const std::vector<EngineRow>& engines,
                  const std::vector<PlannedRun>& plan, WorkerPool& pool, const CampaignOptions& options,
                  const CampaignObserver& observer, const std::atomic<bool>& stop, Report& report);

}  // namespace plumbline
