#include <cmath>
#include <nlohmann/json.hpp>

#include "plumbline/reports/results_json.hpp"
#include "text_file.hpp"

namespace plumbline {
namespace {

using Json = nlohmann::ordered_json;  // keeps the order of metrics and of keys

Json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

Json numbers(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double v : values) array.push_back(number(v));
  return array;
}

template <typename Pairs>
Json object_of_numbers(const Pairs& pairs) {
  Json object = Json::object();
  for (const auto& [key, value] : pairs) object[key] = number(value);
  return object;
}

Json setting_value(const SettingValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return number(std::get<double>(value));
}

Json feature_names(const FeatureSet& features) {
  Json array = Json::array();
  for (std::size_t i = 0; i < kFeatureCount; ++i) {
    const auto feature = static_cast<Feature>(i);
    if (features.contains(feature)) array.push_back(feature_name(feature));
  }
  return array;
}

Json engine_json(const EngineInfo& e) {
  Json settings = Json::array();
  for (const Setting& s : e.settings) {
    settings.push_back({{"name", s.name},
                        {"default", setting_value(s.default_value)},
                        {"matched", setting_value(s.matched_value)},
                        {"unit", s.unit},
                        {"meaning", s.meaning}});
  }
  return {{"name", e.name},
          {"library", e.library},
          {"version", e.version},
          {"precision", e.precision == Precision::kSingle ? "single" : "double"},
          {"dimension", e.dimension},
          {"scheme", e.scheme},
          {"velocity_offset", number(e.velocity_offset)},
          {"features", feature_names(e.features)},
          {"settings", std::move(settings)}};
}

Json scenario_json(const ScenarioSummary& s) {
  return {{"id", s.id},
          {"about", s.about},
          {"source", s.source},
          {"file", s.file},
          {"reference_kind", s.reference_kind},
          {"citation", s.citation},
          {"cases", s.cases},
          {"steps", numbers(s.steps)}};
}

Json gate_json(const GateResult& g) {
  return {{"metric", g.metric},
          {"value", number(g.value)},
          {"limit", number(g.limit)},
          {"passed", g.passed},
          {"reason", g.reason},
          {"deviation", g.deviation},
          {"place", {{"file", g.place.file}, {"line", g.place.line}, {"column", g.place.column}}}};
}

Json run_json(const RunResult& r) {
  Json gates = Json::array();
  for (const GateResult& g : r.gates) gates.push_back(gate_json(g));
  Json settings = Json::object();
  for (const auto& [name, value] : r.settings) settings[name] = setting_value(value);
  Json curve = Json::array();
  for (const CurvePoint& p : r.curve) curve.push_back(Json::array({number(p.t), number(p.error)}));
  return {{"scenario", r.scenario},
          {"case", r.case_name},
          {"parameters", object_of_numbers(r.parameters)},
          {"engine", r.engine},
          {"profile", profile_name(r.profile)},
          {"dt", number(r.dt)},
          {"verdict", verdict_name(r.verdict)},
          {"reason", r.reason},
          {"notes", r.notes},
          {"metrics", object_of_numbers(r.metrics)},
          {"gates", std::move(gates)},
          {"explanation",
           {{"scheme", r.explanation.scheme},
            {"distance", number(r.explanation.distance)},
            {"share", number(r.explanation.share)}}},
          {"settings", std::move(settings)},
          {"wall_seconds", number(r.wall_seconds)},
          {"messages", r.messages},
          {"trajectory", r.trajectory},
          {"curve", std::move(curve)}};
}

Json convergence_json(const Convergence& c) {
  return {{"case", c.case_name}, {"engine", c.engine},       {"profile", profile_name(c.profile)},
          {"metric", c.metric},  {"order", number(c.order)}, {"points", c.points},
          {"note", c.note}};
}

Json divergence_json(const Divergence& d) {
  return {{"case", d.case_name},
          {"profile", profile_name(d.profile)},
          {"dt", number(d.dt)},
          {"engines", d.engines},
          {"distance", numbers(d.distance)}};
}

Json check_json(const ConformanceCheck& c) {
  return {{"name", c.name},
          {"theme", c.theme},
          {"question", c.question},
          {"tolerance", c.tolerance},
          {"matched_only", c.matched_only}};
}

Json conformance_json(const ConformanceResult& r) {
  return {{"engine", r.engine},    {"profile", profile_name(r.profile)},
          {"check", r.check},      {"verdict", verdict_name(r.verdict)},
          {"text", r.text},        {"why", r.why},
          {"messages", r.messages}};
}

// What an engine printed need not be UTF-8; JSON must be.
std::string dump(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

class Document {
 public:
  void member(std::string_view key, const Json& value) { key_is(key) += dump(value); }

  // One element a line.
  template <typename T>
  void members(std::string_view key, const std::vector<T>& items, Json (*to_json)(const T&)) {
    std::string& text = key_is(key);
    text += '[';
    for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "\n  " : ",\n  ") + dump(to_json(items[i]));
    text += items.empty() ? "]" : "\n ]";
  }

  std::string finished() && { return std::move(text_) + "\n}\n"; }

 private:
  std::string& key_is(std::string_view key) {
    text_ += text_.empty() ? "{\n \"" : ",\n \"";
    return (text_ += key) += "\": ";
  }
  std::string text_;
};

}  // namespace

std::string results_json(const Report& report) {
  Json environment = Json::object();
  for (const auto& [key, value] : report.environment) environment[key] = value;
  Document document;
  document.member("schema", kResultsSchema);
  document.member("tool", {{"name", "plumbline"}, {"version", report.tool_version}});
  document.member("environment", environment);
  document.member("wall_seconds", number(report.wall_seconds));
  document.member("interrupted", report.interrupted);
  document.members("engines", report.engines, engine_json);
  document.members(
      "missing_engines", report.missing_engines, +[](const MissingEngine& m) -> Json {
        return {{"name", m.name}, {"reason", m.reason}};
      });
  document.members("scenarios", report.scenarios, scenario_json);
  document.members("runs", report.runs, run_json);
  document.members("convergence", report.convergence, convergence_json);
  document.members("divergence", report.divergence, divergence_json);
  document.members("conformance_checks", report.conformance_checks, check_json);
  document.members("conformance", report.conformance, conformance_json);
  return std::move(document).finished();
}

void write_results(const Report& report, const std::filesystem::path& path) {
  reports::replace_file(path, results_json(report));
}

}  // namespace plumbline
