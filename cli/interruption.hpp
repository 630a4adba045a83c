// Ctrl-C that ends in order.
#pragma once

#include <atomic>

namespace plumbline {

// From now on the first SIGINT or SIGTERM sets the flag, so that what is finished can be kept; the second one ends the
// program at once.
const std::atomic<bool>& stop_on_signal();

}  // namespace plumbline
