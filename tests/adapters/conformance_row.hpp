// The table that the conformance suite runs over: every row of the linked adapter under both profiles, and the
// literals that its scenarios are made of.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"

namespace plumbline {

// A power of two, so that it is the same number in single and in double precision [s].
inline constexpr double kStep = 1.0 / 64;

struct ConformanceRow {
  std::size_t engine;
  Profile profile;
};

inline const std::vector<std::unique_ptr<Engine>>& linked_engines() {
  static const std::vector<std::unique_ptr<Engine>> engines = make_engines();
  return engines;
}

// "some_engine_matched": GoogleTest allows no other characters.
inline std::string row_name(const ConformanceRow& row) {
  std::string name = linked_engines()[row.engine]->info().name + "_" + std::string(profile_name(row.profile));
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}
inline void PrintTo(const ConformanceRow& row, std::ostream* out) { *out << row_name(row); }

inline std::vector<ConformanceRow> conformance_rows(const std::vector<Profile>& profiles) {
  std::vector<ConformanceRow> rows;
  for (std::size_t i = 0; i < linked_engines().size(); ++i) {
    for (Profile profile : profiles) rows.push_back({i, profile});
  }
  return rows;
}

class ConformanceCase : public testing::TestWithParam<ConformanceRow> {
 protected:
  const Engine& engine() const { return *linked_engines()[GetParam().engine]; }
  const EngineInfo& info() const { return engine().info(); }
  Settings settings() const { return settings_of(info(), GetParam().profile); }
  bool has(Feature feature) const { return info().features.contains(feature); }
  bool planar() const { return !has(Feature::kSpatial); }
  double roundoff() const { return info().unit_roundoff(); }

  // What the row lacks to run the scenario; empty when nothing.
  std::string missing(const Scenario& scenario) const { return needs(scenario).without(info().features).describe(); }
  std::unique_ptr<World> build(const Scenario& scenario) const { return engine().build(scenario, settings()); }
};

inline std::vector<BodyState> states_of(const World& world, const Scenario& scenario) {
  std::vector<BodyState> states(scenario.bodies.size());
  world.read(states);
  return states;
}

inline std::vector<BodyState> run(World& world, const Scenario& scenario, double dt, int steps) {
  for (int k = 0; k < steps; ++k) world.step(dt);
  return states_of(world, scenario);
}

inline Body ball(std::string name, double radius, double mass, const Vec3& p_WB, const Vec3& v_WB = Vec3::Zero()) {
  Body body;
  body.name = std::move(name);
  body.shape = Sphere{radius};
  body.mass = mass;
  body.inertia = solid_inertia(body.shape, mass);
  body.initial.p_WB = p_WB;
  body.initial.v_WB = v_WB;
  return body;
}

inline Body box(std::string name, const Vec3& size, double mass, const Vec3& p_WB, const Vec3& v_WB = Vec3::Zero()) {
  Body body = ball(std::move(name), 1, mass, p_WB, v_WB);
  body.shape = Box{size};
  body.inertia = solid_inertia(body.shape, mass);
  return body;
}

inline Body half_space(const Vec3& normal, const Vec3& p_WB = Vec3::Zero()) {
  Body body;
  body.name = "ground";
  body.shape = HalfSpace{normal};
  body.fixed = true;
  body.initial.p_WB = p_WB;
  return body;
}

inline Quat quarter_turn_about_y() { return rotation_by(Vec3(0, std::acos(0.0), 0)); }

}  // namespace plumbline
