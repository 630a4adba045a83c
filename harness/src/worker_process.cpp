#include "plumbline/harness/worker_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

namespace plumbline {
namespace {

constexpr std::size_t kKeptMessages = std::size_t{64} << 10;

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int fds[2];
    if (pipe2(fds, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    read = fds[0];
    write = fds[1];
  }
  ~Pipe() {
    if (read >= 0) close(read);
    if (write >= 0) close(write);
  }
  int take_read() { return std::exchange(read, -1); }
  int take_write() { return std::exchange(write, -1); }
};

int non_blocking(int fd) {
  fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
  return fd;
}

// Reads what is there. False at end of file.
template <typename Take>
bool drain(int fd, const Take& take) {
  char buffer[1 << 16];
  while (true) {
    const ssize_t n = read(fd, buffer, sizeof buffer);
    if (n > 0) {
      take(std::span<const char>(buffer, static_cast<std::size_t>(n)));
    } else if (n == 0) {
      return false;
    } else if (errno != EINTR) {
      return errno == EAGAIN;
    }
  }
}

}  // namespace

WorkerProcess::WorkerProcess(const std::filesystem::path& program) {
  Pipe in, out, err;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write, STDERR_FILENO);
  // A group of its own: Ctrl-C in the terminal reaches the harness alone, which then ends its workers in order.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string path = program.string();
  char* argv[] = {path.data(), nullptr};
  const int error = posix_spawn(&pid_, path.c_str(), &actions, &attributes, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) {
    pid_ = -1;
    throw std::system_error(error, std::generic_category(), "cannot start " + path);
  }
  input_ = non_blocking(in.take_write());
  output_ = non_blocking(out.take_read());
  errors_ = non_blocking(err.take_read());
}

WorkerProcess::~WorkerProcess() {
  end(true);
  for (int fd : {input_, output_, errors_}) {
    if (fd >= 0) close(fd);
  }
}

void WorkerProcess::send(const Frame& frame, std::size_t max_answer_block) {
  reader_.allow_block(max_answer_block);
  outbox_ += encode(frame);
  write_some();
}

void WorkerProcess::write_some() {
  while (!outbox_.empty()) {
    const ssize_t n = write(input_, outbox_.data(), outbox_.size());
    if (n > 0) {
      outbox_.erase(0, static_cast<std::size_t>(n));
    } else if (errno == EPIPE) {
      outbox_.clear();  // it died: the end of its output will say so
    } else if (errno != EINTR) {
      return;
    }
  }
}

bool WorkerProcess::read_output() {
  return drain(output_, [&](std::span<const char> bytes) { reader_.feed(bytes); });
}

void WorkerProcess::read_messages() {
  drain(errors_, [&](std::span<const char> bytes) {
    messages_text_.append(bytes.data(), bytes.size());
    if (messages_text_.size() > kKeptMessages) messages_text_.erase(0, messages_text_.size() - kKeptMessages);
  });
}

std::string WorkerProcess::end(bool kill_it) {
  if (pid_ < 0) return "";
  int status = 0;
  bool gone = false;
  // A worker that closed its output is about to end; one that lingers all the same is not waited for.
  for (int i = 0; !kill_it && !gone && i < 100; ++i) {
    gone = waitpid(pid_, &status, WNOHANG) == pid_;
    if (!gone) usleep(10'000);
  }
  if (!gone) {
    kill(-pid_, SIGKILL);  // its whole group
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  pid_ = -1;
  if (WIFSIGNALED(status)) {
    return "killed by signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
  }
  return "exited with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace plumbline
