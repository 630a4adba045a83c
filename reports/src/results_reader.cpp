#include <cerrno>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "plumbline/reports/results_json.hpp"

namespace plumbline {
namespace {

using Json = nlohmann::ordered_json;

// The member, or an error that names it.
const Json& member(const Json& object, const char* key) {
  if (!object.is_object()) throw std::runtime_error("an object was expected");
  const auto found = object.find(key);
  if (found == object.end()) throw std::runtime_error(std::string("/") + key + " is missing");
  return *found;
}

template <typename Read>
auto at(const std::string& place, Read read) {
  try {
    return read();
  } catch (const std::exception& error) {
    const std::string what = error.what();
    throw std::runtime_error("/" + place + (what.starts_with('/') ? "" : ": ") + what);
  }
}

std::optional<double> non_finite(const Json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return infinity;
  if (text == "-inf") return -infinity;
  return std::nullopt;
}

double to_number(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (const auto special = non_finite(value)) return *special;
  throw std::runtime_error("a number, \"nan\", \"inf\" or \"-inf\" was expected, found " + value.dump());
}

double number(const Json& object, const char* key) {
  const Json& value = member(object, key);
  return at(key, [&] { return to_number(value); });
}

template <typename T>
T plain(const Json& object, const char* key, bool (Json::*is_type)() const noexcept, const char* type) {
  const Json& value = member(object, key);
  if (!(value.*is_type)()) throw std::runtime_error(std::string("/") + key + ": " + type + " was expected");
  return value.get<T>();
}
std::string text(const Json& object, const char* key) {
  return plain<std::string>(object, key, &Json::is_string, "a text");
}
bool flag(const Json& object, const char* key) { return plain<bool>(object, key, &Json::is_boolean, "true or false"); }
int integer(const Json& object, const char* key) {
  return plain<int>(object, key, &Json::is_number_integer, "a whole number");
}

// Reads each element of an array member; an error names the element.
template <typename Read>
auto list(const Json& object, const char* key, Read read) {
  const Json& array = member(object, key);
  if (!array.is_array()) throw std::runtime_error(std::string("/") + key + ": a list was expected");
  std::vector<std::invoke_result_t<Read, const Json&>> items;
  items.reserve(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) {
    items.push_back(at(key + ("/" + std::to_string(i)), [&] { return read(array[i]); }));
  }
  return items;
}

std::string to_text(const Json& value) {
  if (!value.is_string()) throw std::runtime_error("a text was expected");
  return value.get<std::string>();
}

// Calls read(key, value) for each member of an object member.
template <typename Read>
void each_member(const Json& object, const char* key, Read read) {
  const Json& members = member(object, key);
  if (!members.is_object()) throw std::runtime_error(std::string("/") + key + ": an object was expected");
  for (const auto& [name, value] : members.items()) {
    at(std::string(key) + "/" + name, [&, &n = name, &v = value] {
      read(n, v);
      return 0;
    });
  }
}

template <typename Pairs>
Pairs named_numbers(const Json& object, const char* key) {
  Pairs pairs;
  each_member(object, key, [&](const std::string& name, const Json& v) { pairs.emplace_back(name, to_number(v)); });
  return pairs;
}

SettingValue to_setting(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>();
  if (const auto special = non_finite(value)) return *special;
  return to_text(value);
}

Profile profile(const Json& object) {
  const std::string name = text(object, "profile");
  for (const Profile p : {Profile::kDefault, Profile::kMatched}) {
    if (profile_name(p) == name) return p;
  }
  throw std::runtime_error("/profile: \"default\" or \"matched\" was expected, found \"" + name + "\"");
}

Verdict verdict(const Json& object) {
  const std::string name = text(object, "verdict");
  const auto known = verdict_named(name);
  if (!known) throw std::runtime_error("/verdict: no verdict is called \"" + name + "\"");
  return *known;
}

Feature to_feature(const Json& value) {
  const std::string name = to_text(value);
  for (std::size_t i = 0; i < kFeatureCount; ++i) {
    if (feature_name(static_cast<Feature>(i)) == name) return static_cast<Feature>(i);
  }
  throw std::runtime_error("no feature is called \"" + name + "\"");
}

EngineInfo to_engine(const Json& j) {
  EngineInfo e;
  e.name = text(j, "name");
  e.library = text(j, "library");
  e.version = text(j, "version");
  const std::string precision = text(j, "precision");
  if (precision != "single" && precision != "double") {
    throw std::runtime_error("/precision: \"single\" or \"double\" was expected, found \"" + precision + "\"");
  }
  e.precision = precision == "single" ? Precision::kSingle : Precision::kDouble;
  e.dimension = integer(j, "dimension");
  e.scheme = text(j, "scheme");
  e.velocity_offset = number(j, "velocity_offset");
  for (const Feature f : list(j, "features", to_feature)) e.features.insert(f);
  e.settings = list(j, "settings", [](const Json& s) {
    return Setting{text(s, "name"), to_setting(member(s, "default")), to_setting(member(s, "matched")), text(s, "unit"),
                   text(s, "meaning")};
  });
  return e;
}

ScenarioSummary to_scenario(const Json& j) {
  return {text(j, "id"),
          text(j, "about"),
          text(j, "source"),
          text(j, "file"),
          text(j, "reference_kind"),
          text(j, "citation"),
          list(j, "cases", to_text),
          list(j, "steps", to_number)};
}

GateResult to_gate(const Json& j) {
  const Json& place = member(j, "place");
  return {text(j, "metric"),
          number(j, "value"),
          number(j, "limit"),
          flag(j, "passed"),
          text(j, "reason"),
          text(j, "deviation"),
          at("place", [&] {
            return SourcePlace{text(place, "file"), integer(place, "line"), integer(place, "column")};
          })};
}

CurvePoint to_point(const Json& j) {
  if (!j.is_array() || j.size() != 2) throw std::runtime_error("a pair [t, error] was expected");
  return {to_number(j[0]), to_number(j[1])};
}

Explanation to_explanation(const Json& j) { return {text(j, "scheme"), number(j, "distance"), number(j, "share")}; }

RunResult to_run(const Json& j) {
  RunResult r;
  r.scenario = text(j, "scenario");
  r.case_name = text(j, "case");
  r.parameters = named_numbers<Parameters>(j, "parameters");
  r.engine = text(j, "engine");
  r.profile = profile(j);
  r.dt = number(j, "dt");
  r.verdict = verdict(j);
  r.reason = text(j, "reason");
  r.notes = list(j, "notes", to_text);
  r.metrics = named_numbers<decltype(r.metrics)>(j, "metrics");
  r.gates = list(j, "gates", to_gate);
  const Json& explanation = member(j, "explanation");
  r.explanation = at("explanation", [&] { return to_explanation(explanation); });
  each_member(j, "settings", [&](const std::string& name, const Json& v) { r.settings[name] = to_setting(v); });
  r.wall_seconds = number(j, "wall_seconds");
  r.messages = text(j, "messages");
  r.trajectory = text(j, "trajectory");
  r.curve = list(j, "curve", to_point);
  return r;
}

Convergence to_convergence(const Json& j) {
  const int points = integer(j, "points");
  if (points < 0) throw std::runtime_error("/points must be >= 0");
  return {text(j, "case"),   text(j, "engine"),  profile(j),
          text(j, "metric"), number(j, "order"), static_cast<std::size_t>(points),
          text(j, "note")};
}

Divergence to_divergence(const Json& j) {
  Divergence d{text(j, "case"), profile(j), number(j, "dt"), list(j, "engines", to_text),
               list(j, "distance", to_number)};
  if (d.distance.size() != d.engines.size() * d.engines.size()) {
    throw std::runtime_error("/distance: " + std::to_string(d.engines.size()) + " engines need their square of values");
  }
  return d;
}

ConformanceCheck to_check(const Json& j) {
  return {text(j, "name"), text(j, "theme"), text(j, "question"), text(j, "tolerance"), flag(j, "matched_only")};
}

ConformanceResult to_conformance(const Json& j) {
  return {text(j, "engine"), profile(j),     text(j, "check"),   verdict(j),
          text(j, "text"),   text(j, "why"), text(j, "messages")};
}

Report to_report(const Json& j) {
  const auto schema = j.is_object() ? j.find("schema") : j.end();
  if (schema == j.end() || !schema->is_string()) {
    throw std::runtime_error(
        "is no results file: it has no \"schema\". Pass the results.json of `plumbline run -o DIR`");
  }
  if (*schema != kResultsSchema) {
    throw std::runtime_error("has the schema \"" + schema->get<std::string>() + "\", this program reads \"" +
                             std::string(kResultsSchema) +
                             "\". Read it with the version of plumbline that wrote it, or make it anew with "
                             "`plumbline run -o DIR`");
  }
  Report report;
  const Json& tool = member(j, "tool");
  report.tool_version = at("tool", [&] { return text(tool, "version"); });
  each_member(j, "environment",
              [&](const std::string& name, const Json& v) { report.environment.emplace_back(name, to_text(v)); });
  report.wall_seconds = number(j, "wall_seconds");
  report.interrupted = flag(j, "interrupted");
  report.engines = list(j, "engines", to_engine);
  report.missing_engines = list(j, "missing_engines", [](const Json& m) {
    return MissingEngine{text(m, "name"), text(m, "reason")};
  });
  report.scenarios = list(j, "scenarios", to_scenario);
  report.runs = list(j, "runs", to_run);
  report.convergence = list(j, "convergence", to_convergence);
  report.divergence = list(j, "divergence", to_divergence);
  // Files that were written before there was a kit have no such members.
  if (j.contains("conformance_checks")) report.conformance_checks = list(j, "conformance_checks", to_check);
  if (j.contains("conformance")) report.conformance = list(j, "conformance", to_conformance);
  return report;
}

}  // namespace

Report read_results(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    const std::string cause =
        std::filesystem::is_directory(path) ? "is a folder" : std::generic_category().message(errno);
    throw std::runtime_error(path.string() + ": cannot be read: " + cause +
                             ". Pass the results.json of `plumbline run -o DIR`");
  }
  std::ostringstream content;
  content << file.rdbuf();
  Json document;
  try {
    document = Json::parse(std::move(content).str());
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(path.string() + ": is not JSON, or was cut short at byte " + std::to_string(error.byte) +
                             ". Make it anew with `plumbline run -o DIR`");
  }
  try {
    return to_report(document);
  } catch (const std::exception& error) {
    const std::string what = error.what();
    const std::string way_out = what.starts_with('/') ? ". Make it anew with `plumbline run -o DIR`" : "";
    throw std::runtime_error(path.string() + ": " + what + way_out);
  }
}

}  // namespace plumbline
