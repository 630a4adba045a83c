#include "plumbline/reports/html_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "case_section.hpp"
#include "figure.hpp"
#include "html_case.hpp"
#include "html_chart.hpp"
#include "html_engines.hpp"
#include "html_style.hpp"
#include "html_text.hpp"
#include "text_file.hpp"

namespace plumbline {
namespace {

using namespace reports;

std::string case_id(std::size_t index) { return "case-" + std::to_string(index + 1); }

std::string verdict_chips(const Report& report) {
  const VerdictCounts counts = count_verdicts(report);
  std::vector<VerdictRow> rows(verdict_table().begin(), verdict_table().end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const VerdictRow& a, const VerdictRow& b) { return a.badness > b.badness; });
  std::string html = "<ul class=\"chips\">";
  for (const VerdictRow& row : rows) {
    const std::size_t count = counts[static_cast<std::size_t>(row.verdict)];
    if (count == 0) continue;
    html += fmt::format("<li class=\"badge {}\" title=\"{}\"><span aria-hidden=\"true\">{}</span> {} {}</li>",
                        verdict_class(row.verdict), escaped(row.meaning), verdict_symbol(row.verdict), count, row.name);
  }
  return html + "</ul>\n";
}

std::string headline(const Report& report, const std::vector<CaseSection>& sections) {
  std::set<std::string> engines;
  for (const RunResult& r : report.runs) engines.insert(r.engine);
  std::string html = "<header>\n<h1>How far from the truth?</h1>\n";
  html += fmt::format(
      "<p class=\"lead\">{} of {} on {}: each trajectory against an exact reference, against the other engines, and "
      "against the numerical scheme that explains it.</p>\n",
      counted(report.runs.size(), "run"), counted(sections.size(), "case"), counted(engines.size(), "engine"));
  if (report.interrupted) {
    html += "<p class=\"banner\"><b>Interrupted.</b> What had not been run by then is missing here.</p>\n";
  }
  html += verdict_chips(report);
  html += "<p class=\"soft small\">";
  for (const auto& [key, value] : report.environment) {
    if (key != "command") html += fmt::format("{} {} · ", escaped(key), escaped(value));
  }
  html += fmt::format("plumbline {} · took {}</p>\n", escaped(report.tool_version), duration(report.wall_seconds));
  return html + "</header>\n";
}

std::string matrix_cell(const CaseSection& section, const std::string& engine, Profile profile, const std::string& id) {
  const auto row = std::find_if(section.rows.begin(), section.rows.end(),
                                [&](const CaseRow& r) { return r.engine == engine && r.profile == profile; });
  const RunResult* const run = row == section.rows.end() ? nullptr : worst_run(*row);
  if (run == nullptr) return "<td class=\"v-none\"><span>not run</span></td>";
  const GateResult* const gate = failed_gate(*run);
  std::string number;
  if (gate != nullptr) {
    number = with_unit(gate->value, gate->metric);
  } else if (has_metric(*run, "position.max")) {
    number = with_unit(run->metric("position.max"), "position.max");
  } else {
    number = verdict_name(run->verdict);
  }
  const std::string hint =
      fmt::format("{} {}.{}, worst at dt = {} s: {}; {}", section.case_name, engine, profile_name(profile),
                  step_label(run->dt), verdict_name(run->verdict), gate != nullptr ? gate->metric : "position.max");
  return fmt::format("<td class=\"{}\"><a href=\"#{}\" title=\"{}\"><b>{}</b><span>{}</span></a></td>",
                     verdict_class(run->verdict), id, escaped(hint), verdict_symbol(run->verdict), escaped(number));
}

std::string matrix(const Report& report, const std::vector<CaseSection>& sections) {
  std::string html = "<section id=\"matrix\">\n<h2>Every case on every engine</h2>\n";
  if (sections.empty()) {
    return html +
           "<p>Nothing was run: no scenario and engine matched what was asked for. <code>plumbline list</code> shows "
           "what there is.</p>\n</section>\n";
  }
  html +=
      "<p class=\"small soft\">A cell shows the worst verdict over the dt's, with position.max [m] of that run or the "
      "value of the first gate that does not hold. It leads to the case.</p>\n";
  if (!report.conformance.empty()) {
    html += fmt::format(
        "<p class=\"small\"><a href=\"./conformance.html\">Whether the adapters hand on what is stated</a>: {} of the "
        "conformance kit.</p>\n",
        counted(report.conformance.size(), "answer"));
  }
  // In the report's order of engines, which every section shares, however its rows are sorted.
  std::vector<std::string> engines;
  for (const EngineInfo& e : report.engines) engines.push_back(e.name);
  std::set<Profile> profiles;
  for (const RunResult& r : report.runs) {
    if (std::find(engines.begin(), engines.end(), r.engine) == engines.end()) engines.push_back(r.engine);
    profiles.insert(r.profile);
  }
  html += "<div class=\"scroll\"><table class=\"matrix\"><thead><tr><td></td>";
  for (const std::string& e : engines)
    html += fmt::format("<th scope=\"col\" colspan=\"{}\">{}</th>", profiles.size(), escaped(e));
  html += "</tr><tr><th scope=\"col\">case</th>";
  for (std::size_t i = 0; i < engines.size(); ++i) {
    for (const Profile p : profiles) html += fmt::format("<th scope=\"col\">{}</th>", profile_name(p));
  }
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < sections.size(); ++i) {
    html +=
        fmt::format("<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th>", case_id(i), escaped(sections[i].case_name));
    for (const std::string& e : engines) {
      for (const Profile p : profiles) html += matrix_cell(sections[i], e, p, case_id(i));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n</section>\n";
}

std::string reproduce(const Report& report) {
  std::string html = "<section id=\"reproduce\">\n<h2>How to reproduce</h2>\n";
  const auto command = std::find_if(report.environment.begin(), report.environment.end(),
                                    [](const auto& entry) { return entry.first == "command"; });
  if (command != report.environment.end()) {
    html += "<pre>" + escaped(command->second) + "</pre>\n";
  } else {
    html += "<p>The command was not recorded; <code>plumbline run</code> runs everything.</p>\n";
  }
  html += "<p>The numbers depend on the versions of the engines (above) and on:</p>\n<dl>";
  for (const auto& [key, value] : report.environment) {
    if (key != "command") html += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(key), escaped(value));
  }
  html += fmt::format("<dt>plumbline</dt><dd>{}</dd></dl>\n", escaped(report.tool_version));
  return html +
         "<p>results.json beside this page holds every number in full, the settings of each run and the places of "
         "the gates.</p>\n</section>\n";
}

}  // namespace

std::string html_page(const Report& report) {
  const std::vector<CaseSection> sections = case_sections(report);
  const CurveLooks looks(report);
  std::size_t tabs = 0;
  for (const CaseSection& s : sections) tabs = std::max(tabs, s.steps.size());

  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Plumbline "
      "report</title>\n<style>";
  html += style_sheet(tabs) + "</style>\n</head>\n<body>\n";
  html += headline(report, sections) + "<main>\n" + matrix(report, sections);
  for (std::size_t i = 0; i < sections.size(); ++i) html += case_html(sections[i], looks, case_id(i));
  html += engines_html(report) + reproduce(report);
  return html + "</main>\n</body>\n</html>\n";
}

void write_html(const Report& report, const std::filesystem::path& path) {
  reports::replace_file(path, html_page(report));
}

}  // namespace plumbline
