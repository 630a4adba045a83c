#include "plumbline/harness/convergence.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>

namespace plumbline {

double rounding_floor(double unit_roundoff, double steps, double magnitude) {
  return 4 * unit_roundoff * std::sqrt(steps) * magnitude;
}

Order observed_order(std::span<const ErrorAtStep> errors) {
  std::set<double> steps;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  std::size_t at_floor = 0, not_finite = 0;
  for (const ErrorAtStep& e : errors) {
    if (!std::isfinite(e.error)) {
      ++not_finite;
    } else if (e.error <= e.floor) {
      ++at_floor;
    } else {
      const double x = std::log(e.dt), y = std::log(e.error);
      steps.insert(e.dt);
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  Order result{std::numeric_limits<double>::quiet_NaN(), steps.size(), ""};
  if (at_floor == errors.size() && !errors.empty()) {
    result.note = "exact to rounding";
  } else if (steps.size() < 3) {
    result.note = fmt::format("{} usable dt, three are needed", steps.size());
  } else {
    result.order = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }
  if (at_floor > 0 && at_floor < errors.size()) {
    result.note += fmt::format("{}{} dt at the rounding floor left out", result.note.empty() ? "" : "; ", at_floor);
  }
  if (not_finite > 0) result.note += fmt::format("{}{} dt not finite", result.note.empty() ? "" : "; ", not_finite);
  return result;
}

}  // namespace plumbline
