// plumbline certify: is the truth true? Every reference against its second sources.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "inventory.hpp"
#include "plumbline/harness/certification.hpp"
#include "plumbline/reports/progress.hpp"
#include "selection.hpp"
#include "usage_error.hpp"
#include "verbs.hpp"

namespace plumbline {
namespace {

struct CertifyOptions {
  std::vector<std::string> paths, filter;
  std::string tier = "full", output;
  bool json = false, verbose = false;
};

struct CertifiedCase {
  const CaseInput& input;
  Certification certification;
};

Tier tier_named(const std::string& word) {
  for (const Tier tier : {Tier::kSmoke, Tier::kStandard, Tier::kFull}) {
    if (tier_name(tier) == word) return tier;
  }
  throw UsageError(fmt::format("--tier {}: write smoke, standard or full", word));
}

// Where a row was stated: a certificate in its own line, all else by the reference.
std::string place_of(const CertificationRow* row, const CaseInput& input) {
  if (row != nullptr && row->place.line > 0) return fmt::format("{}:{}", row->place.file, row->place.line);
  const std::string& text = *input.text;
  const std::size_t at = text.find("\n[reference]");
  if (at == std::string::npos) return input.file;
  return fmt::format("{}:{}", input.file, 2 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

std::vector<CertifiedCase> certify_all(const std::vector<CaseInput>& cases) {
  Progress progress(std::cerr, Progress::mode_for(2));
  progress.begin(cases.size());
  VerdictCounts counts{};
  std::vector<CertifiedCase> result;
  for (const CaseInput& input : cases) {
    progress.update(result.size(), input.scenario.case_name(), counts);
    Certification certification;
    try {
      certification = certify(input.scenario, *input.reference);
    } catch (const std::exception& e) {
      certification.rows.push_back({"error", e.what(), std::nan(""), 0, false, {}});
    }
    ++counts[static_cast<std::size_t>(certification.holds() ? Verdict::kPass : Verdict::kFail)];
    result.push_back({input, std::move(certification)});
  }
  progress.end();
  return result;
}

// "simulation, certificate (start, touch)": those in brackets say nothing by themselves.
std::string sources_of(const Certification& certification) {
  std::vector<std::string> independent, others;
  for (const CertificationRow& row : certification.rows) {
    auto& list = row.independent ? independent : others;
    if (std::find(list.begin(), list.end(), row.source) == list.end()) list.push_back(row.source);
  }
  std::erase_if(others, [&](const std::string& source) {
    return std::find(independent.begin(), independent.end(), source) != independent.end();
  });
  if (independent.empty()) independent.emplace_back("none");
  return joined(independent) + (others.empty() ? "" : " (" + joined(others) + ")");
}

// The row that the table shows: what fails, or else the independent one that is nearest to its bound.
const CertificationRow* shown_row(const Certification& certification) {
  const CertificationRow* failure = certification.failure();
  return failure != nullptr ? failure : certification.closest();
}

std::string reason_of(const CertifiedCase& c) {
  const CertificationRow* row = c.certification.failure();
  if (row == nullptr) {
    return fmt::format("{}: {}: no second source; {}", place_of(nullptr, c.input), c.input.scenario.case_name(),
                       c.certification.left_out.empty() ? "add a [[certificate]]"
                                                        : joined(c.certification.left_out) + "; add a [[certificate]]");
  }
  return fmt::format("{}: {}: {}: {}: is {:.3g}, may be {:.3g}", place_of(row, c.input), c.input.scenario.case_name(),
                     row->source, row->compared, row->figure, row->bound);
}

void print_rows(std::string& out, const Certification& certification) {
  for (const CertificationRow& row : certification.rows) {
    out += fmt::format("        {:<12} {:>9.2g} of {:<9.2g} {}\n", row.source, row.figure, row.bound, row.compared);
  }
  for (const std::string& why : certification.left_out) out += fmt::format("        left out: {}\n", why);
}

std::string table(const std::vector<CertifiedCase>& cases, bool verbose) {
  std::size_t width = 4;
  for (const CertifiedCase& c : cases) width = std::max(width, c.input.scenario.case_name().size());
  std::string out = fmt::format("      {:<{}}  {:<11}  {:>7}  {:>9}  {:>9}  {}\n", "case", width, "reference", "bound",
                                "worst", "may be", "second source (what must hold besides)");
  std::map<std::string, std::string> bounds;
  std::size_t failed = 0;
  for (const CertifiedCase& c : cases) {
    const Reference& reference = *c.input.reference;
    const CertificationRow* row = shown_row(c.certification);
    failed += c.certification.holds() ? 0 : 1;
    bounds.emplace(std::string(reference.kind()) + ": " + std::string(reference.bound_source()), "");
    out += fmt::format("{:<4}  {:<{}}  {:<11}  {:>7.1g}  {:>9}  {:>9}  {}\n", c.certification.holds() ? "ok" : "FAIL",
                       c.input.scenario.case_name(), width, reference.kind(), reference.uncertainty(),
                       row == nullptr ? "-" : fmt::format("{:.2g}", row->figure),
                       row == nullptr ? "-" : fmt::format("{:.2g}", row->bound), sources_of(c.certification));
    if (verbose) print_rows(out, c.certification);
  }
  out += "\nBounds, relative to the length scale, and where they come from:\n";
  for (const auto& [text, nothing] : bounds) out += fmt::format("  {}\n", text);
  out += fmt::format("\n{} references, {} without a failure\n", cases.size(), cases.size() - failed);
  for (const CertifiedCase& c : cases) {
    if (!c.certification.holds()) out += fmt::format("FAIL  {}\n", reason_of(c));
  }
  return out;
}

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(shortest(value));
}

std::string as_json(const std::vector<CertifiedCase>& cases) {
  nlohmann::json list = nlohmann::json::array();
  bool holds = true;
  for (const CertifiedCase& c : cases) {
    const Reference& reference = *c.input.reference;
    nlohmann::json rows = nlohmann::json::array();
    for (const CertificationRow& row : c.certification.rows) {
      rows.push_back({{"source", row.source},
                      {"compared", row.compared},
                      {"figure", number(row.figure)},
                      {"bound", number(row.bound)},
                      {"independent", row.independent},
                      {"holds", row.holds()},
                      {"place", place_of(&row, c.input)}});
    }
    list.push_back({{"case", c.input.scenario.case_name()},
                    {"reference", reference.kind()},
                    {"citation", reference.citation()},
                    {"bound", number(reference.uncertainty())},
                    {"bound_source", reference.bound_source()},
                    {"holds", c.certification.holds()},
                    {"reason", c.certification.holds() ? "" : reason_of(c)},
                    {"rows", rows},
                    {"left_out", c.certification.left_out}});
    holds = holds && c.certification.holds();
  }
  return nlohmann::json{{"holds", holds}, {"cases", list}}.dump(2) + "\n";
}

void write(const std::string& text, const std::string& file) {
  if (file.empty()) {
    fmt::print("{}", text);
    return;
  }
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw UsageError(fmt::format("-o {}: cannot be written", file));
}

int certify_verb(const CertifyOptions& options) {
  const auto selected = name_filter(options.filter);
  const Tier tier = tier_named(options.tier);
  const auto wanted = [&](const Scenario& s) { return selected(s.case_name()) && s.tier <= tier; };
  ScenarioInventory scenarios = load_scenarios(find_installation(), options.paths, {}, wanted);
  std::erase_if(scenarios.cases, [&](const CaseInput& input) { return !wanted(input.scenario); });
  if (scenarios.cases.empty()) {
    fmt::print(stderr, "nothing matched; `plumbline list` shows the cases\n");
    return kExitNothingMatched;
  }
  const auto cases = certify_all(scenarios.cases);
  write(options.json ? as_json(cases) : table(cases, options.verbose), options.output);
  const bool holds = std::all_of(cases.begin(), cases.end(), [](const auto& c) { return c.certification.holds(); });
  if (!holds && !options.output.empty()) {
    for (const CertifiedCase& c : cases) {
      if (!c.certification.holds()) fmt::print(stderr, "FAIL  {}\n", reason_of(c));
    }
  }
  return holds ? kExitPass : kExitGateFailed;
}

}  // namespace

void add_certify_verb(CLI::App& program, Action& action) {
  const auto options = std::make_shared<CertifyOptions>();
  CLI::App* verb = program.add_subcommand("certify", "Check every reference against a second source");
  verb->add_option("paths", options->paths, "Scenario files or folders instead of the built-in catalogue");
  verb->add_option("-f,--filter", options->filter,
                   "Only cases whose name matches this regular expression; -REGEX leaves out");
  verb->add_option("--tier", options->tier, "Cases up to this tier: smoke, standard, full (default)");
  verb->add_flag("--json", options->json, "Machine-readable: {\"holds\": ..., \"cases\": [...]}");
  verb->add_option("-o,--output", options->output, "Write the table there");
  verb->add_flag("-v,--verbose", options->verbose, "Every row of every case, and what could not be had");
  verb->callback([options, &action] { action = [options] { return certify_verb(*options); }; });
}

}  // namespace plumbline
