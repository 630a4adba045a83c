#include "plumbline/core/conformance_result.hpp"

#include <algorithm>

namespace plumbline {

bool KnownFailure::covers(const std::string& row, Profile p, const std::string& name) const {
  if (check != name || (profile && *profile != p)) return false;
  return engines.empty() || std::find(engines.begin(), engines.end(), row) != engines.end();
}

void apply_known_failures(ConformanceResult& result, const std::vector<KnownFailure>& list) {
  if (result.verdict == Verdict::kUnsupported) return;
  const auto entry = std::find_if(list.begin(), list.end(), [&](const KnownFailure& known) {
    return known.covers(result.engine, result.profile, result.check);
  });
  if (entry == list.end()) return;
  result.why = entry->why;
  if (!entry->link.empty()) result.why += " (" + entry->link + ")";
  result.verdict = result.verdict == Verdict::kPass ? Verdict::kUnexpectedPass : Verdict::kExpectedFail;
}

}  // namespace plumbline
