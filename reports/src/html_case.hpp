// The section of one case on the page.
#pragma once

#include <string>

#include "case_section.hpp"
#include "html_chart.hpp"

namespace plumbline::reports {

// `id` is the section's anchor. Holds a tab per dt with the picture, the runs and the divergence between engines.
std::string case_html(const CaseSection& section, const CurveLooks& looks, const std::string& id);

}  // namespace plumbline::reports
