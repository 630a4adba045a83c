// What is said about the engines themselves: versions, settings, who is missing.
#pragma once

#include <string>

#include "plumbline/core/run_result.hpp"

namespace plumbline::reports {

std::string engines_html(const Report& report);

}  // namespace plumbline::reports
