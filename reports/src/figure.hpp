// Numbers as people like to read them.
#pragma once

#include <string>

#include "plumbline/core/run_result.hpp"

namespace plumbline::reports {

// Three significant digits: "0.196", "3.60e-15", "0", "nan", "-inf".
std::string three_digits(double value);

// "1/60" for a step that is one over a whole number and has no short decimal, else the shortest decimal: "0.02".
std::string step_label(double dt);

// A share in [0, 1] as "100 %", "98 %"; never rounded up to 100.
std::string percent(double share);

// "8.3 s", "2 min 5 s".
std::string duration(double seconds);

// "3 runs", "1 run".
std::string counted(std::size_t count, const char* noun);

// The unit of a metric, "" for a pure number or an unknown metric.
std::string unit_of(const std::string& metric);

// "0.196 m", "0.44" for a pure number.
std::string with_unit(double value, const std::string& metric);

// "0.196 m off, 3.60e-15 m off semi-implicit Euler: 100 % explained"; empty when nothing was compared.
std::string explanation_text(const RunResult& run);

// "energy.max 0.44 > 1e-6" or, when not a number was measured, "energy.max is nan, limit 1e-6".
std::string gate_text(const GateResult& gate);

// The first gate that does not hold; nullptr when all hold.
const GateResult* failed_gate(const RunResult& run);

// Whether the metric was measured at all in that run.
bool has_metric(const RunResult& run, std::string_view name);

}  // namespace plumbline::reports
