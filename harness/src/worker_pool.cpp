#include "plumbline/harness/worker_pool.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <csignal>

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kNoRequest = static_cast<std::size_t>(-1);

Frame request_frame(std::size_t id, const std::string& method, nlohmann::json params) {
  return {{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}}, {}};
}

// What each kind of request sends, how large a block may answer it, and what is read from the answer.

Frame frame_of(const RunRequest& request, std::size_t id) {
  nlohmann::json parameters = nlohmann::json::object();
  for (const auto& [name, value] : request.scenario->parameters) parameters[name] = value;
  return request_frame(id, "run",
                       {{"engine", request.engine},
                        {"profile", profile_name(request.profile)},
                        {"dt", request.dt},
                        {"parameters", parameters},
                        {"scenario", *request.text},
                        {"file", request.file},
                        {"settings", to_json(request.changed)}});
}
Frame frame_of(const CallRequest& request, std::size_t id) { return request_frame(id, request.method, request.params); }

std::size_t answer_bytes(const RunRequest& request) {
  const Scenario& scenario = *request.scenario;
  return (scenario.step_count(request.dt) + 1) * scenario.bodies.size() * kStateDoubles * sizeof(double);
}
std::size_t answer_bytes(const CallRequest&) { return 0; }

void read_answer(const Frame& frame, const RunRequest& request, RunOutcome& outcome) {
  const auto& result = frame.json.at("result");
  outcome.recording.trajectory = unpack(frame.block, request.dt, request.scenario->bodies.size());
  if (outcome.recording.trajectory.samples() == 0) throw std::runtime_error("the trajectory is empty");
  outcome.recording.wall_seconds = result.at("wall_seconds");
  if (result.contains("critical")) outcome.recording.critical = {result["critical"].at(0), result["critical"].at(1)};
  if (result.contains("not_finite_at")) outcome.recording.not_finite_at = result["not_finite_at"].get<std::size_t>();
  outcome.settings = settings_from_json(result.at("settings"));
}
void read_answer(const Frame& frame, const CallRequest&, CallOutcome& outcome) {
  outcome.result = frame.json.at("result");
  if (!outcome.result.is_object()) throw std::runtime_error("the result is no object");
}

