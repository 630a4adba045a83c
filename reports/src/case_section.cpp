#include "case_section.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace plumbline::reports {
namespace {

using RowKey = std::pair<std::string, Profile>;

// By magnitude; NaN is larger than infinity: a number that is none is the worst of all.
bool is_larger(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && !std::isnan(b);
  return std::abs(a) > std::abs(b);
}

// A run without position.max sorts below all others of its verdict.
double error_of(const RunResult& run) {
  for (const auto& [name, value] : run.metrics) {
    if (name == "position.max") return value;
  }
  return 0;
}

// Every engine of the report under every profile, in the report's order.
std::vector<RowKey> row_keys(const Report& report) {
  std::vector<std::string> engines;
  std::set<Profile> profiles;
  const auto add = [&](const std::string& name) {
    if (std::find(engines.begin(), engines.end(), name) == engines.end()) engines.push_back(name);
  };
  for (const EngineInfo& e : report.engines) add(e.name);
  for (const RunResult& r : report.runs) {
    add(r.engine);
    profiles.insert(r.profile);
  }
  std::vector<RowKey> keys;
  for (const std::string& e : engines) {
    for (const Profile p : profiles) keys.emplace_back(e, p);
  }
  return keys;
}

bool row_is_worse(const CaseRow& a, const CaseRow& b) {
  const RunResult* const x = worst_run(a);
  const RunResult* const y = worst_run(b);
  if (x == nullptr || y == nullptr) return x != nullptr && y == nullptr;
  return is_worse(*x, *y);
}

CaseSection section_of(const std::string& case_name, const std::vector<const RunResult*>& runs,
                       const std::vector<RowKey>& keys) {
  CaseSection section;
  section.case_name = case_name;
  std::set<double, std::greater<>> steps;
  for (const RunResult* r : runs) steps.insert(r->dt);
  section.steps.assign(steps.begin(), steps.end());
  for (const RowKey& key : keys) {
    CaseRow row{key.first, key.second, std::vector<const RunResult*>(section.steps.size(), nullptr), nullptr};
    for (const RunResult* r : runs) {
      if (r->engine != row.engine || r->profile != row.profile) continue;
      const auto column = std::find(section.steps.begin(), section.steps.end(), r->dt) - section.steps.begin();
      if (static_cast<std::size_t>(column) < row.runs.size()) row.runs[static_cast<std::size_t>(column)] = r;
    }
    section.rows.push_back(std::move(row));
  }
  std::stable_sort(section.rows.begin(), section.rows.end(), row_is_worse);
  return section;
}

}  // namespace

bool is_worse(const RunResult& a, const RunResult& b) {
  const int x = row_of(a.verdict).badness, y = row_of(b.verdict).badness;
  return x != y ? x > y : is_larger(error_of(a), error_of(b));
}

const RunResult* worst_run(const CaseRow& row) {
  const RunResult* worst = nullptr;
  for (const RunResult* r : row.runs) {
    if (r != nullptr && (worst == nullptr || is_worse(*r, *worst))) worst = r;
  }
  return worst;
}

std::vector<CaseSection> case_sections(const Report& report) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const RunResult*>> runs;
  for (const RunResult& r : report.runs) {
    auto& list = runs[r.case_name];
    if (list.empty()) order.push_back(r.case_name);
    list.push_back(&r);
  }
  const std::vector<RowKey> keys = row_keys(report);
  std::vector<CaseSection> sections;
  for (const std::string& name : order) {
    CaseSection section = section_of(name, runs[name], keys);
    for (const ScenarioSummary& s : report.scenarios) {
      if (s.id == runs[name].front()->scenario) section.scenario = &s;
    }
    for (const Divergence& d : report.divergence) {
      if (d.case_name == name) section.divergence.push_back(&d);
    }
    for (CaseRow& row : section.rows) {
      for (const Convergence& c : report.convergence) {
        const bool same_row = c.engine == row.engine && c.profile == row.profile && c.case_name == name;
        if (same_row && c.metric == "position.max") row.convergence = &c;
      }
    }
    sections.push_back(std::move(section));
  }
  // By the verdict only: the errors of different scenarios have nothing to do with each other.
  const auto badness = [](const CaseSection& s) {
    const RunResult* worst = s.rows.empty() ? nullptr : worst_run(s.rows.front());
    return worst == nullptr ? -1 : row_of(worst->verdict).badness;
  };
  std::stable_sort(sections.begin(), sections.end(),
                   [&](const CaseSection& a, const CaseSection& b) { return badness(a) > badness(b); });
  return sections;
}

WidestPair widest_pair(const CaseSection& section) {
  WidestPair widest;
  for (const Divergence* d : section.divergence) {
    const std::size_t n = d->engines.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n && i * n + j < d->distance.size(); ++j) {
        const double distance = d->distance[i * n + j];
        if (widest.where != nullptr && !is_larger(distance, widest.distance)) continue;
        widest = {d, d->engines[i], d->engines[j], distance};
      }
    }
  }
  return widest;
}

VerdictCounts count_verdicts(const Report& report) {
  VerdictCounts counts{};
  for (const RunResult& r : report.runs) ++counts[static_cast<std::size_t>(r.verdict)];
  return counts;
}

}  // namespace plumbline::reports
