// The in-house core moves literal scenarios to the same bits, whatever the optimiser does. This program is built more
// than once, together with the core's sources, at different levels of optimisation.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>

#include "kinetic_scenes.hpp"
#include "plumbline/core/kinetics/simulator.hpp"

namespace plumbline {
namespace {

using namespace scenes;

// FNV-1a, 64 bits, over the raw bytes of all states.
std::string fnv1a(const Trajectory& path) {
  std::uint64_t hash = 14695981039346656037u;
  const auto* bytes = reinterpret_cast<const unsigned char*>(path.states().data());
  for (std::size_t k = 0; k < path.states().size_bytes(); ++k) hash = (hash ^ bytes[k]) * 1099511628211u;
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << hash;
  return text.str();
}

std::map<std::string, Scenario> literal_scenarios() {
  std::map<std::string, Scenario> all;
  all["falling_box"] =
      free_flight(solid("box", Box{Vec3(1, 1, 1)}, 1, Vec3(0, 0, 5), Vec3(2, 1, 3)), Vec3(0, 0, -9.8), 2);
  all["drag"] = free_flight(ball("ship", 1, 1000, Vec3::Zero(), Vec3(30, 0, 0)), Vec3::Zero(), 5);
  all["drag"].forces.push_back({0,
                                [](double, const BodyState& b) {
                                  return Wrench{Vec3(5000 - 250 * b.v_WB.x(), 0, 0), Vec3::Zero()};
                                },
                                false, false, ""});
  all["bouncing_ball"] = on_ground(ball("ball", 0.25, 1, Vec3(0, 0, 2.3), Vec3(1, 0, 0)), 0.8, 0.2, 3);
  all["tumbling_box"] = on_ground(solid("box", Box{Vec3(1, 0.6, 0.4)}, 2, Vec3(0, 0, 2), Vec3(1, 0.5, 0)), 0.4, 0.3, 3);
  all["tumbling_box"].bodies[1].initial.w_WB = Vec3(1, 2, 0.5);
  Scenario& two = all["two_sphere"];
  two.bodies = {ball("a", 0.5, 1, Vec3(-2, 0.3, 0), Vec3(3, 0, 0)), ball("b", 0.5, 2, Vec3(1, 0, 0.1), Vec3(-1, 0, 0))};
  two.contact = ContactMaterial{0.5, 0.3};
  two.duration = 1;
  return all;
}

TEST(PLUMBLINE_HASH_SUITE, AgreesWithTheApprovedOne) {
  std::map<std::string, std::string> approved;
  std::ifstream file(PLUMBLINE_HASH_FILE);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t space = line.find(' ');
    approved[line.substr(space + 1)] = line.substr(0, space);
  }
  std::map<std::string, std::string> actual;
  for (const auto& [title, scenario] : literal_scenarios()) {
    for (const Scheme& scheme : candidate_schemes(scenario)) {
      actual[title + ", " + name(scheme, scenario)] = fnv1a(simulate(scenario, scheme, 1.0 / 60));
    }
  }
  for (const auto& [title, hash] : actual) {
    EXPECT_EQ(approved[title], hash) << "if the change is meant, the line for the file is\n" << hash << ' ' << title;
  }
  EXPECT_EQ(approved.size(), actual.size());
}

}  // namespace
}  // namespace plumbline