// What a program printed, as one line.
std::string one_line(std::string text) {
  text.erase(text.find_last_not_of(" \n\r\t") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// The outcome that an answer frame describes.
template <typename Request, typename Outcome>
void read_outcome(const Frame& frame, const Request& request, Outcome& outcome) {
  if (frame.json.contains("error")) {
    outcome.reason = frame.json["error"].value("message", "an error without a message");
    return;
  }
  read_answer(frame, request, outcome);
  outcome.end = Outcome::End::kAnswered;
}

}  // namespace

struct WorkerPool::Busy {
  std::unique_ptr<WorkerProcess> process;
  std::size_t program = 0;
  std::size_t request = kNoRequest;
  Clock::time_point deadline;
  bool ended = false;  // its output is at end of file
};

WorkerPool::~WorkerPool() {
  for (auto& workers : idle_) {
    for (auto& worker : workers) {
      worker->send({{{"jsonrpc", "2.0"}, {"method", "exit"}}, {}}, 0);
      worker->end(false);
    }
  }
}

WorkerPool::WorkerPool(const std::vector<std::filesystem::path>& programs, Seconds start_limit) {
  std::signal(SIGPIPE, SIG_IGN);  // a dead worker shows as end of file, not as our own death
  std::vector<Busy> starting;
  for (const auto& path : programs) {
    programs_.push_back({path, {}, ""});
    idle_.emplace_back();
    Busy worker;
    worker.program = programs_.size() - 1;
    worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(start_limit);
    try {
      worker.process = std::make_unique<WorkerProcess>(path);
      worker.process->send({{{"jsonrpc", "2.0"}, {"id", 0}, {"method", "initialize"}}, {}}, 0);
      starting.push_back(std::move(worker));
    } catch (const std::exception& e) {
      programs_.back().problem = e.what();
    }
  }
  while (!starting.empty()) {
    poll_once(starting, 0.1);
    std::erase_if(starting, [&](Busy& worker) {
      WorkerProgram& program = programs_[worker.program];
      try {
        if (const auto frame = worker.process->next_frame()) {
          const auto& result = frame->json.at("result");
          if (result.at("protocol") != kProtocolVersion) throw std::runtime_error("it speaks another protocol version");
          for (const auto& row : result.at("engines")) program.engines.push_back(engine_info_from_json(row));
          idle_[worker.program].push_back(std::move(worker.process));
          return true;
        }
      } catch (const std::exception& e) {
        program.problem = e.what();
        return true;
      }
      if (worker.ended) {
        program.problem = one_line(fmt::format("{}: {}", worker.process->end(false), worker.process->take_messages()));
      } else if (Clock::now() > worker.deadline) {
        program.problem = "it did not answer in time";
      } else {
        return false;
      }
      return true;
    });
  }
}

std::unique_ptr<WorkerProcess> WorkerPool::take(std::size_t program) {
  auto& idle = idle_[program];
  if (idle.empty()) return std::make_unique<WorkerProcess>(programs_[program].path);
  auto worker = std::move(idle.back());
  idle.pop_back();
  return worker;
}

void WorkerPool::poll_once(std::vector<Busy>& busy, double longest_seconds) {
  std::vector<pollfd> fds;
  for (const Busy& worker : busy) {
    fds.push_back({worker.process->output(), POLLIN, 0});
    fds.push_back({worker.process->messages(), POLLIN, 0});
    // A negative descriptor is skipped by poll.
    fds.push_back({worker.process->wants_to_write() ? worker.process->input() : -1, POLLOUT, 0});
  }
  poll(fds.data(), fds.size(), static_cast<int>(longest_seconds * 1000) + 1);
  for (std::size_t i = 0; i < busy.size(); ++i) {
    WorkerProcess& process = *busy[i].process;
    if (fds[3 * i + 2].revents != 0) process.write_some();
    if (fds[3 * i].revents != 0) busy[i].ended = !process.read_output();
    process.read_messages();
  }
}

template <typename Request, typename Outcome>
void WorkerPool::exchange(const std::vector<Request>& requests, unsigned jobs, Seconds limit,
                          const std::function<void(std::size_t, Outcome)>& done, const std::atomic<bool>& stop) {
  using End = typename Outcome::End;
  std::vector<Busy> busy;
  std::size_t next = 0;

  const auto start_next = [&] {
    const std::size_t index = next++;
    const Request& request = requests[index];
    try {
      Busy worker;
      worker.process = take(request.program);
      worker.program = request.program;
      worker.request = index;
      worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
      worker.process->send(frame_of(request, index), answer_bytes(request));
      busy.push_back(std::move(worker));
    } catch (const std::exception& e) {
      Outcome outcome;
      outcome.reason = e.what();
      done(index, std::move(outcome));
    }
  };

  // The outcome when that worker's request is over, by an answer, by its death or by the clock.
  const auto finished = [&](Busy& worker) -> std::optional<Outcome> {
    Outcome outcome;
    try {
      if (const auto frame = worker.process->next_frame()) {
        read_outcome(*frame, requests[worker.request], outcome);
        outcome.messages = worker.process->take_messages();
        idle_[worker.program].push_back(std::move(worker.process));
        return outcome;
      }
    } catch (const std::exception& e) {
      outcome = {};
      outcome.reason = fmt::format("the worker broke the protocol: {}", e.what());
      outcome.messages = worker.process->take_messages();
      return outcome;
    }
    if (worker.ended) {
      outcome.end = End::kCrashed;
      outcome.reason = worker.process->end(false);
    } else if (Clock::now() >= worker.deadline) {
      outcome.end = End::kTimedOut;
      outcome.reason = fmt::format("no answer within {} s", limit.count());
    } else {
      return std::nullopt;
    }
    worker.process->read_messages();
    outcome.messages = worker.process->take_messages();
    return outcome;
  };

  while (!stop && (next < requests.size() || !busy.empty())) {
    while (busy.size() < jobs && next < requests.size()) start_next();
    if (busy.empty()) continue;
    const auto nearest = std::min_element(busy.begin(), busy.end(), [](const Busy& a, const Busy& b) {
                           return a.deadline < b.deadline;
                         })->deadline;
    const double wait = std::chrono::duration<double>(nearest - Clock::now()).count();
    poll_once(busy, std::clamp(wait, 0.0, 0.2));
    // Results first, then the callbacks, which may take long: the workers should already be busy again.
    std::vector<std::pair<std::size_t, Outcome>> over;
    std::erase_if(busy, [&](Busy& worker) {
      auto outcome = finished(worker);
      if (!outcome) return false;
      over.emplace_back(worker.request, std::move(*outcome));
      return true;
    });
    while (busy.size() < jobs && next < requests.size() && !stop) start_next();
    for (auto& [index, outcome] : over) done(index, std::move(outcome));
  }
}

void WorkerPool::run(const std::vector<RunRequest>& requests, unsigned jobs, Seconds limit,
                     const std::function<void(std::size_t, RunOutcome)>& done, const std::atomic<bool>& stop) {
  exchange(requests, jobs, limit, done, stop);
}

void WorkerPool::call(const std::vector<CallRequest>& requests, unsigned jobs, Seconds limit,
                      const std::function<void(std::size_t, CallOutcome)>& done, const std::atomic<bool>& stop) {
  exchange(requests, jobs, limit, done, stop);
}

}  // namespace plumbline
