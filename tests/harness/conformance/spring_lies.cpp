#include "lying_engine.hpp"

#include <algorithm>

namespace plumbline::testing_support {

void append_spring_lies(std::vector<Lie>& all) {
  const auto add = [&](Lie lie) { all.push_back(std::move(lie)); };
  add({.name = "makes springs a quarter stiffer", .caught_by = {"spring_acts_as_stated"}, .build = [](Scenario& s) {
         for (Spring& spring : s.springs) spring.stiffness *= 1.25;
       }});
  add({.name = "lets springs only pull", .caught_by = {"spring_acts_as_stated"}, .build = [](Scenario& s) {
         for (Spring& spring : s.springs) spring.length = std::min(spring.length, 1.0);
       }});
  add({.name = "ties springs to centres of mass", .caught_by = {"spring_acts_as_stated"}, .build = [](Scenario& s) {
         for (Spring& spring : s.springs) spring.on_b.setZero();
       }});
  add({.name = "lets a spring pull one end only", .caught_by = {"spring_keeps_momentum"}, .build = [](Scenario& s) {
         for (Spring& spring : s.springs) {
           if (spring.a == kWorld) continue;
           spring.on_a = s.bodies[spring.a].initial.p_WB + s.bodies[spring.a].initial.q_WB * spring.on_a;
           spring.a = kWorld;
         }
       }});
  add({.name = "turns springs of joints the wrong way",
       .caught_by = {"joint_spring_acts_as_stated"},
       .build = [](Scenario& s) {
         for (JointSpring& spring : s.joint_springs) spring.rest = -spring.rest;
       }});
  add({.name = "forgets springs of sliders", .caught_by = {"joint_spring_acts_as_stated"}, .build = [](Scenario& s) {
         std::erase_if(s.joint_springs,
                       [&](const JointSpring& spring) { return s.joints[spring.joint].kind == JointKind::kSlider; });
       }});
}

}  // namespace plumbline::testing_support
