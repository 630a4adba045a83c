#include "figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plumbline/core/metric.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline::reports {

std::string three_digits(double value) {
  if (std::isnan(value)) return "nan";  // fmt would print a sign bit
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (value == 0) return "0";
  // Below a thousandth, leading zeros are harder to count than an exponent is to read.
  std::string text = std::abs(value) < 1e-3 ? fmt::format("{:.2e}", value) : fmt::format("{:#.3g}", value);
  if (text.back() == '.') text.pop_back();
  // Exponents have two digits at least; the leading zero only costs room.
  const std::size_t e = text.find('e');
  if (e != std::string::npos && text[e + 2] == '0') text.erase(e + 2, 1);
  if (e != std::string::npos && text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

std::string step_label(double dt) {
  const std::string decimal = shortest(dt);
  const double inverse = 1 / dt;
  const double nearest = std::round(inverse);
  const bool one_over_whole = std::abs(inverse - nearest) <= 1e-12 * nearest && nearest < 1e9;
  return decimal.size() > 7 && one_over_whole ? fmt::format("1/{:.0f}", nearest) : decimal;
}

std::string percent(double share) {
  if (!std::isfinite(share)) return three_digits(share) + " %";
  if (share >= 0.9995) return "100 %";
  return fmt::format("{:.0f} %", std::clamp(std::round(100 * share), 0.0, 99.0));
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return three_digits(seconds) + " s";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 59.5) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(std::min(seconds, 1e15)));
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string unit_of(const std::string& name) {
  const Metric* metric = find_metric(name);
  return metric == nullptr || metric->unit == "1" ? "" : std::string(metric->unit);
}

std::string with_unit(double value, const std::string& metric) {
  const std::string unit = unit_of(metric);
  return three_digits(value) + (unit.empty() || std::isnan(value) ? "" : " " + unit);
}

std::string explanation_text(const RunResult& run) {
  if (run.explanation.scheme.empty()) return "";
  return fmt::format("{} m off, {} m off {}: {} explained", three_digits(run.metric("position.max")),
                     three_digits(run.explanation.distance), run.explanation.scheme, percent(run.explanation.share));
}

std::string gate_text(const GateResult& gate) {
  const std::string limit = with_unit(gate.limit, gate.metric);
  if (std::isnan(gate.value)) return fmt::format("{} is nan, limit {}", gate.metric, limit);
  const char* const bars = gate.value < 0 ? "|" : "";
  return fmt::format("{}{}{} {} > {}", bars, gate.metric, bars, with_unit(std::abs(gate.value), gate.metric), limit);
}

const GateResult* failed_gate(const RunResult& run) {
  const auto found = std::find_if(run.gates.begin(), run.gates.end(), [](const GateResult& g) { return !g.passed; });
  return found == run.gates.end() ? nullptr : &*found;
}

bool has_metric(const RunResult& run, std::string_view name) {
  return std::any_of(run.metrics.begin(), run.metrics.end(), [name](const auto& m) { return m.first == name; });
}

}  // namespace plumbline::reports
