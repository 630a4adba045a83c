// Lies about limits of joints and about cylinders, kept apart from the others for length.
#include <cmath>

#include "lying_engine.hpp"

namespace plumbline::testing_support {
namespace {

std::vector<BodyState> initial_states(const Scenario& scenario) {
  std::vector<BodyState> states;
  for (const Body& body : scenario.bodies) states.push_back(body.initial);
  return states;
}

bool has_range(const Scenario& scenario) { return !scenario.joints.empty() && scenario.joints[0].range.has_value(); }

void each_range(Scenario& scenario, const std::function<void(Joint&)>& change) {
  for (Joint& joint : scenario.joints) {
    if (joint.range) change(joint);
  }
}

void each_cylinder(Scenario& scenario, const std::function<void(Body&, Cylinder&)>& change) {
  for (Body& body : scenario.bodies) {
    if (auto* cylinder = std::get_if<Cylinder>(&body.shape)) change(body, *cylinder);
  }
}

void append_stops(std::vector<Lie>& all) {
  all.push_back({.name = "forgets the limits of joints",
                 .caught_by = {"stops_stand_where_stated", "stops_push_and_never_pull", "stops_act_on_both_bodies"},
                 .build = [](Scenario& s) { each_range(s, [](Joint& j) { j.range.reset(); }); }});
  all.push_back({.name = "counts ranges the other way round",
                 .caught_by = {"stops_stand_where_stated"},
                 .build = [](Scenario& s) {
                   each_range(s, [](Joint& j) { j.range = JointRange{-j.range->high, -j.range->low}; });
                 }});
  all.push_back({.name = "counts ranges from a zero of its own",
                 .caught_by = {"stops_stand_where_stated"},
                 .build = [](Scenario& s) {
                   each_range(s, [](Joint& j) { j.range = JointRange{j.range->low - 0.05, j.range->high - 0.05}; });
                 }});
  // As an angle about the largest component of the axis alone would be: right only along the axes of the world.
  all.push_back({.name = "measures the coordinate along an axis of the world",
                 .caught_by = {"stops_of_an_oblique_axis"},
                 .build = [](Scenario& s) {
                   const std::vector<BodyState> states = initial_states(s);
                   each_range(s, [&](Joint& j) {
                     const double share = (states[j.b].q_WB * j.on_b.axis()).cwiseAbs().maxCoeff();
                     if (j.kind == JointKind::kHinge) j.range = JointRange{j.range->low / share, j.range->high / share};
                   });
                 }});
  all.push_back({.name = "throws back what meets a stop",
                 .caught_by = {"stops_do_not_rebound"},
                 .read = [](const Witness& witness, std::span<BodyState> states) {
                   if (!has_range(witness.stated) || witness.time < 0.25 || states.size() != 1) return;
                   const BodyState& start = witness.stated.bodies[0].initial;
                   states[0].v_WB = -0.3 * start.v_WB;
                   states[0].w_WB = -0.3 * start.w_WB;
                 }});
  all.push_back({.name = "glues what leans on a stop to it",
                 .caught_by = {"stops_push_and_never_pull"},
                 .apply = [](const Witness& witness, std::span<const BodyState>, std::span<Wrench> w) {
                   if (has_range(witness.stated) && witness.time >= 0.25) w[0] = {};
                 }});
  all.push_back(
      {.name = "yields to a load on a stop", .caught_by = {"stops_push_and_never_pull"}, .build = [](Scenario& s) {
         each_range(s, [](Joint& j) {
           if (j.range->low == 0) j.range->low = -0.1;
         });
       }});
  all.push_back({.name = "stops the second body of a joint alone",
                 .caught_by = {"stops_act_on_both_bodies"},
                 .read = [](const Witness& witness, std::span<BodyState> states) {
                   if (!has_range(witness.stated) || witness.time < 0.25 || states.size() != 2) return;
                   states[0].v_WB += Vec3(0.1, 0, 0);
                 }});
}

void append_cylinders(std::vector<Lie>& all) {
  all.push_back({.name = "takes y for the axis of a cylinder",
                 .caught_by = {"cylinder_echoes_its_inertia"},
                 .build = [](Scenario& s) {
                   each_cylinder(s, [](Body& body, Cylinder&) { std::swap(body.inertia.y(), body.inertia.z()); });
                 }});
  all.push_back({.name = "lets cylinders slide", .caught_by = {"cylinder_rolls_on_its_side"}, .build = [](Scenario& s) {
                   each_cylinder(s, [&](Body&, Cylinder&) {
                     if (s.contact) s.contact->friction = 0;
                   });
                 }});
  all.push_back(
      {.name = "takes the radius of a cylinder for its diameter",
       .caught_by = {"cylinder_rests_on_its_side", "parallel_cylinders_part_as_stated", "cylinder_meets_other_shapes"},
       .build = [](Scenario& s) { each_cylinder(s, [](Body&, Cylinder& c) { c.radius /= 2; }); }});
  all.push_back({.name = "takes the height of a cylinder for twice of it",
                 .caught_by = {"cylinder_rests_on_its_end"},
                 .build = [](Scenario& s) { each_cylinder(s, [](Body&, Cylinder& c) { c.height /= 2; }); }});
  all.push_back({.name = "turns cylinders that meet",
                 .caught_by = {"parallel_cylinders_part_as_stated"},
                 .read = [](const Witness& witness, std::span<BodyState> states) {
                   if (states.size() != 2 || witness.time < 0.5) return;
                   for (const Body& body : witness.stated.bodies) {
                     if (!std::holds_alternative<Cylinder>(body.shape)) return;
                   }
                   states[0].w_WB += Vec3(0, 0, 0.5);
                 }});
}

}  // namespace

void append_lies_about_stops_and_cylinders(std::vector<Lie>& all) {
  append_stops(all);
  append_cylinders(all);
}

}  // namespace plumbline::testing_support
