// An engine that tells the truth but for one lie: what the conformance kit must be able to catch.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/kinetics/scheme.hpp"

namespace plumbline::testing_support {

// What a lie may look at: the stated problem, and what the world has gone through.
struct Witness {
  Scenario stated;
  double time = 0;      // [s]
  bool looked = false;  // read since the last step
  int buried = 0;       // worlds that had ended when this one was built
};

struct Lie {
  std::string name;
  std::vector<std::string> caught_by;  // checks that must not hold; others may also notice
  std::function<void(EngineInfo&)> describe = {};
  std::function<void(Settings&)> settings = {};
  std::function<void(Scenario&)> build = {};  // changes the problem before it is built
  std::function<void(Scheme&)> scheme = {};
  std::function<void(const Witness&, std::span<const BodyState>, std::span<Wrench>)> apply = {};
  std::function<double(const Witness&, double)> step = {};  // the dt that is taken instead
  std::function<void(const Witness&, std::span<BodyState>)> read = {};
  bool keeps_wrenches = false;  // until others come
  bool door_is_open = false;    // nothing looks at the problem before it is built
};

std::unique_ptr<Engine> lying_engine(const Lie& lie);
// Engine::build(), or past it when the lie says that nobody watches the door.
std::unique_ptr<World> build_lying(const Lie& lie, const Engine& engine, const Scenario&, const Settings&);

// "honest": no lie; "honest in the plane": the same as a planar engine.
Lie honest();
Lie honest_in_the_plane();
const std::vector<Lie>& lies();
void append_spring_lies(std::vector<Lie>& all);                     // about force elements: spring_lies.cpp
void append_lies_about_stops_and_cylinders(std::vector<Lie>& all);  // lies_about_stops.cpp

}  // namespace plumbline::testing_support
