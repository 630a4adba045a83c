#pragma once

#include <functional>

namespace plumbline {

// With the first step of a process the layer starts a profiler, which listens on port 17815 for the whole network, and
// prints an error when another process does already. Here that step is taken while the profiler's port is taken, so
// that it gives up for good: no port is open, no thread is started, nothing is printed.
void keep_profiler_offline(const std::function<void()>& first_step);

}  // namespace plumbline
