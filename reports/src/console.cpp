#include "plumbline/reports/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "case_section.hpp"
#include "console_section.hpp"
#include "figure.hpp"
#include "terminal.hpp"

namespace plumbline {
namespace {

using namespace reports;

constexpr std::size_t kFailingRowsShown = 20;

void heading(const char* text, const ConsoleStyle& style, std::ostream& out) { out << Paint(style).bold(text) << '\n'; }

// The failing runs of one engine, profile and case that failed alike: one entry with all of their dt.
struct FailingRow {
  const RunResult* worst;
  std::vector<double> steps;
};

std::string why(const RunResult& run) {
  if (!run.reason.empty()) return run.reason;
  const GateResult* const gate = failed_gate(run);
  return gate != nullptr ? gate_text(*gate) + "; the limit's reason: " + gate->reason
                         : std::string(row_of(run.verdict).meaning);
}

std::vector<FailingRow> failing_rows(const std::vector<CaseSection>& sections) {
  std::vector<FailingRow> failing;
  for (const CaseSection& section : sections) {
    for (const CaseRow& row : section.rows) {
      std::map<Verdict, FailingRow> by_verdict;
      for (const RunResult* run : row.runs) {
        if (run == nullptr || !row_of(run->verdict).breaks_build) continue;
        FailingRow& entry = by_verdict.try_emplace(run->verdict, FailingRow{run, {}}).first->second;
        if (is_worse(*run, *entry.worst)) entry.worst = run;
        entry.steps.push_back(run->dt);
      }
      for (auto& [verdict, entry] : by_verdict) failing.push_back(std::move(entry));
    }
  }
  std::stable_sort(failing.begin(), failing.end(), [](const FailingRow& a, const FailingRow& b) {
    return row_of(a.worst->verdict).badness > row_of(b.worst->verdict).badness;
  });
  return failing;
}

void print_failing(const std::vector<CaseSection>& sections, const ConsoleStyle& style, bool verbose,
                   std::ostream& out) {
  const std::vector<FailingRow> failing = failing_rows(sections);
  if (failing.empty()) return;
  heading("What fails", style, out);
  const std::size_t shown = verbose ? failing.size() : std::min(failing.size(), kFailingRowsShown);
  const Paint paint(style);
  std::size_t name_width = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    name_width = std::max(name_width, verdict_name(failing[i].worst->verdict).size());
  }
  for (std::size_t i = 0; i < shown; ++i) {
    const RunResult& run = *failing[i].worst;
    std::string steps;
    for (const double dt : failing[i].steps) steps += (steps.empty() ? "" : ", ") + step_label(dt);
    const std::string where =
        fmt::format("{} {} {} dt {}", run.case_name, run.engine, profile_name(run.profile), steps);
    std::string text = safe_line(fmt::format("{}: {}", where, why(run)), style.unicode);
    const auto width = static_cast<std::size_t>(style.width);
    if (!verbose) text = shorten(text, 2 * width - 40);  // two lines at most
    const std::string name = pad_right(std::string(verdict_name(run.verdict)), name_width);
    const std::string block = wrapped("  " + name + "  ", text, width);
    // The verdict's name is the same wherever it stands, so it can be painted after the text was wrapped.
    out << "  " << paint.verdict(run.verdict, name) << block.substr(2 + name.size());
  }
  if (shown < failing.size()) out << "  and " << failing.size() - shown << " more, see results.json or the page\n";
  out << '\n';
}

void print_divergence(const std::vector<CaseSection>& sections, const ConsoleStyle& style, std::ostream& out) {
  std::size_t name_width = 0;
  bool any = false;
  for (const CaseSection& s : sections) {
    name_width = std::max(name_width, columns(safe_line(s.case_name, style.unicode)));
    any = any || !s.divergence.empty();
  }
  if (!any) return;
  heading("Who disagrees most", style, out);
  for (const CaseSection& section : sections) {
    const WidestPair pair = widest_pair(section);
    out << "  " << pad_right(safe_line(section.case_name, style.unicode), name_width) << "  ";
    if (pair.where == nullptr) {
      out << "fewer than two engines ran it\n";
      continue;
    }
    const std::string apart = std::isfinite(pair.distance)
                                  ? three_digits(pair.distance) + " m apart"
                                  : three_digits(pair.distance) + ", one of them left the finite numbers";
    out << safe_line(fmt::format("{} and {}: {} ({}, dt {} s)", pair.a, pair.b, apart,
                                 profile_name(pair.where->profile), step_label(pair.where->dt)),
                     style.unicode)
        << '\n';
  }
  out << '\n';
}

void print_legend(const Report& report, const ConsoleStyle& style, std::ostream& out) {
  std::string text =
      "a cell: mark, position.max [m] or the value of the first gate that does not hold, footnote; order: of "
      "position.max"
      " in dt; marks:";
  const VerdictCounts counts = count_verdicts(report);
  const char* separator = " ";
  for (const VerdictRow& row : verdict_table()) {
    if (counts[static_cast<std::size_t>(row.verdict)] == 0) continue;
    text += fmt::format("{}{} {}", separator, row.mark, row.name);
    separator = ", ";
  }
  out << Paint(style).dim(wrapped("", text, static_cast<std::size_t>(style.width))) << '\n';
}

void print_summary(const Report& report, const ConsoleStyle& style, const ConsoleOptions& options, std::ostream& out) {
  const Paint paint(style);
  for (const MissingEngine& m : report.missing_engines) {
    out << safe_line(fmt::format("missing engine {}: {}", m.name, m.reason), style.unicode) << '\n';
  }
  if (report.interrupted) out << paint.bad("interrupted: what had not been run by then is missing above") << '\n';

  const VerdictCounts counts = count_verdicts(report);
  std::size_t failing = 0;
  std::string text;
  std::vector<VerdictRow> rows(verdict_table().begin(), verdict_table().end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const VerdictRow& a, const VerdictRow& b) { return a.badness > b.badness; });
  for (const VerdictRow& row : rows) {
    const std::size_t count = counts[static_cast<std::size_t>(row.verdict)];
    if (count == 0) continue;
    if (row.breaks_build) failing += count;
    text += (text.empty() ? "" : ", ") + paint.verdict(row.verdict, fmt::format("{} {}", count, row.name));
  }
  const std::string runs = counted(report.runs.size(), "run");
  if (report.runs.empty()) {
    out << "Nothing was run: no scenario and engine matched. `plumbline list` shows what there is.\n";
  } else {
    out << (failing == 0 ? paint.good(runs) : paint.bad(runs)) << ": " << text << "; in "
        << duration(report.wall_seconds) << '\n';
  }
  if (!options.files.empty()) out << "files: " << safe_line(options.files, style.unicode) << '\n';
}

}  // namespace

void print_report(const Report& report, const ConsoleStyle& style, std::ostream& out, const ConsoleOptions& options) {
  ConsoleStyle usable = style;
  usable.width = std::max(style.width, 60);  // narrower, the terminal wraps more readably than we could
  const std::vector<CaseSection> sections = case_sections(report);
  if (!sections.empty()) print_legend(report, usable, out);
  for (const CaseSection& section : sections) print_section(section, usable, options.verbose, out);
  print_divergence(sections, usable, out);
  print_failing(sections, usable, options.verbose, out);
  print_summary(report, usable, options, out);
  out.flush();
}

}  // namespace plumbline
