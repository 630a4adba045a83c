// The report as text for a terminal, worst first.
//
// A section per case; in it a row per engine and profile and a column per dt, with the mark of the verdict
// (core/verdict.hpp) and position.max [m], or the value of the first metric whose gate failed. A letter behind a cell
// or a row points at the footnote below the section. Then who disagrees most, what fails, and the counts.
#pragma once

#include <iosfwd>
#include <string>

#include "plumbline/core/run_result.hpp"

namespace plumbline {

struct ConsoleStyle {
  bool color = false;    // ANSI escape sequences
  bool unicode = false;  // letters beyond ASCII as they are; otherwise each is shown as '?'
  int width = 100;       // columns that text is wrapped at
};

// What fits the stream behind a file descriptor (1: stdout): colour on a terminal unless NO_COLOR is set or TERM is
// "dumb", Unicode where the locale is UTF-8, the terminal's width, or 140 where there is no terminal.
ConsoleStyle console_style_for(int file_descriptor);

struct ConsoleOptions {
  // Everything: profiles of equal rows apart, the explanation of every run, every failing run. Otherwise equal rows
  // of two profiles are one row "both" and long lists are cut with the number of what is left out.
  bool verbose = false;
  std::string files;  // where the results were written; empty: not mentioned
};

void print_report(const Report& report, const ConsoleStyle& style, std::ostream& out,
                  const ConsoleOptions& options = {});

}  // namespace plumbline
