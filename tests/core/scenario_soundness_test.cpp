// What no engine can be asked to run is refused by name, before any engine sees it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinetic_scenes.hpp"
#include "plumbline/core/engine.hpp"

namespace plumbline {
namespace {

using namespace scenes;

Scenario pair_on_a_rod() {
  Scenario s = free_flight(ball("one", 0.1, 1, Vec3(0, 0, 0), Vec3(0, 0, 1)), Vec3(0, 0, -kG), 1);
  s.bodies.push_back(ball("two", 0.1, 2, Vec3(1, 0, 0), Vec3(0, 0, -1)));
  s.joints = {rod_between(0, 1, {s.bodies[0].initial, s.bodies[1].initial}, Vec3(0.1, 0, 0), Vec3(0.9, 0, 0))};
  s.joints[0].name = "rod";
  return s;
}

std::string refusal(const Scenario& scenario) {
  try {
    require_sound(scenario);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Soundness, LetsSoundScenariosPass) { EXPECT_EQ(refusal(pair_on_a_rod()), ""); }

TEST(Soundness, NamesTheBodyThatIsAtFault) {
  const double nan = std::nan("");
  const auto fault_of = [](auto change) {
    Scenario s = pair_on_a_rod();
    change(s);
    return refusal(s);
  };
  EXPECT_NE(fault_of([&](Scenario& s) { s.gravity.y() = nan; }).find("gravity"), std::string::npos);
  for (const double mass : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(fault_of([&](Scenario& s) { s.bodies[1].mass = mass; }).find("'two'"), std::string::npos) << mass;
  }
  for (const double moment : {0.0, -1.0, nan}) {
    EXPECT_NE(fault_of([&](Scenario& s) { s.bodies[0].inertia.z() = moment; }).find("'one'"), std::string::npos);
  }
  EXPECT_NE(fault_of([&](Scenario& s) { s.bodies[1].initial.v_WB.x() = nan; }).find("'two'"), std::string::npos);
  EXPECT_NE(fault_of([&](Scenario& s) { s.bodies[1].initial.q_WB.w() = 2; }).find("quaternion"), std::string::npos);
  EXPECT_NE(fault_of([&](Scenario& s) { s.bodies[1].shape = HalfSpace{Vec3::UnitZ()}; }).find("half-space"),
            std::string::npos);
}

TEST(Soundness, NamesTheJointThatDoesNotHold) {
  Scenario apart = pair_on_a_rod();
  apart.joints[0].length += 1e-6;
  EXPECT_NE(refusal(apart).find("joint 'rod' does not hold in the initial positions"), std::string::npos);
  Scenario parting = pair_on_a_rod();
  parting.bodies[1].initial.v_WB.x() = 0.25;
  EXPECT_NE(refusal(parting).find("it would come apart with 0.25 a second"), std::string::npos) << refusal(parting);
  Scenario post = pair_on_a_rod();
  post.bodies[0].fixed = true;
  EXPECT_NE(refusal(post).find("leads to 'one', which is fixed"), std::string::npos) << refusal(post);
}

// The door itself: what stands before every adapter.
class Doorkeeper final : public Engine {
 public:
  Doorkeeper() {
    info_.name = "doorkeeper";
    info_.features = {Feature::kSpatial};
    info_.settings = {{"knob", 1.0, 2.0, "", "a number"}};
  }
  const EngineInfo& info() const override { return info_; }
  mutable int created = 0;

 protected:
  std::unique_ptr<World> create(const Scenario&, const Settings&) const override {
    ++created;
    return nullptr;
  }

 private:
  EngineInfo info_;
};

TEST(EngineDoor, LetsThroughOnlyWhatTheEngineCanBeAsked) {
  const Doorkeeper engine;
  const Settings settings = settings_of(engine.info(), Profile::kMatched);
  Scenario free = pair_on_a_rod();
  free.joints.clear();
  engine.build(free, settings);
  EXPECT_EQ(engine.created, 1);
  const auto refusal_of = [&](const Scenario& scenario, const Settings& with) -> std::string {
    try {
      engine.build(scenario, with);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal_of(pair_on_a_rod(), settings), "doorkeeper has no distance joints");
  Scenario massless = free;
  massless.bodies[0].mass = 0;
  EXPECT_NE(refusal_of(massless, settings), "");
  EXPECT_EQ(refusal_of(free, {}), "no setting 'knob'");
  EXPECT_EQ(refusal_of(free, {{"knob", true}}), "setting 'knob' must be a number");
  EXPECT_EQ(refusal_of(free, {{"knob", 1.0}, {"nob", 1.0}}), "doorkeeper has no setting 'nob'; it has: knob");
  EXPECT_EQ(engine.created, 1);
}

}  // namespace
}  // namespace plumbline
