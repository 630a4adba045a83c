#include "plumbline/core/verdict.hpp"

namespace plumbline {
namespace {

constexpr VerdictRow kTable[kVerdictCount] = {
    // verdict, name, mark, breaks build, infrastructure, badness, meaning
    {Verdict::kPass, "pass", '.', false, false, 0, "every gate holds"},
    {Verdict::kFail, "fail", 'F', true, false, 8, "a gate does not hold"},
    {Verdict::kExpectedFail, "expected_fail", 'x', false, false, 3,
     "a gate does not hold, for a cause on the engine's list of deviations"},
    {Verdict::kUnexpectedPass, "unexpected_pass", 'P', true, false, 7,
     "on the list of deviations, yet every gate holds: take it off the list"},
    {Verdict::kUnsupported, "unsupported", '-', false, false, 1, "the engine lacks a feature that the scenario needs"},
    {Verdict::kDiverged, "diverged", 'D', true, false, 9, "a number of the trajectory is not finite"},
    {Verdict::kCrashed, "crashed", 'C', true, true, 10, "the engine's process died"},
    {Verdict::kTimedOut, "timed_out", 'T', true, true, 10, "the engine's process was stopped at the time limit"},
    {Verdict::kNondeterministic, "nondeterministic", 'N', true, false, 8, "the same run gave other bits"},
    {Verdict::kError, "error", 'E', true, true, 10, "the engine or its adapter reported an error"},
};

}  // namespace

std::span<const VerdictRow, kVerdictCount> verdict_table() { return kTable; }

const VerdictRow& row_of(Verdict verdict) { return kTable[static_cast<std::size_t>(verdict)]; }

std::string_view verdict_name(Verdict verdict) { return row_of(verdict).name; }

std::optional<Verdict> verdict_named(std::string_view name) {
  for (const VerdictRow& row : kTable) {
    if (row.name == name) return row.verdict;
  }
  return std::nullopt;
}

}  // namespace plumbline
