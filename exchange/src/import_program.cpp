#include "plumbline/exchange/import_program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "plumbline/exchange/scenario_text.hpp"

namespace plumbline {
namespace {

constexpr int kUnusable = 2;

// Names become names of folders: small letters, digits and _.
std::string word(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool kept = (lower >= 'a' && lower <= 'z') || (lower >= '0' && lower <= '9');
    if (kept || (!result.empty() && result.back() != '_')) result += kept ? lower : '_';
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  return result.empty() ? "world" : result;
}

nlohmann::json answer_to(const ImportRequest& request, WorldDraft (*read)(const ImportRequest&)) {
  WorldDraft draft = read(request);
  if (request.duration) draft.duration = request.duration;
  ImportedWorld world = assemble(draft);
  Scenario& s = world.scenario;
  const std::string file = request.file.filename().string();
  s.id = "imported/" + word(request.file.stem().string());
  s.about =
      draft.title.empty() ? "A world imported from " + draft.format : draft.title + ", imported from " + draft.format;
  s.source = file;
  if (s.bodies.empty()) world.losses.emplace_back("nothing that is left has a body");
  std::vector<std::string> comments = {"Imported from " + file + " (" + draft.format + ") by plumbline import."};
  for (const std::string& loss : world.losses) comments.push_back("LOST: " + loss);
  for (const std::string& note : world.notes) comments.push_back("note: " + note);
  return {{"scenario", scenario_text(s, comments)}, {"losses", world.losses}, {"notes", world.notes}};
}

// Text from a foreign file need not be UTF-8.
std::string dumped(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool write_all(int fd, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(fd, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return true;
}

std::optional<ImportRequest> request_of(int argc, char** argv) {
  ImportRequest request;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--keyframe" && i + 1 < argc) {
      request.keyframe = argv[++i];
    } else if (argument == "--duration" && i + 1 < argc) {
      request.duration = std::atof(argv[++i]);
    } else if (request.file.empty()) {
      request.file = argument;
    } else {
      return std::nullopt;
    }
  }
  if (request.file.empty()) return std::nullopt;
  return request;
}

}  // namespace

int import_program(int argc, char** argv, WorldDraft (*read)(const ImportRequest&)) {
  const auto request = request_of(argc, argv);
  if (!request) {
    std::fprintf(stderr, "usage: %s [--keyframe NAME] [--duration SECONDS] FILE   (called by plumbline import)\n",
                 argv[0]);
    return kUnusable;
  }
  // The answer has stdout to itself.
  const int answer = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  try {
    return write_all(answer, dumped(answer_to(*request, read))) ? 0 : 3;
  } catch (const std::exception& e) {
    write_all(answer, dumped({{"error", e.what()}}));
    return kUnusable;
  }
}

}  // namespace plumbline
