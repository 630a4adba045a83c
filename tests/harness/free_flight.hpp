// A case every fake engine can run: a ball in free flight for one second, with a gate that a first-order scheme holds.
#pragma once

#include <memory>
#include <string>

#include "plumbline/harness/plan.hpp"
#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline::testing_support {

inline const std::string kFreeFlight = R"(
id = "test/free_flight"
about = "a ball in free flight"
source = "test"
duration = 1.0
steps = [0.004, 0.002, 0.001]
gravity = [0, 0, "-g"]
[parameters]
g = 9.81
[scales]
length = 5
time = 1
mass = 1
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1
position = [1, 0, 5]
velocity = [2, 1, 3]
[reference]
kind = "closed_form"
ball.x = "1 + 2*t"
ball.y = "t"
ball.z = "5 + 3*t - g*t^2/2"
ball.vz = "3 - g*t"
[[gate]]
metric = "position.max"
limit = "1.0001 * g*duration*dt/2 + 1e-12"
reason = "a semi-implicit step moves with the velocity of its end: g t dt/2 too low"
)";

inline CaseInput free_flight() {
  auto cases = read_scenario(kFreeFlight, "free_flight.toml");
  return {cases.at(0).scenario, cases.at(0).reference, std::make_shared<std::string>(kFreeFlight), "free_flight.toml"};
}

}  // namespace plumbline::testing_support
