// Verdicts: the one word that a run ends with. Table for people: docs/verdicts.md.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace plumbline {

enum class Verdict {
  kPass,
  kFail,              // a gate failed
  kExpectedFail,      // a gate failed as the engine's deviations list
  kUnexpectedPass,    // listed as failing, yet it passed: the list is out of date
  kUnsupported,       // the engine lacks a feature that the scenario needs
  kDiverged,          // a number stopped being finite
  kCrashed,           // the worker process died
  kTimedOut,          // the worker was stopped at the limit
  kNondeterministic,  // the same run gave other bits
  kError,             // the engine or its adapter reported an error
};
inline constexpr std::size_t kVerdictCount = 10;

struct VerdictRow {
  Verdict verdict;
  std::string_view name;  // "expected_fail"
  char mark;              // one character for tables
  bool breaks_build;      // counts against the exit code
  bool infrastructure;    // no accuracy was measured: exit code 3 rather than 1
  int badness;            // sorts worst first
  std::string_view meaning;
};
std::span<const VerdictRow, kVerdictCount> verdict_table();

const VerdictRow& row_of(Verdict verdict);
std::string_view verdict_name(Verdict verdict);
std::optional<Verdict> verdict_named(std::string_view name);

}  // namespace plumbline
