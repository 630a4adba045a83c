#include "plumbline/reports/comparison_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>

#include "figure.hpp"
#include "terminal.hpp"

namespace plumbline {
namespace {

using namespace reports;
using Kind = RunChange::Kind;

struct KindRow {
  Kind kind;
  const char* name;
  char mark;
  int order;  // worse first
};
constexpr KindRow kKinds[] = {
    {Kind::kWorse, "worse", '!', 0}, {Kind::kRemoved, "removed", '<', 1}, {Kind::kChanged, "changed", '~', 2},
    {Kind::kAdded, "added", '>', 3}, {Kind::kBetter, "better", '+', 4},   {Kind::kSame, "the same", '=', 5},
};
const KindRow& row_of(Kind kind) {
  return *std::find_if(std::begin(kKinds), std::end(kKinds), [kind](const KindRow& r) { return r.kind == kind; });
}

bool has_old(const RunChange& c) { return c.kind != Kind::kAdded; }
bool has_new(const RunChange& c) { return c.kind != Kind::kRemoved; }

// How far the two values are apart as a factor >= 1; infinite when one of them is not a finite number or zero.
double factor(const RunChange& c) {
  if (c.metric.empty() || !has_old(c) || !has_new(c)) return 1;
  const double ratio = std::abs(c.new_value) / std::abs(c.old_value);
  if (std::isnan(ratio)) return c.old_value == 0 && c.new_value == 0 ? 1 : std::numeric_limits<double>::infinity();
  return std::max(ratio, 1 / ratio);
}

std::string ratio_text(const RunChange& c) {
  if (c.metric.empty() || !has_old(c) || !has_new(c)) return "-";
  const double ratio = std::abs(c.new_value) / std::abs(c.old_value);
  return std::isnan(ratio) ? "-" : three_digits(ratio) + " x";
}

std::string value_text(bool there, double value, const std::string& metric) {
  return there && !metric.empty() ? with_unit(value, metric) : "-";
}

std::string verdict_text(const RunChange& c) {
  const std::string before(has_old(c) ? verdict_name(c.old_verdict) : "not there");
  const std::string after(has_new(c) ? verdict_name(c.new_verdict) : "not there");
  return before == after ? before : before + " -> " + after;
}

std::string painted(Kind kind, const Paint& paint, const std::string& text) {
  if (kind == Kind::kWorse) return paint.bad(text);
  if (kind == Kind::kBetter) return paint.good(text);
  return kind == Kind::kSame ? paint.dim(text) : text;
}

}  // namespace

void print_changes(const std::vector<RunChange>& changes, const ConsoleStyle& style, std::ostream& out) {
  std::vector<const RunChange*> shown;
  for (const RunChange& c : changes) {
    if (c.kind != Kind::kSame) shown.push_back(&c);
  }
  std::stable_sort(shown.begin(), shown.end(), [](const RunChange* a, const RunChange* b) {
    const int x = row_of(a->kind).order, y = row_of(b->kind).order;
    return x != y ? x < y : factor(*a) > factor(*b);
  });

  constexpr std::size_t kColumns = 6;
  using Row = std::array<std::string, kColumns>;
  std::vector<Row> rows = {{"run", "metric", "old", "new", "ratio", "verdict"}};
  for (const RunChange* c : shown) {
    const std::string run =
        fmt::format("{} {} {} dt {}", c->case_name, c->engine, profile_name(c->profile), step_label(c->dt));
    rows.push_back({safe_line(run, style.unicode), c->metric.empty() ? "-" : safe_line(c->metric, style.unicode),
                    value_text(has_old(*c), c->old_value, c->metric), value_text(has_new(*c), c->new_value, c->metric),
                    ratio_text(*c), verdict_text(*c)});
  }
  Row::size_type widths[kColumns] = {};
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < kColumns; ++k) widths[k] = std::max(widths[k], columns(row[k]));
  }

  const Paint paint(style);
  for (std::size_t i = 0; i < rows.size() && !shown.empty(); ++i) {
    std::string line = i == 0 ? " " : std::string(1, row_of(shown[i - 1]->kind).mark);
    for (std::size_t k = 0; k < kColumns; ++k) {
      const bool is_number = k >= 2 && k <= 4;
      if (k + 1 == kColumns) {
        line += "  " + rows[i][k];  // nothing stands behind the last column
      } else {
        line += "  " + (is_number ? pad_left(rows[i][k], widths[k]) : pad_right(rows[i][k], widths[k]));
      }
    }
    out << (i == 0 ? paint.dim(line) : painted(shown[i - 1]->kind, paint, line)) << '\n';
  }
  if (!shown.empty()) out << '\n';

  std::string summary;
  for (const KindRow& kind : kKinds) {
    const auto count =
        std::count_if(changes.begin(), changes.end(), [&](const RunChange& c) { return c.kind == kind.kind; });
    if (count == 0) continue;
    summary += (summary.empty() ? "" : ", ") + painted(kind.kind, paint, fmt::format("{} {}", count, kind.name));
  }
  if (changes.empty()) {
    out << "Nothing to compare: neither file holds a run.\n";
  } else {
    out << counted(changes.size(), "run") << ": " << summary << '\n';
  }
  out.flush();
}

}  // namespace plumbline
