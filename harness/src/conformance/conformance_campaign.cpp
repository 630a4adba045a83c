#include "plumbline/harness/conformance_campaign.hpp"

#include <algorithm>
#include <set>

#include "plumbline/harness/conformance.hpp"

namespace plumbline {
namespace {

// The checks that each program knows; none for a worker that was built without the kit.
std::vector<std::set<std::string>> known_checks(WorkerPool& pool, const ConformanceOptions& options,
                                                const std::atomic<bool>& stop) {
  std::vector<std::set<std::string>> known(pool.programs().size());
  std::vector<CallRequest> requests;
  for (std::size_t p = 0; p < known.size(); ++p) {
    if (pool.programs()[p].problem.empty()) requests.push_back({p, "conformance.list", nlohmann::json::object()});
  }
  pool.call(
      requests, options.jobs, options.limit,
      [&](std::size_t i, CallOutcome outcome) {
        if (outcome.end != CallOutcome::End::kAnswered) return;
        for (const auto& name : outcome.result.value("checks", nlohmann::json::array())) {
          if (name.is_string()) known[requests[i].program].insert(name.get<std::string>());
        }
      },
      stop);
  return known;
}

std::string text_at(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

void read_outcome(CallOutcome outcome, ConformanceResult& result) {
  using End = CallOutcome::End;
  if (outcome.end != End::kAnswered) {
    result.verdict = outcome.end == End::kCrashed    ? Verdict::kCrashed
                     : outcome.end == End::kTimedOut ? Verdict::kTimedOut
                                                     : Verdict::kError;
    result.text = std::move(outcome.reason);
  } else {
    const std::string word = text_at(outcome.result, "outcome");
    result.verdict = word == "holds"       ? Verdict::kPass
                     : word == "broken"    ? Verdict::kFail
                     : word == "not_asked" ? Verdict::kUnsupported
                                           : Verdict::kError;
    result.text = result.verdict == Verdict::kError ? "the worker answered with the unknown outcome '" + word + "'"
                                                    : text_at(outcome.result, "text");
  }
  if (result.verdict != Verdict::kPass) result.messages = std::move(outcome.messages);
}

}  // namespace

void run_conformance(const std::vector<EngineRow>& engines, WorkerPool& pool, const ConformanceOptions& options,
                     const ConformanceProgress& progress, const std::atomic<bool>& stop, Report& report) {
  const auto known = known_checks(pool, options, stop);
  std::vector<CallRequest> requests;
  std::vector<ConformanceResult> results;
  std::vector<std::size_t> row_of;  // whose list of known failures a result is held against
  for (const ConformanceCheck& check : conformance_checks()) {
    if (!options.selected || options.selected(check.name)) report.conformance_checks.push_back(check);
  }
  for (std::size_t e = 0; e < engines.size(); ++e) {
    for (Profile profile : options.profiles) {
      for (const ConformanceCheck& check : report.conformance_checks) {
        const std::string& name = engines[e].info.name;
        if (!known[engines[e].program].contains(check.name)) continue;
        if (check.matched_only && profile != Profile::kMatched) continue;
        requests.push_back({engines[e].program,
                            "conformance.run",
                            {{"engine", name}, {"profile", profile_name(profile)}, {"check", check.name}}});
        results.push_back({name, profile, check.name, Verdict::kError, "", "", ""});
        row_of.push_back(e);
      }
    }
  }
  std::vector<bool> answered(requests.size());
  std::size_t done = 0;
  pool.call(
      requests, options.jobs, options.limit,
      [&](std::size_t i, CallOutcome outcome) {
        read_outcome(std::move(outcome), results[i]);
        apply_known_failures(results[i], engines[row_of[i]].known_failures);
        answered[i] = true;
        if (progress) progress(++done, requests.size(), results[i]);
      },
      stop);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (answered[i]) report.conformance.push_back(std::move(results[i]));
  }
  report.interrupted = report.interrupted || stop;
}

}  // namespace plumbline
