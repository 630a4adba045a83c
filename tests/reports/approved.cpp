#include "approved.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace plumbline::testing {

std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

std::filesystem::path fresh_folder() {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      std::filesystem::path(PLUMBLINE_RECEIVED_DIR) / test.test_suite_name() / test.name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

::testing::AssertionResult matches_approved(const std::string& text, const std::string& name) {
  const std::filesystem::path approved = std::filesystem::path(PLUMBLINE_APPROVED_DIR) / name;
  const std::string expected = file_text(approved);
  if (text == expected && std::filesystem::exists(approved)) return ::testing::AssertionSuccess();

  const std::filesystem::path received = std::filesystem::path(PLUMBLINE_RECEIVED_DIR) / name;
  std::filesystem::create_directories(received.parent_path());
  std::ofstream(received, std::ios::binary) << text;
  const auto [a, b] = std::mismatch(text.begin(), text.end(), expected.begin(), expected.end());
  const auto line = 1 + std::count(text.begin(), a, '\n');
  return ::testing::AssertionFailure() << name << " differs from line " << line << " on.\n  see:     diff "
                                       << approved.string() << " " << received.string() << "\n  approve: cp "
                                       << received.string() << " " << approved.string();
}

}  // namespace plumbline::testing
