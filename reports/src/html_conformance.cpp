#include <fmt/format.h>

#include <algorithm>

#include "conformance_table.hpp"
#include "figure.hpp"
#include "html_style.hpp"
#include "html_text.hpp"
#include "plumbline/reports/conformance_report.hpp"
#include "text_file.hpp"

namespace plumbline {
namespace {

using namespace reports;

std::string badge(Verdict verdict, const std::string& text) {
  return fmt::format("<span class=\"badge {}\" title=\"{}\"><span aria-hidden=\"true\">{}</span> {}</span>",
                     verdict_class(verdict), escaped(conformance_meaning(verdict)), verdict_symbol(verdict), text);
}

std::string header(const Report& report, const ConformanceTable& table) {
  std::string html = "<header>\n<h1>Does each adapter hand on what is stated?</h1>\n";
  html += fmt::format(
      "<p class=\"lead\">{} on {}, each in a worker of its own: mass and inertia, frames, signs, forces, contacts, "
      "joints, worlds, and input that nobody can answer.</p>\n",
      counted(table.checks.size(), "check"), counted(table.engines.size(), "engine"));
  if (report.interrupted) {
    html += "<p class=\"banner\"><b>Interrupted.</b> What had not been asked by then is missing here.</p>\n";
  }
  html += "<ul class=\"chips\">";
  for (const VerdictRow& row : counted_verdicts(table.counts)) {
    html += "<li>" +
            badge(row.verdict, fmt::format("{} {}", table.counts[static_cast<std::size_t>(row.verdict)], row.name)) +
            "</li>";
  }
  html += "</ul>\n<p class=\"soft small\">";
  for (const auto& [key, value] : report.environment) {
    if (key != "command") html += fmt::format("{} {} · ", escaped(key), escaped(value));
  }
  return html + fmt::format("plumbline {}</p>\n</header>\n", escaped(report.tool_version));
}

// May be broken behind each underscore, where the column is narrow.
std::string breakable(const std::string& name) {
  std::string html;
  for (const char c : escaped(name)) {
    html += c;
    if (c == '_') html += "<wbr>";
  }
  return html;
}

// The anchor of a failure in the list below the matrix.
std::string failure_id(const ConformanceTable& table, const ConformanceResult* result) {
  const auto at = std::find(table.failures.begin(), table.failures.end(), result);
  return at == table.failures.end() ? "" : fmt::format("found-{}", at - table.failures.begin() + 1);
}

std::string cell(const ConformanceTable& table, const std::string& engine, Profile profile,
                 const ConformanceCheck& check) {
  const ConformanceResult* const result = table.find(engine, profile, check.name);
  if (result == nullptr)
    return "<td class=\"v-none\"><span class=\"soft\" title=\"not asked of this profile\">·</span></td>";
  const std::string hint =
      escaped(fmt::format("{}.{} {}: {}. {}", engine, profile_name(profile), check.name, verdict_name(result->verdict),
                          result->text.empty() ? conformance_meaning(result->verdict) : result->text));
  const std::string id = failure_id(table, result);
  const std::string mark = fmt::format("<b>{}</b>", verdict_symbol(result->verdict));
  const std::string inside = id.empty() ? fmt::format("<span title=\"{}\">{}</span>", hint, mark)
                                        : fmt::format("<a href=\"#{}\" title=\"{}\">{}</a>", id, hint, mark);
  return fmt::format("<td class=\"{}\">{}</td>", verdict_class(result->verdict), inside);
}

std::string matrix(const ConformanceTable& table) {
  std::string html = "<section id=\"matrix\">\n<h2>Every check on every engine</h2>\n";
  if (table.engines.empty()) {
    return html + "<p>Nothing was asked. <code>plumbline adapter test</code> asks every engine.</p>\n</section>\n";
  }
  html +=
      "<p class=\"small soft\">A cell leads to the numbers that were seen and wanted; a check to its question. A dot: "
      "the check is asked of the matched profile only.</p>\n<div class=\"scroll\"><table class=\"matrix "
      "checks\"><thead><tr><td></td>";
  for (const std::string& engine : table.engines) {
    html += fmt::format("<th scope=\"col\" colspan=\"{}\"><span class=\"up\">{}</span></th>", table.profiles.size(),
                        escaped(engine));
  }
  html += "</tr><tr><th scope=\"col\">check</th>";
  for (std::size_t e = 0; e < table.engines.size(); ++e) {
    for (const Profile profile : table.profiles) {
      html += fmt::format("<th scope=\"col\"><abbr title=\"{0}\">{1}</abbr></th>", profile_name(profile),
                          profile_name(profile).substr(0, 1));
    }
  }
  html += "</tr></thead><tbody>\n";
  std::string theme;
  for (const ConformanceCheck& check : table.checks) {
    if (check.theme != theme) {
      html += fmt::format("<tr><th scope=\"rowgroup\" class=\"theme\">{}</th></tr>\n", escaped(check.theme));
      theme = check.theme;
    }
    html += fmt::format("<tr><th scope=\"row\"><a href=\"#check-{0}\" title=\"{1}\">{2}</a></th>", escaped(check.name),
                        escaped(check.question), breakable(check.name));
    for (const std::string& engine : table.engines) {
      for (const Profile profile : table.profiles) html += cell(table, engine, profile, check);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n</section>\n";
}

std::string found(const ConformanceTable& table) {
  std::string html = "<section id=\"found\">\n<h2>What does not hold</h2>\n";
  if (table.failures.empty()) return html + "<p class=\"soft\">Everything that was asked holds.</p>\n</section>\n";
  html +=
      "<div class=\"scroll\"><table><thead><tr><th>verdict</th><th>engine</th><th>profile</th><th>check</th>"
      "<th>seen and wanted</th><th>known cause</th></tr></thead><tbody>\n";
  for (const ConformanceResult* r : table.failures) {
    std::string text = escaped(r->text.empty() ? conformance_meaning(r->verdict) : r->text);
    if (!r->messages.empty()) {
      text += "<details><summary>what the engine printed</summary><pre>" + escaped(r->messages) + "</pre></details>";
    }
    html += fmt::format(
        "<tr id=\"{}\"><td>{}</td><th scope=\"row\">{}</th><td>{}</td><td class=\"word\"><a "
        "href=\"#check-{}\">{}</a></td><td class=\"wide\">{}</td><td class=\"text\">{}</td></tr>\n",
        failure_id(table, r), badge(r->verdict, std::string(verdict_name(r->verdict))), escaped(r->engine),
        profile_name(r->profile), escaped(r->check), escaped(r->check), text, escaped(r->why));
  }
  return html + "</tbody></table></div>\n</section>\n";
}

std::string asked(const ConformanceTable& table) {
  std::string html =
      "<section id=\"asked\">\n<h2>What is asked</h2>\n<div class=\"scroll\"><table><thead><tr><th>check</th>"
      "<th>question</th><th>how far off an answer may be</th></tr></thead><tbody>\n";
  for (const ConformanceCheck& check : table.checks) {
    html += fmt::format(
        "<tr id=\"check-{0}\"><th scope=\"row\">{0}</th><td class=\"wide\">{1}{2}</td><td "
        "class=\"text\">{3}</td></tr>\n",
        escaped(check.name), escaped(check.question),
        check.matched_only ? " <span class=\"soft\">Asked of the matched profile only.</span>" : "",
        check.tolerance.empty() ? "not at all" : escaped(check.tolerance));
  }
  return html + "</tbody></table></div>\n</section>\n";
}

}  // namespace

std::string conformance_page(const Report& report) {
  const ConformanceTable table(report);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Plumbline "
      "conformance</title>\n<style>";
  html += style_sheet(0) + "</style>\n</head>\n<body>\n";
  html += header(report, table) + "<main>\n" + matrix(table) + found(table) + asked(table);
  return html + "</main>\n</body>\n</html>\n";
}

void write_conformance_page(const Report& report, const std::filesystem::path& path) {
  reports::replace_file(path, conformance_page(report));
}

}  // namespace plumbline
