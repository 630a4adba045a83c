// Whole outputs against files that somebody has looked at and approved.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace plumbline::testing {

std::string file_text(const std::filesystem::path& path);

// A new, empty folder of this test, below the build folder.
std::filesystem::path fresh_folder();

// Success when tests/reports/approved/<name> holds exactly `text`. Otherwise writes `text` into the build folder and
// says how to approve it.
::testing::AssertionResult matches_approved(const std::string& text, const std::string& name);

}  // namespace plumbline::testing
