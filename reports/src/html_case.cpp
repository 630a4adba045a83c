#include "html_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figure.hpp"
#include "html_text.hpp"

namespace plumbline::reports {
namespace {

constexpr std::size_t kMessageRoom = 1500;  // characters of an engine's own output; the rest is in results.json

std::string facts(const CaseSection& section) {
  std::string html;
  const ScenarioSummary* const s = section.scenario;
  if (s != nullptr) {
    html += fmt::format("<p>{}</p>\n<dl class=\"small\">", escaped(s->about));
    const auto row = [&](const char* name, const std::string& value) {
      if (!value.empty()) html += fmt::format("<dt>{}</dt><dd>{}</dd>", name, escaped(value));
    };
    row("source", s->source);
    row("reference", s->reference_kind + (s->citation.empty() ? "" : ": " + s->citation));
    row("file", s->file);
  } else {
    html += "<dl class=\"small\">";
  }
  for (const CaseRow& row : section.rows) {
    const auto run = std::find_if(row.runs.begin(), row.runs.end(), [](const RunResult* r) { return r != nullptr; });
    if (run == row.runs.end() || (*run)->parameters.empty()) continue;
    std::string text;
    for (const auto& [name, value] : (*run)->parameters) {
      text += (text.empty() ? "" : ", ") + name + " = " + three_digits(value);
    }
    html += fmt::format("<dt>parameters</dt><dd>{}</dd>", escaped(text));
    break;
  }
  return html + "</dl>\n";
}

std::string order_cell(const CaseRow& row) {
  const Convergence* const c = row.convergence;
  if (c == nullptr) return "<td class=\"n none\"><abbr title=\"not determined\">–</abbr></td>";
  if (std::isnan(c->order))
    return fmt::format("<td class=\"n none\"><abbr title=\"{}\">–</abbr></td>", escaped(c->note));
  const std::string hint = counted(c->points, "dt") + (c->note.empty() ? "" : ": " + c->note);
  return fmt::format("<td class=\"n\"><abbr title=\"{}\">{:.2f}</abbr></td>", escaped(hint), c->order);
}

std::string reason_html(const RunResult& run) {
  // Where gates do not hold, their own lines tell more than the summary of them does.
  const bool told_by_gates =
      failed_gate(run) != nullptr && (run.verdict == Verdict::kFail || run.verdict == Verdict::kExpectedFail);
  std::string html = told_by_gates ? "" : escaped(run.reason);
  const auto add = [&](const std::string& text) { html += (html.empty() ? "" : "<br>") + escaped(text); };
  // Several gates often fall for one cause: it is told once, behind the last of them.
  const std::string* cause = nullptr;
  const auto add_cause = [&] {
    if (cause != nullptr) add("known cause: " + *cause);
  };
  for (const GateResult& gate : run.gates) {
    if (gate.passed) continue;
    const std::string* const its_cause = gate.deviation.empty() ? nullptr : &gate.deviation;
    if (cause != nullptr && (its_cause == nullptr || *its_cause != *cause)) add_cause();
    cause = its_cause;
    add(gate_text(gate) + (its_cause == nullptr ? "; the limit's reason: " + gate.reason : ""));
  }
  add_cause();
  if (html.empty()) {
    add(run.gates.empty() ? "no gate applies" : fmt::format("holds {}", counted(run.gates.size(), "gate")));
  }
  for (const std::string& note : run.notes) add(note);
  if (!run.trajectory.empty()) html += fmt::format(" <a href=\"{}\">trajectory</a>", link_to(run.trajectory));
  if (!run.messages.empty() && row_of(run.verdict).breaks_build) {
    const std::string_view messages = run.messages;
    html +=
        fmt::format("<details><summary>what the engine printed</summary><pre>{}{}</pre></details>",
                    escaped(messages.substr(0, kMessageRoom)), messages.size() > kMessageRoom ? "\n(cut here)" : "");
  }
  return html;
}

std::string run_row(const CaseRow& row, const RunResult* run) {
  const std::string head = fmt::format("<tr><th scope=\"row\">{}</th><td class=\"word\">{}</td>", escaped(row.engine),
                                       profile_name(row.profile));
  if (run == nullptr)
    return head + "<td><span class=\"badge v-none\">not run</span></td><td colspan=\"7\"></td></tr>\n";
  std::string html = head + "<td>" + verdict_badge(run->verdict) + "</td>";
  for (const char* metric : {"position.max", "velocity.max", "energy.max", "event_time.max"}) {
    html += number_cell(*run, metric);
  }
  const std::string explanation = explanation_text(*run);
  return html + order_cell(row) + "<td class=\"text\">" +
         (explanation.empty() ? "<span class=\"soft\">not compared</span>" : escaped(explanation)) +
         "</td><td class=\"text\">" + reason_html(*run) + "</td></tr>\n";
}

std::string runs_table(const CaseSection& section, std::size_t step) {
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th>engine</th><th>profile</th><th>verdict</th>"
      "<th class=\"n\">position.max<br>[m]</th><th class=\"n\">velocity.max<br>[m/s]</th>"
      "<th class=\"n\">energy.max<br>[1]</th><th class=\"n\">event_time.max<br>[s]</th><th class=\"n\">order</th>"
      "<th>explanation</th><th>reason</th></tr></thead><tbody>\n";
  for (const CaseRow& row : section.rows) html += run_row(row, row.runs[step]);
  return html + "</tbody></table></div>\n";
}

// Shade of a distance between the smallest and the largest of the table, on a logarithmic scale.
std::string heat_cell(double distance, double smallest, double largest) {
  if (!std::isfinite(distance)) return fmt::format("<td class=\"v-fail\">{}</td>", three_digits(distance));
  if (distance == 0) return "<td>0</td>";
  const double span = std::log(largest / smallest);
  const double share = span > 0 ? std::log(distance / smallest) / span : 0;
  return fmt::format("<td style=\"background:rgba(213,94,0,{:.2f})\">{}</td>", 0.06 + 0.49 * share,
                     three_digits(distance));
}

std::string divergence_table(const Divergence& d) {
  const std::size_t n = d.engines.size();
  double smallest = HUGE_VAL, largest = 0;
  for (const double distance : d.distance) {
    if (!std::isfinite(distance) || distance == 0) continue;
    smallest = std::min(smallest, distance);
    largest = std::max(largest, distance);
  }
  std::string html = fmt::format(
      "<div class=\"scroll\"><table class=\"heat\"><caption class=\"small soft\">{} profile, "
      "[m]</caption><thead><tr><td></td>",
      profile_name(d.profile));
  for (const std::string& e : d.engines) html += "<th class=\"n\" scope=\"col\">" + escaped(e) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < n; ++i) {
    html += "<tr><th scope=\"row\">" + escaped(d.engines[i]) + "</th>";
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t at = i * n + j;
      if (i == j) {
        html += "<td class=\"diag\">·</td>";
      } else {
        html += at < d.distance.size() ? heat_cell(d.distance[at], smallest, largest) : "<td>?</td>";
      }
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string divergence_html(const CaseSection& section, double dt) {
  std::string tables;
  for (const Divergence* d : section.divergence) {
    if (d->dt == dt && d->engines.size() > 1) tables += divergence_table(*d);
  }
  if (tables.empty())
    return "<p class=\"soft small\">Fewer than two engines ran this dt: nobody to disagree with.</p>\n";
  return "<h3>Largest distance between two engines</h3>\n<div class=\"pair\">" + tables + "</div>\n";
}

}  // namespace

std::string case_html(const CaseSection& section, const CurveLooks& looks, const std::string& id) {
  std::string html = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", id, escaped(section.case_name)) + facts(section);
  html += "<div class=\"tabs\">\n";
  for (std::size_t k = 0; k < section.steps.size(); ++k) {
    html +=
        fmt::format("<input type=\"radio\" name=\"{0}\" id=\"{0}-{1}\"{2}><label for=\"{0}-{1}\">dt = {3} s</label>\n",
                    id, k, k == 0 ? " checked" : "", step_label(section.steps[k]));
  }
  html += "<div class=\"panels\">\n";
  for (std::size_t k = 0; k < section.steps.size(); ++k) {
    std::vector<const RunResult*> runs;
    for (const CaseRow& row : section.rows) runs.push_back(row.runs[k]);
    const std::string title = fmt::format("{}: distance from the reference against time, dt = {} s", section.case_name,
                                          step_label(section.steps[k]));
    html += fmt::format("<section aria-label=\"dt = {} s\">\n", step_label(section.steps[k])) +
            error_chart(runs, looks, title) + chart_legend(runs, looks) + runs_table(section, k) +
            divergence_html(section, section.steps[k]) + "</section>\n";
  }
  return html + "</div></div>\n</section>\n";
}

}  // namespace plumbline::reports
