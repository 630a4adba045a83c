// One check at work: the engine that is asked, what it was built with, and what it got wrong.
#pragma once

#include <span>
#include <stdexcept>

#include "plumbline/harness/conformance.hpp"

namespace plumbline::conformance {

// Thrown where a check needs what the row has not: it is not asked.
struct NotAsked : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Interview {
 public:
  Interview(const Engine& engine, Profile profile, WorldBuilder build);

  const Engine& engine() const { return engine_; }
  const EngineInfo& info() const { return engine_.info(); }
  Profile profile() const { return profile_; }
  bool has(Feature feature) const { return info().features.contains(feature); }
  bool planar() const { return !has(Feature::kSpatial); }
  double roundoff() const { return info().unit_roundoff(); }
  void require(Feature feature) const;  // throws NotAsked
  bool can_run(const Scenario& scenario) const;

  // Under the profile's settings, or others. Throws NotAsked for a scenario that needs what the row has not.
  std::unique_ptr<World> build(const Scenario& scenario) const;
  std::unique_ptr<World> build(const Scenario& scenario, const Settings& settings) const;

  // Each notes a complaint unless what it says holds; NaN never does.
  void expect(bool holds, const std::string& complaint);
  void within(const std::string& what, double seen, double wanted, double tolerance);
  void within(const std::string& what, const Vec3& seen, const Vec3& wanted, double tolerance);
  // What is to be refused: notes a complaint when `act` throws nothing, or a message without `word`.
  void refused(const std::string& what, const std::function<void()>& act, const std::string& word = "");

  ConformanceAnswer answer() const;

 private:
  const Engine& engine_;
  Profile profile_;
  WorldBuilder build_;
  std::vector<std::string> complaints_;
};

struct Question {
  ConformanceCheck about;
  void (*ask)(Interview&);
};

// One function and one file a theme.
std::span<const Question> description_questions();
std::span<const Question> mass_questions();
std::span<const Question> frame_questions();
std::span<const Question> force_questions();
std::span<const Question> contact_questions();
std::span<const Question> joint_questions();
std::span<const Question> spring_questions();
std::span<const Question> stop_questions();
std::span<const Question> cylinder_questions();
std::span<const Question> world_questions();
std::span<const Question> hostile_questions();

}  // namespace plumbline::conformance
