#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <set>

#include "conformance_table.hpp"
#include "figure.hpp"
#include "plumbline/reports/conformance_report.hpp"
#include "terminal.hpp"

namespace plumbline {
namespace {

using namespace reports;

// "12 fail", with the colour of the verdict.
std::string counts_text(const ConformanceTable& table, const Paint& paint) {
  std::string text;
  for (const VerdictRow& row : counted_verdicts(table.counts)) {
    const std::size_t count = table.counts[static_cast<std::size_t>(row.verdict)];
    text += (text.empty() ? "" : ", ") + paint.verdict(row.verdict, fmt::format("{} {}", count, row.name));
  }
  return text;
}

void print_matrix(const ConformanceTable& table, const ConsoleStyle& style, std::ostream& out) {
  const Paint paint(style);
  std::string key;
  for (std::size_t e = 0; e < table.engines.size(); ++e) {
    key += fmt::format("{}{} {}", e == 0 ? "" : "   ", e + 1, safe_line(table.engines[e], style.unicode));
  }
  out << wrapped("", key, static_cast<std::size_t>(style.width));
  std::string legend = table.profiles.size() == 2
                           ? "two marks a cell, default and matched; a blank: asked of the matched profile only;"
                           : "marks of the profile " + std::string(profile_name(table.profiles.front())) + ":";
  for (const VerdictRow& row : counted_verdicts(table.counts)) legend += fmt::format(" {} {}", row.mark, row.name);
  out << paint.dim(wrapped("", legend, static_cast<std::size_t>(style.width)));

  std::size_t width = 0;
  for (const ConformanceCheck& check : table.checks) width = std::max(width, check.name.size());
  std::string theme;
  for (const ConformanceCheck& check : table.checks) {
    if (check.theme != theme) {
      out << '\n' << paint.bold(pad_right(check.theme, width + 2));
      for (std::size_t e = 0; e < table.engines.size(); ++e) out << paint.dim(fmt::format("{:>3} ", e + 1));
      out << '\n';
      theme = check.theme;
    }
    out << "  " << pad_right(check.name, width);
    for (const std::string& engine : table.engines) {
      out << "  ";
      for (const Profile profile : table.profiles) {
        const ConformanceResult* const result = table.find(engine, profile, check.name);
        const std::string mark(1, result == nullptr ? ' ' : row_of(result->verdict).mark);
        out << (result == nullptr ? mark : paint.verdict(result->verdict, mark));
      }
    }
    out << '\n';
  }
  out << '\n';
}

void print_result(const ConformanceResult& result, const ConsoleStyle& style, bool verbose, std::ostream& out) {
  std::string text = fmt::format("{}.{} {}: {}", result.engine, profile_name(result.profile), result.check,
                                 result.text.empty() ? conformance_meaning(result.verdict) : result.text);
  if (!result.why.empty()) text += "; known: " + result.why;
  // The last words of a process that died say more than its signal.
  if (!result.messages.empty() && (verbose || result.verdict == Verdict::kCrashed)) {
    const std::string& said = result.messages;
    const std::size_t last_line = said.find_last_of('\n', said.find_last_not_of('\n')) + 1;
    text += "; it printed: " + (verbose ? said : said.substr(last_line));
  }
  text = safe_line(text, style.unicode);
  const auto width = static_cast<std::size_t>(style.width);
  if (!verbose) text = shorten(text, 3 * width - 60);  // three lines at most
  const std::string name = pad_right(std::string(verdict_name(result.verdict)), 15);
  const std::string block = wrapped("  " + name + "  ", text, width);
  out << "  " << Paint(style).verdict(result.verdict, name) << block.substr(2 + name.size());
}

// What each engine lacks, once for all the checks that need it.
void print_not_asked(const Report& report, const ConsoleStyle& style, std::ostream& out) {
  std::map<std::pair<std::string, std::string>, std::set<std::string>> checks;  // by engine and lack
  for (const ConformanceResult& r : report.conformance) {
    if (r.verdict == Verdict::kUnsupported) checks[{r.engine, r.text}].insert(r.check);
  }
  const Paint paint(style);
  for (const auto& [what, names] : checks) {
    const std::string text =
        safe_line(fmt::format("{}: {}; not asked: {}", what.first, what.second, fmt::join(names, ", ")), style.unicode);
    out << paint.dim(wrapped("  unsupported      ", text, static_cast<std::size_t>(style.width)));
  }
}

}  // namespace

void print_conformance(const Report& report, const ConsoleStyle& style, std::ostream& out,
                       const ConformanceTableOptions& options) {
  ConsoleStyle usable = style;
  usable.width = std::max(style.width, 60);  // narrower, the terminal wraps more readably than we could
  const ConformanceTable table(report);
  const Paint paint(usable);
  if (options.matrix && !report.conformance.empty()) print_matrix(table, usable, out);
  bool broken = false;
  for (const ConformanceResult* result : table.failures) {
    broken = broken || row_of(result->verdict).breaks_build;
    if (options.verbose || row_of(result->verdict).breaks_build) print_result(*result, usable, options.verbose, out);
  }
  if (options.verbose) print_not_asked(report, usable, out);
  const std::string checks =
      fmt::format("Conformance: {} of {} on {}", counted(report.conformance.size(), "answer"),
                  counted(table.checks.size(), "check"), counted(table.engines.size(), "engine"));
  out << (broken ? paint.bad(checks) : paint.good(checks)) << ": " << counts_text(table, paint) << "\n\n";
  out.flush();
}

}  // namespace plumbline
