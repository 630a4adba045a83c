// plumbline run: the main job.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "environment.hpp"
#include "interruption.hpp"
#include "inventory.hpp"
#include "plumbline/harness/conformance_campaign.hpp"
#include "plumbline/reports/conformance_report.hpp"
#include "plumbline/reports/console.hpp"
#include "plumbline/reports/html_page.hpp"
#include "plumbline/reports/progress.hpp"
#include "plumbline/reports/results_json.hpp"
#include "plumbline/reports/trajectory_csv.hpp"
#include "selection.hpp"
#include "usage_error.hpp"
#include "variants.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace fs = std::filesystem;
namespace {

struct RunOptions {
  std::vector<std::string> paths, filter, engines, parameters, settings, steps;
  std::string profile = "both", tier, output = "plumbline-results";
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  double timeout = 30;
  unsigned repeat = 1;
  bool json = false, dry_run = false, no_trajectories = false, no_conformance = false, quiet = false, verbose = false;
};

// Keeps results.json up to date while the runs go on, so that even a killed run leaves what it had. The file is
// rewritten whole each time: at most every two seconds, and no more often than that it costs a twentieth of the time.
class Keeper {
 public:
  Keeper(const Report& report, fs::path file) : report_(report), file_(std::move(file)) {}

  void keep() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    write_results(report_, file_);
    const auto done = std::chrono::steady_clock::now();
    next_ = done + std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(2), 20 * (done - now));
  }

 private:
  const Report& report_;
  fs::path file_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::seconds(2);
};

// The folder of one case below trajectories/: "particle/drag_ship" or "collision/two_sphere/e=0.5,b=0".
fs::path trajectory_path(const RunResult& run) {
  return fs::path("trajectories") / run.case_name /
         fmt::format("{}.{}.dt={}.csv", run.engine, profile_name(run.profile), shortest(run.dt));
}

class RunVerb {
 public:
  explicit RunVerb(const RunOptions& options) : options_(options), output_(options.output) {}

  int run() {
    if (!prepare()) return nothing_matched();
    if (options_.dry_run) return print_plan();
    const auto start = std::chrono::steady_clock::now();
    carry_out();
    report_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    finish();
    return exit_code(report_);
  }

 private:
  // False when nothing is left to run.
  bool prepare() {
    const Overrides overrides = parse_parameters(options_.parameters);
    const auto selected = name_filter(options_.filter);
    const std::vector<double> steps = parse_steps(options_.steps);
    const Installation installation = find_installation();
    engines_ = load_engines(installation);
    for (const MissingEngine& m : engines_.missing) {
      fmt::print(stderr, "note: engine {} is left out: {}\n", m.name, m.reason);
    }
    select_engines(engines_, options_.engines);
    vary_settings(engines_, parse_settings(options_.settings));
    std::vector<EngineInfo> infos;
    for (const EngineRow& row : engines_.rows) infos.push_back(row.info);
    const auto plan_of = [&](const std::vector<CaseInput>& cases) {
      return plan_runs(cases, infos, profiles_named(options_.profile), tier(), selected);
    };
    scenarios_ = load_scenarios(installation, options_.paths, overrides, [&](const Scenario& scenario) {
      return !plan_of({{scenario, nullptr, nullptr, ""}}).empty();
    });
    if (!steps.empty()) {
      for (CaseInput& c : scenarios_.cases) c.scenario.steps = steps;
      for (ScenarioSummary& s : scenarios_.summaries) s.steps = steps;
    }
    if (tier() == Tier::kSmoke) {
      for (CaseInput& c : scenarios_.cases) c.scenario.steps.resize(1);
      for (ScenarioSummary& s : scenarios_.summaries) s.steps.resize(1);
    }
    plan_ = plan_of(scenarios_.cases);
    report_.tool_version = PLUMBLINE_VERSION;
    report_.environment = describe_environment();
    report_.engines = infos;
    report_.missing_engines = engines_.missing;
    keep_planned_scenarios();
    return !plan_.empty();
  }

