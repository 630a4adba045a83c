// The main program of every engine worker: one adapter, the harness's server, and the scenario reader.
#include "plumbline/core/engine.hpp"
#include "plumbline/harness/worker_server.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

int main() {
  using namespace plumbline;
  return serve(make_engines(), [](const std::string& text, const std::string& file, const Parameters& parameters) {
    return read_problem(text, file, parameters);
  });
}
