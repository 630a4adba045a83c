// One case of the console report.
#pragma once

#include <iosfwd>

#include "case_section.hpp"
#include "plumbline/reports/console.hpp"

namespace plumbline::reports {

void print_section(const CaseSection& section, const ConsoleStyle& style, bool verbose, std::ostream& out);

}  // namespace plumbline::reports
