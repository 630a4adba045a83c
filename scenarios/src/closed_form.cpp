#include "closed_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "expression.hpp"
#include "spelling.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

// A double carries 16 digits; a closed form of a few operations keeps all but the last two.
constexpr double kDefaultUncertainty = 1e-14;

// Typing errors are far larger, and the rounding of any sensible expression far smaller.
constexpr double kStartTolerance = 1e-9;

class ClosedFormReader;

class ClosedForm : public Reference {
 public:
  BodyState at(std::size_t body, double t) const override {
    const Motion& motion = motions_[body];
    if (motion.components.empty()) return state_of(motion.initial);
    slots_[0] = t;
    for (std::size_t i = 0; i < let_.size(); ++i) slots_[i + 1] = let_[i]();
    auto values = motion.initial;
    for (const auto& [index, expression] : motion.components) values[index] = expression();
    return state_of(values);
  }
  double uncertainty() const override { return uncertainty_; }
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "closed_form"; }
  std::string_view bound_source() const override {
    return uncertainty_stated_ ? "stated in the file" : "rounding of a few operations in double precision";
  }

 private:
  friend class ClosedFormReader;
  struct Motion {
    std::array<double, kComponentCount> initial;
    std::vector<std::pair<std::size_t, Expression>> components;
  };
  double uncertainty_ = kDefaultUncertainty;
  bool uncertainty_stated_ = false;
  std::string citation_;
  std::vector<Motion> motions_;
  std::vector<Expression> let_;
  mutable std::vector<double> slots_;  // t, then the names under [reference.let]; its size never changes once in use
};

class ClosedFormReader {
 public:
  ClosedFormReader(const Node& table, const Parameters& constants, const Scenario& scenario)
      : table_(table), constants_(constants), scenario_(scenario), result_(std::make_shared<ClosedForm>()) {}

  std::shared_ptr<const Reference> read() {
    if (const Node* u = find(table_, "uncertainty")) {
      result_->uncertainty_ = positive_number(*u, constants_);
      result_->uncertainty_stated_ = true;
    }
    // The scenario's own source serves unless the solution has another one.
    const Node* citation = find(table_, "citation");
    result_->citation_ = citation != nullptr ? as_text(*citation) : scenario_.source;
    read_let();
    for (const Body& body : scenario_.bodies) result_->motions_.push_back({components_of(body.initial), {}});
    for (const Entry& entry : table_.entries) {
      if (!is_own_key(entry.key)) read_motion(entry);
    }
    check_start_and_end();
    return result_;
  }

 private:
  static bool is_own_key(const std::string& key) {
    return key == "kind" || key == "uncertainty" || key == "citation" || key == "let";
  }

  void read_let() {
    const Node* let = find(table_, "let");
    const std::size_t count = let == nullptr ? 0 : as_table(*let).entries.size();
    result_->slots_.assign(count + 1, 0.0);
    names_.emplace_back("t");
    for (std::size_t i = 0; i < count; ++i) {
      const Entry& entry = let->entries[i];
      const bool taken =
          is_reserved(entry.key) || std::find(names_.begin(), names_.end(), entry.key) != names_.end() ||
          std::any_of(constants_.begin(), constants_.end(), [&](const auto& c) { return c.first == entry.key; });
      if (taken) fail(entry.key_place, entry.value.path, "this name is used already; choose another");
      result_->let_.emplace_back(entry.value, constants_, variables());
      names_.push_back(entry.key);
    }
  }

  void read_motion(const Entry& entry) {
    std::vector<std::string> names;
    for (const Body& body : scenario_.bodies) names.push_back(body.name);
    const auto found = std::find(names.begin(), names.end(), entry.key);
    if (found == names.end()) {
      fail(entry.key_place, entry.value.path,
           fmt::format("there is no body '{}'; {}the bodies are: {}; other keys here: kind, citation, uncertainty, let",
                       entry.key, did_you_mean(entry.key, names), fmt::join(names, ", ")));
    }
    const auto body = static_cast<std::size_t>(found - names.begin());
    if (scenario_.bodies[body].fixed) {
      fail(entry.key_place, entry.value.path, fmt::format("'{}' is fixed and keeps its place; remove this", entry.key));
    }
    allow_only(entry.value, {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"});
    for (const Entry& component : entry.value.entries) {
      std::size_t index = 0;
      while (component_name(index) != component.key) ++index;
      result_->motions_[body].components.emplace_back(index, Expression(component.value, constants_, variables()));
    }
  }

  // A slip of the pen in the solution or in the initial state shows here, before any engine is blamed for it.
  void check_start_and_end() const {
    const double length = scenario_.scales.length, velocity = scenario_.scales.velocity();
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
      const auto start = components_of(result_->at(b, 0)), end = components_of(result_->at(b, scenario_.duration));
      const auto initial = components_of(scenario_.bodies[b].initial);
      for (std::size_t i = 0; i < kComponentCount; ++i) {
        const Node& place = component_node(b, i);
        const double scale = i < 3 ? length : i < 7 ? 1 : i < 10 ? velocity : 1 / scenario_.scales.time;
        const double tolerance = kStartTolerance * std::max(scale, std::abs(initial[i]));
        if (!(std::abs(start[i] - initial[i]) <= tolerance)) {
          fail(place, fmt::format("{}.{} is {} at t = 0, but the body starts with {}; correct one of them",
                                  scenario_.bodies[b].name, component_name(i), start[i], initial[i]));
        }
        if (!std::isfinite(end[i])) {
          fail(place, fmt::format("{}.{} is {} at the end, t = {}; the solution must hold for the whole duration",
                                  scenario_.bodies[b].name, component_name(i), end[i], shortest(scenario_.duration)));
        }
      }
    }
  }

  // Where that component is written, or else the body's part of the reference, or else the whole of it.
  const Node& component_node(std::size_t body, std::size_t index) const {
    const Node* motion = find(table_, scenario_.bodies[body].name);
    if (motion == nullptr) return table_;
    const Node* component = find(*motion, component_name(index));
    return component == nullptr ? *motion : *component;
  }

  Variables variables() const { return {names_, result_->slots_.data()}; }

  const Node& table_;
  const Parameters& constants_;
  const Scenario& scenario_;
  std::shared_ptr<ClosedForm> result_;
  std::vector<std::string_view> names_;  // t and the names of [reference.let] so far
};

}  // namespace

std::shared_ptr<const Reference> read_closed_form(const Node& table, const Parameters& constants,
                                                  const Scenario& scenario) {
  return ClosedFormReader(table, constants, scenario).read();
}

}  // namespace plumbline
