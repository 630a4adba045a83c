// Conformance: whether an adapter hands the stated problem to its engine, and the engine's answer back, without bending
// either. What is asked, what came of it, and what is known to fail.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/gate.hpp"
#include "plumbline/core/verdict.hpp"

namespace plumbline {

struct ConformanceCheck {
  std::string name;       // "gravity_pulls_where_it_is_stated"
  std::string theme;      // "forces": checks of one theme stand together
  std::string question;   // one line
  std::string tolerance;  // how far off an answer may be, and why; "" where it must be exact
  // Asked of the profile `matched` only: what the scenario states, which an engine's own defaults need not do.
  bool matched_only = false;
};

// One check on one row under one profile.
struct ConformanceResult {
  std::string engine;
  Profile profile = Profile::kDefault;
  std::string check;
  // pass: it holds; fail: it does not; unsupported: not asked, for want of a feature; expected_fail, unexpected_pass:
  // by the adapter's list; crashed, timed_out, error: there was no answer.
  Verdict verdict = Verdict::kError;
  std::string text;      // the numbers that were seen and wanted, the missing feature, or how the worker ended
  std::string why;       // the cause on the adapter's list; empty when it is not listed
  std::string messages;  // what the engine printed, unless it passed
};

// A check that an engine is known to fail.
struct KnownFailure {
  std::vector<std::string> engines;  // rows; empty: every row of the adapter
  std::string check;
  std::optional<Profile> profile;
  std::string why;   // the cause
  std::string link;  // issue, manual page or minimal reproduction; may be empty
  SourcePlace place;

  bool covers(const std::string& engine, Profile profile, const std::string& check) const;
};

// The result in the light of the list: a failure of any kind that is listed is expected, a listed one that passes is
// an unexpected pass. What was not asked stays so.
void apply_known_failures(ConformanceResult& result, const std::vector<KnownFailure>& list);

}  // namespace plumbline
