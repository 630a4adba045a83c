// Worlds: each by itself, each the same every time, and not disturbed by being looked at.
#include <optional>

#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

constexpr int kSteps = 64;  // one second: everything in the busy scenes has fallen and touched

struct SteadyScene {
  Scenario scenario;
  std::vector<BodyState> alone;  // how it ends in a world of its own
};

// Those of the busy scenes that the row carries through: a solver that gives up in a stack, and says so, is asked in a
// simpler one.
std::vector<std::optional<SteadyScene>> steady_scenes(Interview& row, double shift = 0) {
  std::vector<std::optional<SteadyScene>> scenes;
  std::string said;
  bool any = false;
  for (const Scenario& scenario : busy_scenes(row, shift)) {
    scenes.emplace_back();
    try {
      scenes.back() = SteadyScene{scenario, run(*row.build(scenario), scenario, kStep, kSteps)};
      any = true;
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
  }
  row.expect(any, "the engine gives up in every scene: " + said);
  return scenes;
}

void same_run_same_bits(Interview& row) {
  for (const auto& scene : steady_scenes(row)) {
    if (!scene) continue;
    row.expect(same_bits(run(*row.build(scene->scenario), scene->scenario, kStep, kSteps), scene->alone),
               "the second run gives other bits");
  }
}

void two_worlds_do_not_mix(Interview& row) {
  const auto ones = steady_scenes(row), twos = steady_scenes(row, 0.07);
  for (std::size_t i = 0; i < ones.size(); ++i) {
    if (!ones[i] || !twos[i]) continue;
    row.expect(!same_bits(ones[i]->alone, twos[i]->alone), "two scenes that differ end with the same bits");
    const auto one = row.build(ones[i]->scenario), two = row.build(twos[i]->scenario);
    for (int k = 0; k < kSteps; ++k) {
      one->step(kStep);
      two->step(kStep);
    }
    row.expect(same_bits(states_of(*one, ones[i]->scenario), ones[i]->alone),
               "the older world moves otherwise beside another");
    row.expect(same_bits(states_of(*two, twos[i]->scenario), twos[i]->alone),
               "the newer world moves otherwise beside another");
  }
}

void worlds_outlive_each_other(Interview& row) {
  for (const auto& scene : steady_scenes(row)) {
    if (!scene) continue;
    auto older = row.build(scene->scenario);
    older->step(kStep);
    const auto newer = row.build(scene->scenario);
    newer->step(kStep);
    older.reset();
    row.expect(same_bits(run(*newer, scene->scenario, kStep, kSteps - 1), scene->alone),
               "a world moves otherwise once an older one is gone");
  }
}

void reading_disturbs_nothing(Interview& row) {
  for (const auto& scene : steady_scenes(row)) {
    if (!scene) continue;
    const auto world = row.build(scene->scenario);
    bool steady = true;
    for (int k = 0; k < kSteps; ++k) {
      const auto first = states_of(*world, scene->scenario);
      steady = steady && same_bits(first, states_of(*world, scene->scenario));
      world->step(kStep);
    }
    row.expect(steady, "reading twice gives two states");
    row.expect(same_bits(states_of(*world, scene->scenario), scene->alone), "a world that is read moves otherwise");
  }
}

const Question kQuestions[] = {
    {{"same_run_same_bits", "worlds", "Does the same run give the same bits a second time?", "", false},
     same_run_same_bits},
    {{"two_worlds_do_not_mix", "worlds", "Do two worlds that step by turns give the bits that each gives alone?", "",
      false},
     two_worlds_do_not_mix},
    {{"worlds_outlive_each_other", "worlds", "Does a world give the same bits when an older one ends before it?", "",
      false},
     worlds_outlive_each_other},
    {{"reading_disturbs_nothing", "worlds", "Does reading the states change none of them, nor what follows?", "",
      false},
     reading_disturbs_nothing},
};

}  // namespace

std::span<const Question> world_questions() { return kQuestions; }

}  // namespace plumbline::conformance
