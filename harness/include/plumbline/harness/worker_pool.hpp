// Runs in worker processes: several at once, each with a time limit, a dead worker replaced by a new one.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/harness/recording.hpp"
#include "plumbline/harness/worker_process.hpp"

namespace plumbline {

// How one request ended, whatever it asked for.
struct WorkerOutcome {
  enum class End { kAnswered, kCrashed, kTimedOut, kError } end = End::kError;
  std::string reason;    // when not answered
  std::string messages;  // what the engine printed, the last 64 KiB
};

struct RunOutcome : WorkerOutcome {
  Recording recording;  // when answered
  Settings settings;    // as the worker applied them
};

struct CallOutcome : WorkerOutcome {
  nlohmann::json result;  // when answered
};

struct RunRequest {
  std::size_t program = 0;  // index into the pool's programs
  std::string engine;
  Profile profile = Profile::kDefault;
  double dt = 0;
  const Scenario* scenario = nullptr;  // outlives the pool's run()
  const std::string* text = nullptr;
  std::string file;
  Settings changed = {};  // over those of the profile
};

// Any method whose answer is JSON alone.
struct CallRequest {
  std::size_t program = 0;
  std::string method;
  nlohmann::json params;
};

struct WorkerProgram {
  std::filesystem::path path;
  std::vector<EngineInfo> engines;  // its rows
  std::string problem;              // why it offers none; empty when all is well
};

class WorkerPool {
 public:
  using Seconds = std::chrono::duration<double>;

  // Asks every program for its engines. A program that does not answer is kept with its `problem`.
  explicit WorkerPool(const std::vector<std::filesystem::path>& programs, Seconds start_limit = Seconds(20));
  ~WorkerPool();

  const std::vector<WorkerProgram>& programs() const { return programs_; }

  // Runs all requests, `jobs` at once, in order as far as that allows. `done(i, outcome)` is called on this thread
  // as each ends. Stops handing out work once `stop` is set; runs under way then are dropped.
  void run(const std::vector<RunRequest>& requests, unsigned jobs, Seconds limit,
           const std::function<void(std::size_t, RunOutcome)>& done, const std::atomic<bool>& stop);
  // The same for calls.
  void call(const std::vector<CallRequest>& requests, unsigned jobs, Seconds limit,
            const std::function<void(std::size_t, CallOutcome)>& done, const std::atomic<bool>& stop);

 private:
  struct Busy;
  template <typename Request, typename Outcome>
  void exchange(const std::vector<Request>& requests, unsigned jobs, Seconds limit,
                const std::function<void(std::size_t, Outcome)>& done, const std::atomic<bool>& stop);
  std::unique_ptr<WorkerProcess> take(std::size_t program);
  void poll_once(std::vector<Busy>& busy, double longest_seconds);

  std::vector<WorkerProgram> programs_;
  std::vector<std::vector<std::unique_ptr<WorkerProcess>>> idle_;  // per program
};

}  // namespace plumbline
