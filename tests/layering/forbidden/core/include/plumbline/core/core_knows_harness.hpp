#include "plumbline/harness/plan.hpp"
