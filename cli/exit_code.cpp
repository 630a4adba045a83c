#include "plumbline/core/run_result.hpp"
#include "usage_error.hpp"

namespace plumbline {

int exit_code(const Report& report) {
  if (report.interrupted) return kExitInterrupted;
  bool infrastructure = false, failed = false, all_skipped = true;
  const auto count = [&](Verdict verdict) {
    const VerdictRow& row = row_of(verdict);
    infrastructure |= row.infrastructure;
    failed |= row.breaks_build;
  };
  for (const RunResult& run : report.runs) {
    count(run.verdict);
    all_skipped &= run.verdict == Verdict::kUnsupported;
  }
  for (const ConformanceResult& result : report.conformance) count(result.verdict);
  if (infrastructure) return kExitEngineError;
  if (failed) return kExitGateFailed;
  return all_skipped && !report.runs.empty() ? kExitAllSkipped : kExitPass;
}

}  // namespace plumbline
