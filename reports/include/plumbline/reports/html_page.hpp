// report.html: the whole comparison on one page that opens from disk. It holds its style and its pictures, loads
// nothing and runs no script.
#pragma once

#include <filesystem>
#include <string>

#include "plumbline/core/run_result.hpp"

namespace plumbline {

// The page. Every text of the report is escaped; links to trajectories are relative to the page's folder.
std::string html_page(const Report& report);

// Writes it beside `path` and renames it. Makes missing folders. Throws std::runtime_error that names the file.
void write_html(const Report& report, const std::filesystem::path& path);

}  // namespace plumbline
