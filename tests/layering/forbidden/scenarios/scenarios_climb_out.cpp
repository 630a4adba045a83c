#include "../harness/src/inner.hpp"
