#include "console_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "figure.hpp"
#include "footnotes.hpp"
#include "terminal.hpp"

namespace plumbline::reports {
namespace {

struct Cell {
  Verdict verdict = Verdict::kPass;
  std::string text;     // right-aligned: number or word
  std::string letters;  // left-aligned behind it
  bool run = false;
  bool operator==(const Cell&) const = default;
};

struct Line {
  std::string engine, profile, order, tail;
  std::vector<Cell> cells;
};

// What a cell shows: the number that the verdict hangs on, or the verdict's name where nothing was measured.
std::string cell_text(const RunResult& run) {
  const GateResult* const gate = failed_gate(run);
  if (!row_of(run.verdict).infrastructure) {
    if (gate != nullptr) return three_digits(gate->value);
    // A trajectory with a hole in it has no largest error; an unsupported one was never run.
    const bool measured = run.verdict != Verdict::kDiverged && run.verdict != Verdict::kUnsupported;
    if (measured && has_metric(run, "position.max")) return three_digits(run.metric("position.max"));
  }
  return std::string(verdict_name(run.verdict));
}

std::string order_text(const CaseRow& row) {
  if (row.convergence == nullptr || std::isnan(row.convergence->order)) return "-";
  return fmt::format("{:.2f}", row.convergence->order);
}

// The explanation of the largest error of the row.
const RunResult* explained_run(const CaseRow& row) {
  const RunResult* best = nullptr;
  for (const RunResult* r : row.runs) {
    if (r == nullptr || r->explanation.scheme.empty()) continue;
    if (best == nullptr || r->metric("position.max") > best->metric("position.max")) best = r;
  }
  return best;
}

std::string tail_text(const CaseRow& row) {
  const RunResult* const run = explained_run(row);
  return run == nullptr ? "-" : percent(run->explanation.share) + " " + run->explanation.scheme;
}

Line line_of(const CaseRow& row, Footnotes& footnotes, bool unicode) {
  Line line{safe_line(row.engine, unicode),
            std::string(profile_name(row.profile)),
            order_text(row),
            safe_line(tail_text(row), unicode),
            {}};
  for (const RunResult* run : row.runs) {
    if (run == nullptr) {
      line.cells.push_back({Verdict::kPass, "not run", "", false});
      continue;
    }
    Cell cell{run->verdict, cell_text(*run), footnotes.cite(*run), true};
    for (const std::string& note : run->notes) {
      const std::string letter = footnotes.cite(note);
      if (cell.letters.find(letter) == std::string::npos) cell.letters += letter;
    }
    line.cells.push_back(std::move(cell));
  }
  return line;
}

// Two profiles of one engine that say the same are one line.
void merge_profiles(std::vector<Line>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const Line &a = lines[i], &b = lines[j];
      if (a.engine != b.engine || a.cells != b.cells || a.order != b.order || a.tail != b.tail) continue;
      lines[i].profile = "both";
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(j));
      break;
    }
  }
}

