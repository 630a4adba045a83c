// What the conformance kit found: a table for a terminal, and conformance.html, the page beside report.html.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "plumbline/core/run_result.hpp"
#include "plumbline/reports/console.hpp"

namespace plumbline {

struct ConformanceTableOptions {
  bool matrix = true;    // every check on every engine, a mark a profile; otherwise failures and counts alone
  bool verbose = false;  // texts in full, and those of known failures and of what was not asked
};

void print_conformance(const Report& report, const ConsoleStyle& style, std::ostream& out,
                       const ConformanceTableOptions& options = {});

// The page loads nothing and runs no script. Every text is escaped.
std::string conformance_page(const Report& report);

// Writes it beside `path` and renames it. Makes missing folders. Throws std::runtime_error that names the file.
void write_conformance_page(const Report& report, const std::filesystem::path& path);

}  // namespace plumbline
