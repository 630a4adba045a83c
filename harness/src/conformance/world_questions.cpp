// Worlds: each by itself, each the same every time, and not disturbed by being looked at.
#include "conformance_scenes.hpp"

namespace plumbline::conformance {
namespace {

constexpr int kSteps = 128;  // two seconds: everything in the busy scenes has fallen and touched

// Those of the busy scenes that the row carries through, as they stand and moved by `shift`: a solver that gives up in
// a stack, and says so, is asked in a simpler one.
std::vector<std::pair<Scenario, Scenario>> steady_scenes(Interview& row, double shift = 0) {
  const auto ones = busy_scenes(row), twos = busy_scenes(row, shift);
  std::vector<std::pair<Scenario, Scenario>> steady;
  std::string said;
  for (std::size_t i = 0; i < ones.size(); ++i) {
    try {
      run(*row.build(ones[i]), ones[i], kStep, kSteps);
      if (shift != 0) run(*row.build(twos[i]), twos[i], kStep, kSteps);
      steady.emplace_back(ones[i], twos[i]);
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
  }
  row.expect(!steady.empty(), "the engine gives up in every scene: " + said);
  return steady;
}

void same_run_same_bits(Interview& row) {
  for (const auto& [scenario, moved] : steady_scenes(row)) {
    const auto first = run(*row.build(scenario), scenario, kStep, kSteps);
    row.expect(same_bits(first, run(*row.build(scenario), scenario, kStep, kSteps)), "the second run gives other bits");
  }
}

void two_worlds_do_not_mix(Interview& row) {
  for (const auto& [one, two] : steady_scenes(row, 0.07)) {
    const auto one_alone = run(*row.build(one), one, kStep, kSteps);
    const auto two_alone = run(*row.build(two), two, kStep, kSteps);
    row.expect(!same_bits(one_alone, two_alone), "two scenes that differ end with the same bits");
    const auto one_world = row.build(one), two_world = row.build(two);
    for (int k = 0; k < kSteps; ++k) {
      one_world->step(kStep);
      two_world->step(kStep);
    }
    row.expect(same_bits(states_of(*one_world, one), one_alone), "the older world moves otherwise beside another");
    row.expect(same_bits(states_of(*two_world, two), two_alone), "the newer world moves otherwise beside another");
  }
}

void worlds_outlive_each_other(Interview& row) {
  for (const auto& [scenario, moved] : steady_scenes(row)) {
    const auto alone = run(*row.build(scenario), scenario, kStep, kSteps);
    auto older = row.build(scenario);
    older->step(kStep);
    const auto newer = row.build(scenario);
    newer->step(kStep);
    older.reset();
    row.expect(same_bits(run(*newer, scenario, kStep, kSteps - 1), alone),
               "a world moves otherwise once an older one is gone");
  }
}

void reading_disturbs_nothing(Interview& row) {
  for (const auto& [scenario, moved] : steady_scenes(row)) {
    const auto unread = run(*row.build(scenario), scenario, kStep, kSteps);
    const auto world = row.build(scenario);
    std::vector<BodyState> first, again;
    bool steady = true;
    for (int k = 0; k < kSteps; ++k) {
      first = states_of(*world, scenario);
      again = states_of(*world, scenario);
      steady = steady && same_bits(first, again);
      world->step(kStep);
    }
    row.expect(steady, "reading twice gives two states");
    row.expect(same_bits(states_of(*world, scenario), unread), "a world that is read moves otherwise");
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