  // Who says which scenarios, parameters or steps wants all of them; the whole catalogue is run in its short form.
  Tier tier() const {
    for (const Tier tier : {Tier::kSmoke, Tier::kStandard, Tier::kFull}) {
      if (options_.tier == tier_name(tier)) return tier;
    }
    const bool said =
        !options_.paths.empty() || !options_.filter.empty() || !options_.parameters.empty() || !options_.steps.empty();
    return said ? Tier::kFull : Tier::kSmoke;
  }

  // The report speaks of the scenarios that were run, not of those that a filter left out.
  void keep_planned_scenarios() {
    std::vector<bool> planned(scenarios_.cases.size());
    for (const PlannedRun& run : plan_) planned[run.case_index] = true;
    for (ScenarioSummary summary : scenarios_.summaries) {
      std::erase_if(summary.cases, [&](const std::string& name) {
        for (std::size_t c = 0; c < planned.size(); ++c) {
          if (scenarios_.cases[c].scenario.case_name() == name) return !planned[c];
        }
        return true;
      });
      if (!summary.cases.empty()) report_.scenarios.push_back(std::move(summary));
    }
  }

  int nothing_matched() const {
    fmt::print(stderr, "error: nothing matched{}; `plumbline list` shows what there is\n",
               options_.filter.empty() ? "" : " " + joined(options_.filter));
    return kExitNothingMatched;
  }

  int print_plan() const {
    for (const PlannedRun& run : plan_) {
      fmt::print("{}\n", run_name(scenarios_.cases[run.case_index].scenario, engines_.rows[run.engine_index].info.name,
                                  run.profile, run.dt));
    }
    return kExitPass;
  }

  void carry_out() {
    const std::atomic<bool>& stop = stop_on_signal();
    clear_trajectories();
    write_results(report_, output_ / "results.json");

    Progress progress(std::cerr, options_.quiet ? Progress::Mode::kSilent : Progress::mode_for(STDERR_FILENO));
    progress.begin(plan_.size());
    VerdictCounts counts{};
    std::size_t done = 0;
    Keeper keeper(report_, output_ / "results.json");
    CampaignObserver observer;
    observer.finished = [&](RunResult& run, const Trajectory& trajectory) {
      if (trajectory.samples() > 0 && !options_.no_trajectories) {
        run.trajectory = trajectory_path(run).generic_string();
        write_trajectory(trajectory, scenario_of(run), output_ / run.trajectory);
      }
      ++counts[static_cast<std::size_t>(run.verdict)];
      progress.update(++done, run.case_name + ' ' + run.engine, counts);
      keeper.keep();
    };
    run_campaign(scenarios_.cases, engines_.rows, plan_, *engines_.pool,
                 {options_.jobs, WorkerPool::Seconds(options_.timeout), options_.repeat, as_in_the_files()}, observer,
                 stop, report_);
    progress.end();
    if (options_.no_conformance) return;
    run_conformance(engines_that_ran(), *engines_.pool,
                    {profiles_named(options_.profile), nullptr, options_.jobs, WorkerPool::Seconds(options_.timeout)},
                    nullptr, stop, report_);
  }

  // Not those whose settings were changed for this run: the lists of known failures are not made for them.
  std::vector<EngineRow> engines_that_ran() const {
    std::vector<bool> planned(engines_.rows.size());
    for (const PlannedRun& run : plan_) planned[run.engine_index] = true;
    std::vector<EngineRow> rows;
    for (std::size_t e = 0; e < planned.size(); ++e) {
      if (planned[e] && engines_.rows[e].changed.empty()) rows.push_back(engines_.rows[e]);
    }
    return rows;
  }

  // Lists of deviations are made for the files' own parameters and steps.
  bool as_in_the_files() const { return options_.parameters.empty() && options_.steps.empty(); }

  // Trajectories of an earlier run would pass for this one's. A folder of that name that no run wrote is left alone.
  void clear_trajectories() const {
    const fs::path folder = output_ / "trajectories";
    if (!fs::exists(folder)) return;
    if (!fs::exists(output_ / "results.json")) {
      throw UsageError(
          fmt::format("-o {}: there is a folder trajectories/ without results.json, which no run of "
                      "plumbline wrote; give another folder",
                      output_.string()));
    }
    fs::remove_all(folder);
  }

