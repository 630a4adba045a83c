// plumbline compare A.json B.json: what got worse, better or different.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "plumbline/harness/change.hpp"
#include "plumbline/reports/comparison_table.hpp"
#include "plumbline/reports/results_json.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

struct CompareOptions {
  std::string before, after;
  double tolerance = 0.01;
};

Report read(const std::string& file) {
  try {
    return read_results(file);
  } catch (const std::runtime_error& e) {
    throw UsageError(e.what());
  }
}

int compare(const CompareOptions& options) {
  const auto found = changes(read(options.before), read(options.after), options.tolerance);
  print_changes(found, console_style_for(STDOUT_FILENO), std::cout);
  const bool worse =
      std::any_of(found.begin(), found.end(), [](const RunChange& c) { return c.kind == RunChange::Kind::kWorse; });
  if (found.empty()) return kExitNothingMatched;
  return worse ? kExitGateFailed : kExitPass;
}

}  // namespace

void add_compare_verb(CLI::App& program, Action& action) {
  const auto o = std::make_shared<CompareOptions>();
  CLI::App* verb = program.add_subcommand("compare", "Compare two results files; exit code 1 when a run got worse");
  verb->add_option("before", o->before, "results.json of the earlier run")->required();
  verb->add_option("after", o->after, "results.json of the later run")->required();
  verb->add_option("--tolerance", o->tolerance, "Relative change of a metric that counts")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->callback([o, &action] { action = [o] { return compare(*o); }; });
}

}  // namespace plumbline
