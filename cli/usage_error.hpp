// What the user asked for cannot be done as written: exit code 2.
#pragma once

#include <stdexcept>

namespace plumbline {

struct Report;

class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum ExitCode {
  kExitPass = 0,
  kExitGateFailed = 1,
  kExitUsage = 2,
  kExitEngineError = 3,
  kExitNothingMatched = 4,
  kExitAllSkipped = 77,
  kExitInterrupted = 130,
};

// What runs and checks amount to. Those that did not measure anything (crashed, timed out, error) win over failures.
int exit_code(const Report& report);

}  // namespace plumbline
