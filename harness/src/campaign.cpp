#include "plumbline/harness/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "plumbline/harness/assessment.hpp"
#include "plumbline/harness/convergence.hpp"
#include "plumbline/harness/explanation.hpp"

namespace plumbline {
namespace {

// What all runs of one case and dt share. It lives from the first of them to the last.
struct Group {
  std::size_t waiting = 0;  // runs that are not finished
  Trajectory expected;
  std::vector<SchemeTrajectory> schemes;
  std::map<std::pair<Profile, std::size_t>, Trajectory> trajectories;  // by profile and engine
};

// Largest magnitudes of the reference: what rounding errors are measured against.
struct Magnitude {
  double position = 0, velocity = 0;
};

Magnitude magnitude_of(const Scenario& scenario, const Trajectory& reference) {
  Magnitude m;
  for (std::size_t k = 0; k < reference.samples(); ++k) {
    for (std::size_t b = 0; b < reference.bodies(); ++b) {
      if (scenario.bodies[b].fixed) continue;
      m.position = std::max(m.position, reference.at(k, b).p_WB.norm());
      m.velocity = std::max(m.velocity, reference.at(k, b).v_WB.norm());
    }
  }
  return m;
}

// First sample in which two recordings of the same run differ in any bit.
std::optional<std::size_t> first_difference(const Trajectory& a, const Trajectory& b) {
  const std::size_t bytes = a.bodies() * sizeof(BodyState);
  for (std::size_t k = 0; k < std::min(a.samples(), b.samples()); ++k) {
    if (std::memcmp(&a.at(k, 0), &b.at(k, 0), bytes) != 0) return k;
  }
  if (a.samples() != b.samples()) return std::min(a.samples(), b.samples());
  return std::nullopt;
}

class Campaign {
 public:
  Campaign(const std::vector<CaseInput>& cases, const std::vector<EngineRow>& engines,
           const std::vector<PlannedRun>& plan, const CampaignObserver& observer, Report& report)
      : cases_(cases), engines_(engines), plan_(plan), observer_(observer), report_(report) {
    magnitudes_.resize(cases.size());
    for (const PlannedRun& run : plan) ++groups_[key(run)].waiting;
  }

  void run(WorkerPool& pool, const CampaignOptions& options, const std::atomic<bool>& stop) {
    deviations_must_apply_ = options.deviations_must_apply;
    std::vector<RunRequest> requests;
    std::vector<std::size_t> run_of;  // which planned run a request belongs to
    for (std::size_t i = 0; i < plan_.size(); ++i) {
      const PlannedRun& run = plan_[i];
      const CaseInput& input = cases_[run.case_index];
      if (const std::string missing = missing_features(run); !missing.empty()) {
        finish_without_motion(i, Verdict::kUnsupported, missing);
        continue;
      }
      for (unsigned repetition = 0; repetition < options.repeat; ++repetition) {
        const EngineRow& row = engines_[run.engine_index];
        requests.push_back({row.program, row.worker_name, run.profile, run.dt, &input.scenario, input.text.get(),
                            input.file, row.changed});
        run_of.push_back(i);
      }
    }
    std::vector<unsigned> left(plan_.size(), options.repeat);
    std::map<std::size_t, RunOutcome> first;  // the first outcome of runs that are repeated
    pool.run(
        requests, options.jobs, options.limit,
        [&](std::size_t index, RunOutcome outcome) {
          const std::size_t i = run_of[index];
          auto [kept, is_first] = first.try_emplace(i);
          if (is_first) {
            kept->second = std::move(outcome);
          } else {
            compare_repetition(i, kept->second, outcome);
          }
          if (--left[i] == 0) {
            finish(i, std::move(kept->second));
            first.erase(kept);
          }
        },
        stop);
    report_.interrupted = stop;
    sort_into_plan_order();
    add_convergence();
  }

 private:
  using GroupKey = std::pair<std::size_t, double>;
  static GroupKey key(const PlannedRun& run) { return {run.case_index, run.dt}; }

  std::string missing_features(const PlannedRun& run) const {
    const Scenario& scenario = cases_[run.case_index].scenario;
    FeatureSet offered = engines_[run.engine_index].info.features;
    const std::string missing = needs(scenario).without(offered).describe();
    if (missing.empty()) return "";
    const std::string why = planar_view(scenario).reason;
    const bool spatial = !why.empty() && !offered.contains(Feature::kSpatial);
    return "the engine has no " + missing + (spatial ? " (" + why + ")" : "");
  }

