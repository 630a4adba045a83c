#include "text_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace plumbline::reports {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& cause) {
  throw std::runtime_error(path.string() + ": cannot be written: " + cause +
                           "; free some space, or choose another folder with -o");
}

std::string cause_of(int code) { return std::generic_category().message(code); }

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view text) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail(path, error.message());
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(path, cause_of(errno));
  // stdio's buffer would copy everything once more.
  std::setvbuf(file, nullptr, _IONBF, 0);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int write_error = errno;
  // Some file systems report a full disk only here.
  const bool closed = std::fclose(file) == 0;
  if (!written) fail(path, cause_of(write_error));
  if (!closed) fail(path, cause_of(errno));
}

void replace_file(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path temporary = path;
  // The process id keeps two programs that write the same file from writing into each other's.
  temporary += "." + std::to_string(::getpid()) + ".tmp";
  std::error_code error;
  try {
    write_file(temporary, text);
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    fail(path, error.message());
  }
}

}  // namespace plumbline::reports
