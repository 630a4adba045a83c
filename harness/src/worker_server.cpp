#include "plumbline/harness/worker_server.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "plumbline/harness/conformance.hpp"
#include "plumbline/harness/recording.hpp"
#include "plumbline/harness/wire.hpp"

namespace plumbline {
namespace {

using nlohmann::json;

// Keeps fd 1 for frames under another number and lets everything that prints go to standard error.
int take_over_stdout() {
  const int frames = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (frames < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot set standard output aside");
  }
  setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  return frames;
}

// False when the other side is gone.
bool write_all(int fd, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = write(fd, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

const Engine& engine_named(const std::vector<std::unique_ptr<Engine>>& engines, const std::string& name) {
  for (const auto& engine : engines) {
    if (engine->info().name == name) return *engine;
  }
  throw std::invalid_argument("this worker has no engine '" + name + "'");
}

Profile profile_of(const json& params) {
  const std::string name = params.at("profile");
  for (Profile profile : {Profile::kDefault, Profile::kMatched}) {
    if (name == profile_name(profile)) return profile;
  }
  throw std::invalid_argument("there is no profile '" + name + "'");
}

Frame answer_run(const json& params, const std::vector<std::unique_ptr<Engine>>& engines,
                 const ScenarioSource& source) {
  const Engine& engine = engine_named(engines, params.at("engine"));
  const Profile profile = profile_of(params);
  Parameters parameters;
  for (const auto& [name, value] : params.at("parameters").items()) parameters.emplace_back(name, value);
  const Scenario scenario = source(params.at("scenario"), params.at("file"), parameters);
  Settings settings = settings_of(engine.info(), profile);
  for (const auto& [name, value] : settings_from_json(params.value("settings", json::object()))) settings[name] = value;
  const Recording recording = record(engine, scenario, settings, params.at("dt"));

  Frame frame;
  frame.block = pack(recording.trajectory);
  frame.json["result"] = {{"dtype", "<f8"},
                          {"shape", {recording.trajectory.samples(), recording.trajectory.bodies(), kStateDoubles}},
                          {"settings", to_json(settings)},
                          {"wall_seconds", recording.wall_seconds}};
  if (recording.critical) frame.json["result"]["critical"] = {recording.critical->no, recording.critical->yes};
  if (recording.not_finite_at) frame.json["result"]["not_finite_at"] = *recording.not_finite_at;
  return frame;
}

Frame answer_conformance_list() {
  json names = json::array();
  for (const ConformanceCheck& check : conformance_checks()) names.push_back(check.name);
  return {{{"result", {{"checks", names}}}}, {}};
}

Frame answer_conformance_run(const json& params, const std::vector<std::unique_ptr<Engine>>& engines) {
  const ConformanceAnswer found =
      ask(params.at("check").get<std::string>(), engine_named(engines, params.at("engine")), profile_of(params));
  static constexpr const char* kWords[] = {"holds", "broken", "not_asked"};
  return {{{"result", {{"outcome", kWords[static_cast<std::size_t>(found.kind)]}, {"text", found.text}}}}, {}};
}

Frame answer(const json& request, const std::vector<std::unique_ptr<Engine>>& engines, const ScenarioSource& source) {
  const std::string method = request.at("method");
  if (method == "initialize") {
    json rows = json::array();
    for (const auto& engine : engines) rows.push_back(to_json(engine->info()));
    return {{{"result", {{"protocol", kProtocolVersion}, {"engines", rows}}}}, {}};
  }
  if (method == "run") return answer_run(request.at("params"), engines, source);
  if (method == "conformance.list") return answer_conformance_list();
  if (method == "conformance.run") return answer_conformance_run(request.at("params"), engines);
  return {{{"error", {{"code", -32601}, {"message", "unknown method '" + method + "'"}}}}, {}};
}

}  // namespace

int serve(const std::vector<std::unique_ptr<Engine>>& engines, const ScenarioSource& source) {
  std::signal(SIGPIPE, SIG_IGN);
  const int out = take_over_stdout();
  FrameReader reader;
  char buffer[1 << 16];
  while (true) {
    std::optional<Frame> request;
    try {
      request = reader.next();
    } catch (const std::exception& e) {
      std::fprintf(stderr, "worker: %s\n", e.what());
      return 1;
    }
    if (!request) {
      const ssize_t n = read(STDIN_FILENO, buffer, sizeof buffer);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return 0;
      reader.feed({buffer, static_cast<std::size_t>(n)});
      continue;
    }
    Frame reply;
    if (request->json.value("method", "") == "exit") return 0;
    try {
      reply = answer(request->json, engines, source);
    } catch (const std::exception& e) {
      reply = {{{"error", {{"code", -32000}, {"message", e.what()}}}}, {}};
    }
    reply.json["jsonrpc"] = "2.0";
    reply.json["id"] = request->json.value("id", json());
    std::fflush(stdout);  // what the engine printed must not arrive after the answer
    if (!write_all(out, encode(reply))) return 0;
  }
}

}  // namespace plumbline
