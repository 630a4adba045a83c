#include "plumbline/core/events/bounce_train.hpp"

#include <algorithm>
#include <cmath>

namespace plumbline {

BounceTrain::Hop BounceTrain::at(double time) const {
  const double total = duration(), remaining = total - (time - start);
  if (!(remaining > 0)) return {};
  // Which hop: e^j >= R/T. The logarithm may be a rounding off, next to a bounce; there the height is 0 on either side.
  double share = 1;  // e^j
  if (restitution > 0) {
    share = std::pow(restitution, std::max(0.0, std::floor(std::log(remaining / total) / std::log(restitution))));
  }
  const double hop_speed = speed * share;
  const double since = std::clamp(total * share - remaining, 0.0, 2 * hop_speed / pull);
  return {since * (hop_speed - 0.5 * pull * since), hop_speed - pull * since};
}

}  // namespace plumbline
