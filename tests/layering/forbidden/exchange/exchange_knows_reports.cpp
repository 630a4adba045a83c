#include "plumbline/reports/console.hpp"
