#include "environment.hpp"

#include <fmt/chrono.h>
#include <sys/utsname.h>

#include <chrono>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

namespace plumbline {
namespace {

// The value of the first line of a file that begins with `key`, up to the end of the line; "unknown" without one.
std::string line_value(const char* file, std::string_view key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(line.find(separator) + 1);
    value.erase(0, value.find_first_not_of(" \t\""));
    value.erase(value.find_last_not_of(" \t\"") + 1);
    return value;
  }
  return "unknown";
}

// The command line as one could type it again, whatever the path of the program was.
std::string command_line() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string command = "./plumbline", argument;
  std::getline(in, argument, '\0');  // the program itself
  while (std::getline(in, argument, '\0')) {
    const bool plain = argument.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}~#!`") == std::string::npos && !argument.empty();
    command += plain ? ' ' + argument : " '" + argument + "'";
  }
  return command;
}

}  // namespace

Environment describe_environment() {
  utsname kernel{};
  uname(&kernel);
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {{"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
          {"system", line_value("/etc/os-release", "PRETTY_NAME", '=') + ", " + kernel.sysname + ' ' + kernel.machine},
          {"processor", line_value("/proc/cpuinfo", "model name", ':')},
          {"cores", std::to_string(std::thread::hardware_concurrency())},
          {"compiler", PLUMBLINE_COMPILER},
          {"build", PLUMBLINE_BUILD},
          {"command", command_line()}};
}

}  // namespace plumbline
