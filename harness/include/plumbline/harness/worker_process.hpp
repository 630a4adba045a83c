// One worker process and the pipes to it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "plumbline/harness/wire.hpp"

namespace plumbline {

class WorkerProcess {
 public:
  // Starts the program. Throws std::system_error when it cannot be started.
  explicit WorkerProcess(const std::filesystem::path& program);
  ~WorkerProcess();  // kills what still runs
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  int output() const { return output_; }    // to poll: frames
  int messages() const { return errors_; }  // to poll: what the engine prints
  int input() const { return input_; }
  bool wants_to_write() const { return !outbox_.empty(); }

  void send(const Frame& frame, std::size_t max_answer_block);
  void write_some();
  // False at end of file.
  bool read_output();
  void read_messages();
  std::optional<Frame> next_frame() { return reader_.next(); }
  std::string take_messages() { return std::exchange(messages_text_, {}); }

  // Stops it for good and tells how it ended: "killed by signal 11 (Segmentation fault)", "exited with status 1".
  std::string end(bool kill_it);

 private:
  pid_t pid_ = -1;
  int input_ = -1, output_ = -1, errors_ = -1;
  std::string outbox_;
  FrameReader reader_;
  std::string messages_text_;
};

}  // namespace plumbline
