#include "plumbline/core/gate.hpp"

#include <cmath>

namespace plumbline {

bool within(double value, double limit) { return std::abs(value) <= limit; }

}  // namespace plumbline
