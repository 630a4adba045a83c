// The conformance kit carried out: every check on every row, each as one request to the row's worker.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "plumbline/harness/campaign.hpp"
#include "plumbline/harness/worker_pool.hpp"

namespace plumbline {

struct ConformanceOptions {
  std::vector<Profile> profiles = {Profile::kDefault, Profile::kMatched};
  std::function<bool(const std::string& check)> selected;  // none: every check
  unsigned jobs = 1;
  WorkerPool::Seconds limit{30};  // wall clock of one check [s]
};

// How many checks are asked of how many, after each: for a display.
using ConformanceProgress = std::function<void(std::size_t done, std::size_t total, const ConformanceResult&)>;

// Fills report.conformance_checks and report.conformance, by engine, profile and check. A worker that knows a check
// not is not asked it. When `stop` is set what was not reached is left out and report.interrupted is set.
void run_conformance(const std::vector<EngineRow>& engines, WorkerPool& pool, const ConformanceOptions& options,
                     const ConformanceProgress& progress, const std::atomic<bool>& stop, Report& report);

}  // namespace plumbline
