#include "html_engines.hpp"

#include <fmt/format.h>

#include "figure.hpp"
#include "html_text.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline::reports {
namespace {

std::string value_text(const SettingValue& value, const std::string& unit) {
  std::string text;
  if (const auto* flag = std::get_if<bool>(&value)) {
    text = *flag ? "on" : "off";
  } else if (const auto* word = std::get_if<std::string>(&value)) {
    text = *word;
  } else {
    text = shortest(std::get<double>(value));
  }
  const bool pure_number = unit.empty() || unit == "1";
  return escaped(text + (pure_number ? "" : " " + unit));
}

std::string engine_row(const EngineInfo& e) {
  const std::string lacking = FeatureSet::all().without(e.features).describe();
  const std::string velocities =
      e.velocity_offset == 0 ? "with positions" : "shifted by " + three_digits(e.velocity_offset) + " dt";
  return fmt::format(
      "<tr><th "
      "scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
      escaped(e.name), escaped(e.library), escaped(e.version), e.precision == Precision::kSingle ? "single" : "double",
      e.dimension == 2 ? "plane (x-z)" : "space", escaped(e.scheme), velocities,
      lacking.empty() ? "nothing" : escaped(lacking));
}

std::string settings_of_engine(const EngineInfo& e) {
  std::string html = "<h3>" + escaped(e.name) + "</h3>\n";
  if (e.settings.empty())
    return html + "<p class=\"soft small\">This engine has no settings: both profiles are the same.</p>\n";
  html +=
      "<div class=\"scroll\"><table><thead><tr><th>setting</th><th>default</th><th>matched</th><th>meaning</th></tr>"
      "</thead><tbody>\n";
  for (const Setting& s : e.settings) {
    html += fmt::format("<tr{}><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"text\">{}</td></tr>\n",
                        s.default_value == s.matched_value ? "" : " class=\"differs\"", escaped(s.name),
                        value_text(s.default_value, s.unit), value_text(s.matched_value, s.unit), escaped(s.meaning));
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string engines_html(const Report& report) {
  std::string html = "<section id=\"engines\">\n<h2>Engines</h2>\n";
  if (report.engines.empty()) {
    html += "<p class=\"soft\">No engine took part.</p>\n";
  } else {
    html +=
        "<div class=\"scroll\"><table><thead><tr><th>engine</th><th>library</th><th>version</th><th>precision</th>"
        "<th>lives in</th><th>integration scheme</th><th>velocities</th><th>lacks</th></tr></thead><tbody>\n";
    for (const EngineInfo& e : report.engines) html += engine_row(e);
    html += "</tbody></table></div>\n";
  }
  html += "<h3>Missing engines</h3>\n";
  if (report.missing_engines.empty()) {
    html += "<p class=\"soft\">None was reported missing.</p>\n";
  } else {
    html += "<ul>\n";
    for (const MissingEngine& m : report.missing_engines) {
      html += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(m.name), escaped(m.reason));
    }
    html += "</ul>\n";
  }
  html +=
      "</section>\n<section id=\"settings\">\n<h2>Settings of the two profiles</h2>\n"
      "<p><b>default</b> is what a user gets; <b>matched</b> makes the engine solve the problem that the scenario "
      "states. Rows in which the two differ are shaded.</p>\n";
  if (report.engines.empty()) html += "<p class=\"soft\">No engine took part.</p>\n";
  for (const EngineInfo& e : report.engines) html += settings_of_engine(e);
  return html + "</section>\n";
}

}  // namespace plumbline::reports
