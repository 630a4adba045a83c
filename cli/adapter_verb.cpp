// plumbline adapter test: the conformance kit, for whoever writes an adapter or doubts one.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "environment.hpp"
#include "interruption.hpp"
#include "inventory.hpp"
#include "plumbline/harness/conformance.hpp"
#include "plumbline/harness/conformance_campaign.hpp"
#include "plumbline/reports/conformance_report.hpp"
#include "plumbline/reports/results_json.hpp"
#include "selection.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

struct AdapterTestOptions {
  std::vector<std::string> engines, filter;
  std::string profile = "both", output;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  double timeout = 30;
  bool list = false, verbose = false, quiet = false;
};

int print_checks() {
  std::string theme;
  for (const ConformanceCheck& check : conformance_checks()) {
    if (check.theme != theme) fmt::print("{}{}\n", theme.empty() ? "" : "\n", theme = check.theme);
    fmt::print("  {:<38} {}{}\n", check.name, check.question, check.matched_only ? " (matched only)" : "");
  }
  return kExitPass;
}

int adapter_test(const AdapterTestOptions& o) {
  if (o.list) return print_checks();
  const auto selected = name_filter(o.filter);
  EngineInventory engines = load_engines(find_installation());
  select_engines(engines, o.engines);
  Report report;
  report.tool_version = PLUMBLINE_VERSION;
  report.environment = describe_environment();
  report.missing_engines = engines.missing;
  for (const EngineRow& row : engines.rows) report.engines.push_back(row.info);

  const bool redraw = !o.quiet && isatty(STDERR_FILENO) == 1;
  const auto start = std::chrono::steady_clock::now();
  run_conformance(
      engines.rows, *engines.pool, {profiles_named(o.profile), selected, o.jobs, WorkerPool::Seconds(o.timeout)},
      [&](std::size_t done, std::size_t total, const ConformanceResult& result) {
        if (redraw) fmt::print(stderr, "\r\x1b[K{}/{} {} {}", done, total, result.engine, result.check);
      },
      stop_on_signal(), report);
  if (redraw) fmt::print(stderr, "\r\x1b[K");
  report.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (report.conformance.empty() && !report.interrupted) {
    fmt::print(stderr,
               "error: nothing was asked; `plumbline adapter test --list` shows the checks, `plumbline doctor` "
               "the engines\n");
    return kExitNothingMatched;
  }
  print_conformance(report, console_style_for(STDOUT_FILENO), std::cout, {true, o.verbose});
  if (!o.output.empty()) {
    const std::filesystem::path folder = o.output;
    write_results(report, folder / "conformance.json");
    write_conformance_page(report, folder / "conformance.html");
    fmt::print("Written: {} and conformance.html\n", (folder / "conformance.json").string());
  }
  return exit_code(report);
}

}  // namespace

void add_adapter_verb(CLI::App& program, Action& action) {
  const auto o = std::make_shared<AdapterTestOptions>();
  CLI::App* adapter = program.add_subcommand("adapter", "Questions about adapters themselves");
  adapter->require_subcommand(1);
  CLI::App* verb = adapter->add_subcommand(
      "test", "Ask whether an adapter hands the stated problem to its engine and the answer back");
  verb->add_option("engines", o->engines, "These engines: bullet-f32, or bullet for all its rows; none: all")
      ->delimiter(',');
  verb->add_option("-f,--filter", o->filter,
                   "Only checks whose name matches this regular expression; -REGEX leaves out")
      ->allow_extra_args(false);
  verb->add_option("--profile", o->profile, "Engine settings: default, matched or both")
      ->check(CLI::IsMember({"default", "matched", "both"}))
      ->capture_default_str();
  verb->add_option("-j,--jobs", o->jobs, "Checks at once")->check(CLI::Range(1u, 1024u))->capture_default_str();
  verb->add_option("--timeout", o->timeout, "Wall-clock limit of one check [s]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("-o,--output", o->output, "Folder for conformance.json and conformance.html; none: no files");
  verb->add_flag("--list", o->list, "Only print the checks and their questions");
  verb->add_flag("-v,--verbose", o->verbose, "Every answer that is not a plain pass, with its text in full");
  verb->add_flag("-q,--quiet", o->quiet, "No progress display");
  verb->callback([o, &action] { action = [o] { return adapter_test(*o); }; });
}

}  // namespace plumbline
