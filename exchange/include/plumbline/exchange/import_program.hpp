// The frame of the programs plumbline-import-*: each links one foreign library, reads one file, and says what it found.
//
// They are programs of their own since those libraries share a process badly with others, and since a hostile file may
// take one down: then only an import has failed. Answer on stdout, one JSON object:
//   {"scenario": "<scenario file>", "losses": [...], "notes": [...]}   exit code 0
//   {"error": "file:line: what is wrong"}                              exit code 2: the file cannot be used
// Whatever the library itself prints goes to stderr.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "plumbline/exchange/world_draft.hpp"

namespace plumbline {

struct ImportRequest {
  std::filesystem::path file;
  std::optional<double> duration;       // of the scenario [s]
  std::optional<std::string> keyframe;  // of MJCF; "none": the model's own start
};

// `read` throws std::exception with a message for people when the file cannot be used at all.
int import_program(int argc, char** argv, WorldDraft (*read)(const ImportRequest&));

}  // namespace plumbline