  const Scenario& scenario_of(const RunResult& run) const {
    const auto found = std::find_if(scenarios_.cases.begin(), scenarios_.cases.end(),
                                    [&](const CaseInput& c) { return c.scenario.case_name() == run.case_name; });
    return found->scenario;
  }

  void finish() {
    write_results(report_, output_ / "results.json");
    write_html(report_, output_ / "report.html");
    write_conformance();
    if (options_.json) {
      std::cout << results_json(report_) << std::flush;
    } else {
      const std::string files = fmt::format("{} and report.html", (output_ / "results.json").string());
      const ConsoleStyle style = console_style_for(STDOUT_FILENO);
      if (!report_.conformance.empty()) {
        print_conformance(report_, style, std::cout, {options_.verbose, options_.verbose});
      }
      print_report(report_, style, std::cout, {options_.verbose, files});
    }
    if (report_.interrupted) {
      fmt::print(stderr, "interrupted: {} of {} runs were finished and are kept in {}\n", report_.runs.size(),
                 plan_.size(), output_.string());
    }
  }

  // The page of an earlier run would pass for this one's.
  void write_conformance() const {
    const fs::path page = output_ / "conformance.html";
    if (report_.conformance.empty()) {
      fs::remove(page);
    } else {
      write_conformance_page(report_, page);
    }
  }

  const RunOptions& options_;
  fs::path output_;
  ScenarioInventory scenarios_;
  EngineInventory engines_;
  std::vector<PlannedRun> plan_;
  Report report_;
};

}  // namespace

void add_run_verb(CLI::App& program, Action& action) {
  const auto o = std::make_shared<RunOptions>();
  CLI::App* verb =
      program.add_subcommand("run", "Run scenarios on engines, measure how far off they are, write the report");
  verb->add_option("paths", o->paths, "Scenario files or folders instead of the built-in catalogue");
  verb->add_option(
          "-f,--filter", o->filter,
          "Only runs whose name (scenario/case/engine.profile.dt=...) matches this regular expression; given more "
          "than once, any of them; -REGEX leaves out what matches")
      ->allow_extra_args(false);
  verb->add_option("-e,--engines", o->engines, "Only these engines: bullet-f32, or bullet for all its rows")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--tier", o->tier,
                   "smoke: the first case and step of every scenario, seconds; standard: all cases and steps; full: "
                   "the long ones too. Default: smoke, or full once paths, -f, -P or --dt say what to run")
      ->check(CLI::IsMember({"smoke", "standard", "full"}));
  verb->add_option("--profile", o->profile, "Engine settings: default, matched or both")
      ->check(CLI::IsMember({"default", "matched", "both"}))
      ->capture_default_str();
  verb->add_option("-P,--parameter", o->parameters, "NAME=VALUE[,VALUE...]: set or sweep a scenario parameter")
      ->allow_extra_args(false);
  verb->add_option(
          "--set", o->settings,
          "ENGINE.OPTION=VALUE[,VALUE...]: set or sweep an engine's setting; plumbline list --settings shows them")
      ->allow_extra_args(false);
  verb->add_option("--dt", o->steps, "Time steps [s] instead of the scenario's: 0.02,1/240")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("-j,--jobs", o->jobs, "Runs at once")->check(CLI::Range(1u, 1024u))->capture_default_str();
  verb->add_option("--timeout", o->timeout, "Wall-clock limit of one run [s]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--repeat", o->repeat, "Every run must give the same bits this many times")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  verb->add_option("-o,--output", o->output, "Folder for results.json, trajectories/ and report.html")
      ->capture_default_str();
  verb->add_flag("--json", o->json, "Print results.json on standard output instead of the table");
  verb->add_flag("--no-trajectories", o->no_trajectories, "Do not write trajectory files");
  verb->add_flag("--no-conformance", o->no_conformance, "Do not put the engines before the conformance kit");
  verb->add_flag("-n,--dry-run", o->dry_run, "Only print the names of the runs");
  verb->add_flag("-v,--verbose", o->verbose, "The table in full");
  verb->add_flag("-q,--quiet", o->quiet, "No progress display");
  verb->callback([o, &action] { action = [o] { return RunVerb(*o).run(); }; });
}

}  // namespace plumbline
