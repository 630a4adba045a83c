// Building blocks of the page: escaped text, verdict marks, links.
#pragma once

#include <string>
#include <string_view>

#include "plumbline/core/run_result.hpp"

namespace plumbline::reports {

// Text for element content and for attribute values in double quotes. Control characters become spaces (line breaks
// stay), bytes that are no UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

// A relative link to a file below the page's folder; every character that could mean more than itself is encoded.
std::string link_to(std::string_view path);

// Symbol of a verdict for a cell: readable without colour.
std::string_view verdict_symbol(Verdict verdict);
// "v-pass", "v-fail", ...: the class that carries the colour.
std::string verdict_class(Verdict verdict);
// Symbol and name, coloured.
std::string verdict_badge(Verdict verdict);

// "<td class="n">1.20e-3</td>"; a dash with the word for screen readers when there is no such number.
std::string number_cell(const RunResult& run, std::string_view metric);

}  // namespace plumbline::reports
