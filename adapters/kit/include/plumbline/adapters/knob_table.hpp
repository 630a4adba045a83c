// Settings as a table: each knob of an adapter is written once, with everything that is to be known about it.
//
//   struct Knobs { double erp; int iterations; bool sleeping; Friction friction; };
//
//   const KnobTable<Knobs> kTable = KnobTable<Knobs>()
//       .add(&Knobs::erp, "erp", 0.2, 0.2, "1", "share of the penetration that a step corrects")
//       .add(&Knobs::iterations, "iterations", 10, 50, "", "sweeps of the solver over the contacts in a step")
//       .add(&Knobs::sleeping, "sleeping", true, false, "", "stops bodies that have been slow for a while")
//       .choose(&Knobs::friction, "friction", {{"cone", Friction::kCone}, {"pyramid", Friction::kPyramid}},
//               "pyramid", "cone", "the shape of the friction law");
//
// The first value is what a user of the engine gets, the second the one with which the engine solves the problem that
// a scenario states. `rows()` is what EngineInfo::settings wants, `read()` turns the Settings of a run into a Knobs.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/core/engine.hpp"

namespace plumbline {

// The value of that setting. Each throws std::invalid_argument, naming the setting and what it takes.
double knob_number(const Settings& settings, const std::string& name);      // not NaN; infinity is a number here
int knob_count(const Settings& settings, const std::string& name);          // a whole number from 0 to 1e9
std::size_t knob_choice(const Settings& settings, const std::string& name,  // the place of the word among `words`
                        const std::vector<std::string>& words);
void require_knob_at_least(const Settings& settings, const std::string& name, double low);  // and finite

template <typename Knobs>
class KnobTable {
 public:
  KnobTable& add(double Knobs::*member, std::string name, double usual, double matched, std::string unit,
                 std::string meaning) {
    return add_row({name, usual, matched, std::move(unit), std::move(meaning)},
                   [=](Knobs& knobs, const Settings& s) { knobs.*member = knob_number(s, name); });
  }
  KnobTable& add(int Knobs::*member, std::string name, int usual, int matched, std::string unit, std::string meaning) {
    return add_row({name, double(usual), double(matched), std::move(unit), std::move(meaning)},
                   [=](Knobs& knobs, const Settings& s) { knobs.*member = knob_count(s, name); });
  }
  KnobTable& add(bool Knobs::*member, std::string name, bool usual, bool matched, std::string unit,
                 std::string meaning) {
    return add_row({name, usual, matched, std::move(unit), std::move(meaning)},
                   [=](Knobs& knobs, const Settings& s) { knobs.*member = setting_bool(s, name); });
  }
  // One of several words, each of which stands for a value.
  template <typename Value>
  KnobTable& choose(Value Knobs::*member, std::string name, std::vector<std::pair<std::string, Value>> choices,
                    std::string usual, std::string matched, std::string meaning) {
    std::vector<std::string> words;
    for (const auto& [word, value] : choices) words.push_back(word);
    return add_row(
        {name, std::move(usual), std::move(matched), "", std::move(meaning)},
        [=](Knobs& knobs, const Settings& s) { knobs.*member = choices[knob_choice(s, name, words)].second; });
  }

  // Of the number that was added last: finite, and not below that. For engines that end the process over others.
  KnobTable& at_least(double low) {
    assign_.back() = [name = rows_.back().name, low, inner = assign_.back()](Knobs& knobs, const Settings& s) {
      require_knob_at_least(s, name, low);
      inner(knobs, s);
    };
    return *this;
  }

  const std::vector<Setting>& rows() const { return rows_; }

  // Throws std::invalid_argument for values that a knob does not take.
  Knobs read(const Settings& settings) const {
    Knobs knobs{};
    for (const auto& assign : assign_) assign(knobs, settings);
    return knobs;
  }

 private:
  using Assign = std::function<void(Knobs&, const Settings&)>;
  KnobTable& add_row(Setting row, Assign assign) {
    rows_.push_back(std::move(row));
    assign_.push_back(std::move(assign));
    return *this;
  }

  std::vector<Setting> rows_;
  std::vector<Assign> assign_;
};

}  // namespace plumbline
