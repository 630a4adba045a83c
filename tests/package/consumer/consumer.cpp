// A program outside the project: reads a scenario with its truth and asks where the body is after one second.
#include <cmath>
#include <cstdio>
#include <plumbline/scenarios/scenario_file.hpp>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto cases = plumbline::read_scenario_file(std::string(argv[1]) + "/particle/falling_box.toml");
  const double height = cases.front().reference->at(0, 1.0).p_WB.z();
  std::printf("height after 1 s: %g m\n", height);
  // Slide 8, mapped to z up: 5 m, 3 m/s upwards, 9.8 N on 1 kg.
  return std::abs(height - (5 + 3 - 4.9)) < 1e-12 ? 0 : 1;
}
