#include "plumbline/core/run_result.hpp"

#include <limits>

namespace plumbline {

double RunResult::metric(std::string_view name) const {
  for (const auto& [key, value] : metrics) {
    if (key == name) return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace plumbline