  Group& group_of(const PlannedRun& run) {
    Group& group = groups_[key(run)];
    if (group.expected.samples() == 0) {
      const CaseInput& input = cases_[run.case_index];
      const std::size_t samples = input.scenario.step_count(run.dt) + 1;
      group.expected = sample(*input.reference, input.scenario.bodies.size(), run.dt, samples);
      // A scheme explains how far a trajectory is from a known one; elsewhere there is nothing to explain.
      if (input.scenario.pointwise && !input.scenario.threshold) {
        group.schemes = scheme_trajectories(input.scenario, run.dt);
      }
      Magnitude& m = magnitudes_[run.case_index];
      const Magnitude here = magnitude_of(input.scenario, group.expected);
      m = {std::max(m.position, here.position), std::max(m.velocity, here.velocity)};
    }
    return group;
  }

  RunResult begin(std::size_t i) const {
    const PlannedRun& run = plan_[i];
    return begin_result(cases_[run.case_index].scenario, engines_[run.engine_index].info, run.profile, run.dt);
  }

  void finish_without_motion(std::size_t i, Verdict verdict, std::string reason) {
    RunResult result = begin(i);
    result.verdict = verdict;
    result.reason = std::move(reason);
    publish(i, std::move(result), Trajectory());
  }

  void compare_repetition(std::size_t i, RunOutcome& first, const RunOutcome& again) {
    if (first.end != RunOutcome::End::kAnswered) return;
    if (again.end != RunOutcome::End::kAnswered) {
      different_[i] = "a repetition ended differently: " + again.reason;
    } else if (const auto k = first_difference(first.recording.trajectory, again.recording.trajectory)) {
      different_.try_emplace(i, fmt::format("a repetition gives other bits from t = {:.6g} s (step {}) on",
                                            first.recording.trajectory.time(*k), *k));
    }
  }

  void finish(std::size_t i, RunOutcome outcome) {
    using End = RunOutcome::End;
    const PlannedRun& run = plan_[i];
    const CaseInput& input = cases_[run.case_index];
    const EngineRow& engine = engines_[run.engine_index];
    RunResult result = begin(i);
    result.messages = std::move(outcome.messages);
    if (outcome.end != End::kAnswered) {
      result.verdict = outcome.end == End::kCrashed    ? Verdict::kCrashed
                       : outcome.end == End::kTimedOut ? Verdict::kTimedOut
                                                       : Verdict::kError;
      result.reason = std::move(outcome.reason);
      excuse_ending(result, input.scenario, engine);
      publish(i, std::move(result), Trajectory());
      return;
    }
    result.settings = std::move(outcome.settings);
    result.wall_seconds = outcome.recording.wall_seconds;
    const Trajectory& trajectory = outcome.recording.trajectory;
    Group& group = group_of(run);
    const bool in_plane = measured_in_plane(input.scenario, engine.info);
    assess(result, {input.scenario, trajectory, group.expected, in_plane, outcome.recording.critical}, engine.info,
           outcome.recording.not_finite_at, {engine.deviations, deviations_must_apply_ && engine.changed.empty()});
    if (!outcome.recording.not_finite_at && trajectory.samples() != group.expected.samples()) {
      result.verdict = Verdict::kError;
      result.reason =
          fmt::format("the worker sent {} samples, {} were asked for", trajectory.samples(), group.expected.samples());
    }
    excuse_ending(result, input.scenario, engine);
    const double floor = rounding_floor(engine.info.unit_roundoff(), static_cast<double>(trajectory.samples()),
                                        magnitudes_[run.case_index].position);
    result.explanation = explain(trajectory, group.schemes, result.metric("position.max"), floor, in_plane);
    if (const auto different = different_.find(i); different != different_.end()) {
      result.verdict = Verdict::kNondeterministic;
      result.reason = different->second;
    }
    const Trajectory& kept = group.trajectories[{run.profile, run.engine_index}] =
        std::move(outcome.recording.trajectory);
    publish(i, std::move(result), kept);
  }

  // A run that is known to end before its end; and one that is listed so and goes through. What takes too long on one
  // machine may be in time on another, so that is no news.
  void excuse_ending(RunResult& result, const Scenario& scenario, const EngineRow& engine) const {
    for (const Deviation& d : engine.deviations) {
      if (!d.ends || !d.covers(scenario, result.engine, result.profile, result.dt)) continue;
      if (result.verdict == *d.ends) {
        result.verdict = Verdict::kExpectedFail;
        result.reason = d.why;
      } else if (result.verdict == Verdict::kPass && *d.ends != Verdict::kTimedOut && deviations_must_apply_ &&
                 engine.changed.empty()) {
        result.verdict = Verdict::kUnexpectedPass;
        result.reason =
            fmt::format("the run goes through although {}:{} lists it as ending with {}: take it off the list",
                        d.place.file, d.place.line, verdict_name(*d.ends));
      }
      return;
    }
  }

