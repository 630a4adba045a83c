// The main program of every engine worker: one adapter, the harness's server, and the scenario reader.
#include <stdexcept>

#include "plumbline/core/engine.hpp"
#include "plumbline/harness/worker_server.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

int main() {
  using namespace plumbline;
  const auto source = [](const std::string& text, const std::string& file, const Parameters& parameters) {
    Overrides overrides;
    for (const auto& [name, value] : parameters) overrides[name] = {value};
    auto cases = read_scenario(text, file, overrides);
    if (cases.size() != 1) throw std::invalid_argument(file + ": the parameters do not single out one case");
    return std::move(cases.front().scenario);
  };
  return serve(make_engines(), source);
}
