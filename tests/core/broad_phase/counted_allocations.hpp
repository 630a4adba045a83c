// How often this program has called operator new so far.
#pragma once

#include <cstddef>

namespace plumbline {

std::size_t counted_allocations();

}  // namespace plumbline
