#include "plumbline/harness/assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumbline {
namespace {

constexpr std::size_t kCurvePoints = 200;

// Error against time, at most kCurvePoints points: of each stretch of samples the one with the largest error, so
// that thinning keeps the spikes.
std::vector<CurvePoint> error_curve(const Comparison& c) {
  const std::size_t samples = std::min(c.actual.samples(), c.expected.samples());
  const std::size_t stretch = (samples + kCurvePoints - 1) / kCurvePoints;
  std::vector<CurvePoint> curve;
  for (std::size_t first = 0; first < samples; first += stretch) {
    CurvePoint worst{c.actual.time(first), 0};
    for (std::size_t k = first; k < std::min(first + stretch, samples); ++k) {
      double error = 0;
      for (std::size_t b = 0; b < c.scenario.bodies.size(); ++b) {
        Vec3 d = c.actual.at(k, b).p_WB - c.expected.at(k, b).p_WB;
        if (c.in_plane) d.y() = 0;
        error = max_or_nan(error, d.norm());
      }
      if (error > worst.error || std::isnan(error)) worst = {c.actual.time(k), error};
    }
    curve.push_back(worst);
  }
  return curve;
}

struct GateTally {
  bool failed = false, excused = false, unexpected = false;
  std::string reason;
};

void note_first(std::string& reason, std::string text) {
  if (reason.empty()) reason = std::move(text);
}

// The deviation that speaks of this gate in this run; nullptr when none does.
const Deviation* deviation_for(const Gate& gate, const Scenario& scenario, const RunResult& result,
                               const std::vector<Deviation>& deviations) {
  for (const Deviation& d : deviations) {
    if (d.metric == gate.metric && d.covers(scenario, result.engine, result.profile, result.dt)) return &d;
  }
  return nullptr;
}

GateTally check_gates(RunResult& result, const Comparison& c, const EngineInfo& engine,
                      const KnownDeviations& deviations) {
  GateTally tally;
  std::string unexpected;
  const GateContext context{result.dt, static_cast<double>(c.scenario.step_count(result.dt)), engine.unit_roundoff()};
  for (const Gate& gate : c.scenario.gates) {
    const double limit = gate.limit(context);
    GateResult row{gate.metric, result.metric(gate.metric), limit, false, gate.reason, "", gate.place};
    row.passed = within(row.value, limit);
    const Deviation* deviation = deviation_for(gate, c.scenario, result, deviations.list);
    if (row.passed && deviation != nullptr && deviations.must_apply) {
      tally.unexpected = true;
      note_first(unexpected,
                 fmt::format("{} = {:.3g} holds its limit {:.3g} although {}:{} lists it: take it off the list",
                             gate.metric, row.value, limit, deviation->place.file, deviation->place.line));
    } else if (!row.passed && deviation != nullptr && within(row.value, deviation->limit)) {
      tally.excused = true;
      row.deviation = deviation->why;
      note_first(tally.reason, deviation->why);
    } else if (!row.passed) {
      std::string text = fmt::format("{} = {:.3g} exceeds its limit {:.3g}", gate.metric, row.value, limit);
      if (deviation != nullptr) text += fmt::format(", and even the {:.3g} of its known deviation", deviation->limit);
      if (!tally.failed) tally.reason = text;
      tally.failed = true;
    }
    result.gates.push_back(std::move(row));
  }
  if (!tally.failed && tally.unexpected) tally.reason = unexpected;
  return tally;
}

}  // namespace

bool measured_in_plane(const Scenario& scenario, const EngineInfo& engine) {
  return engine.dimension == 2 && planar_view(scenario).planarity == Planarity::kProjection;
}

RunResult begin_result(const Scenario& scenario, const EngineInfo& engine, Profile profile, double dt) {
  RunResult result;
  result.scenario = scenario.id;
  result.case_name = scenario.case_name();
  result.parameters = scenario.parameters;
  result.engine = engine.name;
  result.profile = profile;
  result.dt = dt;
  result.settings = settings_of(engine, profile);
  if (measured_in_plane(scenario, engine)) {
    result.notes.push_back("planar projection: motion along y is uncoupled, not simulated and not measured");
  }
  const bool applied = !scenario.springs.empty() && !engine.features.contains(Feature::kSpring);
  const bool joints_applied = !scenario.joint_springs.empty() && !engine.features.contains(Feature::kJointSpring);
  if (applied || joints_applied) {
    result.notes.push_back("springs applied from outside: the engine has none, their force is held over a step");
  }
  return result;
}

void assess(RunResult& result, const Comparison& comparison, const EngineInfo& engine,
            std::optional<std::size_t> not_finite_at, const KnownDeviations& deviations) {
  for (const Metric& metric : metrics()) {
    if (metric.applies(comparison.scenario)) {
      result.metrics.emplace_back(std::string(metric.name), metric.measure(comparison));
    }
  }
  if (comparison.scenario.pointwise && !comparison.scenario.threshold) result.curve = error_curve(comparison);
  const GateTally tally = check_gates(result, comparison, engine, deviations);
  if (not_finite_at) {
    result.verdict = Verdict::kDiverged;
    result.reason = fmt::format("a state is not finite at t = {:.6g} s (step {})",
                                comparison.actual.time(*not_finite_at), *not_finite_at);
    return;
  }
  result.verdict = tally.failed       ? Verdict::kFail
                   : tally.unexpected ? Verdict::kUnexpectedPass
                   : tally.excused    ? Verdict::kExpectedFail
                                      : Verdict::kPass;
  result.reason = tally.reason;
}

}  // namespace plumbline
