#include "conformance_table.hpp"

#include <algorithm>

namespace plumbline::reports {
namespace {

template <typename T>
void add_once(std::vector<T>& list, const T& item) {
  if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

}  // namespace

ConformanceTable::ConformanceTable(const Report& report) : checks(report.conformance_checks) {
  for (const ConformanceResult& r : report.conformance) {
    by_place_[{r.engine, r.profile, r.check}] = &r;
    add_once(engines, r.engine);
    add_once(profiles, r.profile);
    ++counts[static_cast<std::size_t>(r.verdict)];
    if (r.verdict != Verdict::kPass && r.verdict != Verdict::kUnsupported) failures.push_back(&r);
  }
  std::sort(profiles.begin(), profiles.end());
  std::stable_sort(failures.begin(), failures.end(), [](const auto* a, const auto* b) {
    return row_of(a->verdict).badness > row_of(b->verdict).badness;
  });
}

const ConformanceResult* ConformanceTable::find(const std::string& engine, Profile profile,
                                                const std::string& check) const {
  const auto found = by_place_.find({engine, profile, check});
  return found == by_place_.end() ? nullptr : found->second;
}

std::vector<VerdictRow> counted_verdicts(const VerdictCounts& counts) {
  std::vector<VerdictRow> rows;
  for (const VerdictRow& row : verdict_table()) {
    if (counts[static_cast<std::size_t>(row.verdict)] > 0) rows.push_back(row);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const VerdictRow& a, const VerdictRow& b) { return a.badness > b.badness; });
  return rows;
}

std::string_view conformance_meaning(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "the check holds";
    case Verdict::kFail:
      return "the check does not hold";
    case Verdict::kExpectedFail:
      return "the check does not hold, for a cause on the adapter's list";
    case Verdict::kUnexpectedPass:
      return "on the adapter's list, yet the check holds: take it off the list";
    case Verdict::kUnsupported:
      return "not asked: the engine lacks a feature that the check needs";
    default:
      return row_of(verdict).meaning;
  }
}

}  // namespace plumbline::reports