  void publish(std::size_t i, RunResult result, const Trajectory& trajectory) {
    if (observer_.finished) observer_.finished(result, trajectory);
    report_.runs.push_back(std::move(result));
    order_.push_back(i);
    Group& group = groups_[key(plan_[i])];
    if (--group.waiting > 0) return;
    add_divergence(plan_[i], group);
    groups_.erase(key(plan_[i]));
  }

  // Who agrees with whom, per profile, among the engines that have a trajectory.
  void add_divergence(const PlannedRun& run, const Group& group) {
    const Scenario& scenario = cases_[run.case_index].scenario;
    for (Profile profile : {Profile::kDefault, Profile::kMatched}) {
      std::vector<std::pair<std::size_t, const Trajectory*>> present;
      for (const auto& [who, trajectory] : group.trajectories) {
        if (who.first == profile) present.emplace_back(who.second, &trajectory);
      }
      if (present.size() < 2) continue;
      Divergence d{scenario.case_name(), profile, run.dt, {}, {}};
      for (const auto& [engine, a] : present) {
        d.engines.push_back(engines_[engine].info.name);
        for (const auto& [other, b] : present) {
          const bool in_plane =
              measured_in_plane(scenario, engines_[engine].info) || measured_in_plane(scenario, engines_[other].info);
          d.distance.push_back(engine == other ? 0.0 : position_distance(*a, *b, in_plane));
        }
      }
      report_.divergence.push_back(std::move(d));
    }
  }

  void sort_into_plan_order() {
    std::vector<std::size_t> by_plan(order_.size());
    for (std::size_t k = 0; k < by_plan.size(); ++k) by_plan[k] = k;
    std::sort(by_plan.begin(), by_plan.end(), [&](std::size_t a, std::size_t b) { return order_[a] < order_[b]; });
    std::vector<RunResult> sorted;
    sorted.reserve(by_plan.size());
    for (std::size_t k : by_plan) sorted.push_back(std::move(report_.runs[k]));
    report_.runs = std::move(sorted);
    std::sort(order_.begin(), order_.end());
  }

  void add_convergence() {
    using Key = std::tuple<std::size_t, std::size_t, Profile>;
    std::map<Key, std::vector<std::size_t>> rows;  // finished runs of one case, engine and profile
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const PlannedRun& run = plan_[order_[k]];
      if (!report_.runs[k].metrics.empty()) rows[{run.case_index, run.engine_index, run.profile}].push_back(k);
    }
    for (const auto& [key, runs] : rows) {
      const auto& [case_index, engine_index, profile] = key;
      const Scenario& scenario = cases_[case_index].scenario;
      const EngineInfo& engine = engines_[engine_index].info;
      const Magnitude& m = magnitudes_[case_index];
      const std::pair<const char*, double> orders_of[] = {{"position.max", m.position},
                                                          {"position.final", m.position},
                                                          {"velocity.max", m.velocity},
                                                          {"velocity.final", m.velocity},
                                                          {"event_time.max", scenario.duration}};
      for (const auto& [metric, magnitude] : orders_of) {
        if (!find_metric(metric)->applies(scenario)) continue;
        std::vector<ErrorAtStep> errors;
        for (std::size_t k : runs) {
          const double dt = report_.runs[k].dt;
          const double steps = static_cast<double>(scenario.step_count(dt));
          errors.push_back(
              {dt, report_.runs[k].metric(metric), rounding_floor(engine.unit_roundoff(), steps, magnitude)});
        }
        const Order order = observed_order(errors);
        report_.convergence.push_back(
            {scenario.case_name(), engine.name, profile, metric, order.order, order.points, order.note});
      }
    }
  }

  const std::vector<CaseInput>& cases_;
  const std::vector<EngineRow>& engines_;
  const std::vector<PlannedRun>& plan_;
  const CampaignObserver& observer_;
  Report& report_;
  bool deviations_must_apply_ = true;
  std::map<GroupKey, Group> groups_;
  std::vector<Magnitude> magnitudes_;             // per case
  std::map<std::size_t, std::string> different_;  // runs whose repetitions disagree
  std::vector<std::size_t> order_;                // plan index of each result in report_.runs
};

}  // namespace

void run_campaign(const std::vector<CaseInput>& cases, const std::vector<EngineRow>& engines,
                  const std::vector<PlannedRun>& plan, WorkerPool& pool, const CampaignOptions& options,
                  const CampaignObserver& observer, const std::atomic<bool>& stop, Report& report) {
  Campaign(cases, engines, plan, observer, report).run(pool, options, stop);
}

}  // namespace plumbline
