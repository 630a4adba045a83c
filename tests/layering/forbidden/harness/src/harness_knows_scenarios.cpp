#include <plumbline/scenarios/scenario_file.hpp>
