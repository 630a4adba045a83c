// results.json: everything that a comparison found, for programs. The contract is docs/schemas/results.schema.json.
//
// Numbers are finite JSON numbers or the strings "nan", "inf", "-inf", so that any JSON parser can read the file.
// What was written is read back exactly: write, read, write gives the same bytes. Two things are not kept: bytes that
// are no UTF-8 (replaced by U+FFFD), and whether a setting "nan", "inf" or "-inf" was a word (it is read as a number).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "plumbline/core/run_result.hpp"

namespace plumbline {

inline constexpr std::string_view kResultsSchema = "plumbline-results/1";

// The whole document: one line per engine, scenario and run, so that two files can be compared line by line.
std::string results_json(const Report& report);

// Writes the document beside `path` and renames it, so that a reader never sees half of it. Makes missing folders.
// Throws std::runtime_error that names the file and the cause.
void write_results(const Report& report, const std::filesystem::path& path);

// Throws std::runtime_error that names the file, the place in it and the way out: the file is missing, is not JSON,
// has another schema, or a field is missing or of the wrong type.
Report read_results(const std::filesystem::path& path);

}  // namespace plumbline