class Table {
 public:
  Table(const CaseSection& section, std::vector<Line> lines, const ConsoleStyle& style)
      : lines_(std::move(lines)), paint_(style) {
    for (const double dt : section.steps) columns_.push_back({"dt " + step_label(dt), 0, 0});
    for (const Line& line : lines_) {
      engine_ = std::max(engine_, columns(line.engine));
      profile_ = std::max(profile_, line.profile.size());
      tail_ = std::max(tail_, columns(line.tail));
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        columns_[k].text = std::max(columns_[k].text, line.cells[k].text.size());
        columns_[k].letters = std::max(columns_[k].letters, line.cells[k].letters.size());
      }
    }
    std::size_t width = 2 + engine_ + 2 + profile_ + 2 + 5 + 2 + tail_;
    for (Column& c : columns_) {
      c.text = std::max(c.text, c.title.size() - std::min<std::size_t>(c.title.size(), 3));
      width += 2 + c.width();
    }
    show_tail_ = width <= static_cast<std::size_t>(style.width);
  }

  void print(std::ostream& out) const {
    std::string head = "  " + pad_right("engine", engine_) + "  " + pad_right("profile", profile_);
    for (const Column& c : columns_) head += "  " + pad_right(pad_left(c.title, 2 + c.text), c.width());
    head += "  order";
    if (show_tail_) head += "  explained by";
    out << paint_.dim(head) << '\n';
    for (const Line& line : lines_) print(line, out);
  }

 private:
  struct Column {
    std::string title;
    std::size_t text, letters;
    std::size_t width() const { return 2 + text + (letters == 0 ? 0 : 1 + letters); }
  };

  void print(const Line& line, std::ostream& out) const {
    out << "  " << pad_right(line.engine, engine_) << "  " << pad_right(line.profile, profile_);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Cell& cell = line.cells[k];
      const char mark = cell.run ? row_of(cell.verdict).mark : ' ';
      const std::string body = mark + (" " + pad_left(cell.text, columns_[k].text));
      out << "  " << (cell.run ? paint_.verdict(cell.verdict, body) : paint_.dim(body));
      if (columns_[k].letters > 0) out << ' ' << paint_.dim(pad_right(cell.letters, columns_[k].letters));
    }
    out << "  " << pad_left(line.order, 5);
    if (show_tail_) out << "  " << line.tail;
    out << '\n';
  }

  std::vector<Line> lines_;
  Paint paint_;
  std::vector<Column> columns_;
  std::size_t engine_ = 6, profile_ = 7, tail_ = 12;
  bool show_tail_ = true;
};

std::string run_name(const RunResult& run) {
  return fmt::format("{} {} at dt {} s", run.engine, profile_name(run.profile), step_label(run.dt));
}

// Whole sentences: of every run when verbose, else of the largest error that each scheme explains for the most part.
void print_explanations(const CaseSection& section, const ConsoleStyle& style, bool verbose, std::ostream& out) {
  std::map<std::string, const RunResult*> by_scheme;
  for (const CaseRow& row : section.rows) {
    for (const RunResult* run : row.runs) {
      if (run == nullptr || run->explanation.scheme.empty()) continue;
      if (!verbose && !(run->explanation.share >= 0.5)) continue;
      const std::string key = verbose ? fmt::format("{:06}", by_scheme.size()) : run->explanation.scheme;
      const RunResult*& kept = by_scheme[key];
      if (kept == nullptr || run->metric("position.max") > kept->metric("position.max")) kept = run;
    }
  }
  for (const auto& [key, run] : by_scheme) {
    const std::string text = run_name(*run) + ": " + explanation_text(*run);
    out << wrapped("  * ", safe_line(text, style.unicode), static_cast<std::size_t>(style.width));
  }
}

}  // namespace

void print_section(const CaseSection& section, const ConsoleStyle& style, bool verbose, std::ostream& out) {
  const Paint paint(style);
  const auto width = static_cast<std::size_t>(style.width);
  const std::string name = safe_line(section.case_name, style.unicode);
  out << paint.bold(name);
  if (section.scenario != nullptr && columns(name) + 12 < width) {
    const std::string about = safe_line(section.scenario->about, style.unicode);
    out << "  " << paint.dim(shorten(about, width - columns(name) - 2));
  }
  out << '\n';

  Footnotes footnotes;
  std::vector<Line> lines;
  for (const CaseRow& row : section.rows) lines.push_back(line_of(row, footnotes, style.unicode));
  if (!verbose) merge_profiles(lines);
  Table(section, std::move(lines), style).print(out);
  for (const Footnotes::Note& note : footnotes.notes()) {
    out << wrapped("  " + note.letter + " ", safe_line(note.text, style.unicode), width);
  }
  print_explanations(section, style, verbose, out);
  out << '\n';
}

}  // namespace plumbline::reports
