#include "plumbline/core/engine.hpp"
#include "plumbline/reports/console.hpp"
