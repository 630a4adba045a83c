// What a reader of a foreign world file found, in plain values, and how it becomes a scenario.
//
// Foreign links have their frame anywhere, shapes off the centre of mass and several to a link, and products of
// inertia. A body of a scenario has its frame at the centre of mass along the principal axes, and one shape in the
// middle of it. The turn from one to the other happens here, once for all formats, and whatever has no place in a
// scenario is listed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plumbline/core/scenario.hpp"

namespace plumbline {

// A frame F in the world.
struct PlacedFrame {
  Vec3 p_WF = Vec3::Zero();  // [m]
  Quat q_WF = Quat::Identity();
};

struct DraftShape {
  std::string name;
  std::optional<Shape> shape;  // none: one that a scenario does not have; `kind` is its word
  std::string kind;
  PlacedFrame at;        // its centre and axes; of a half-space a point of the plane
  bool collides = true;  // false: it is only drawn
};

struct DraftLink {
  std::string name;
  bool fixed = false;
  double mass = 0;                    // [kg]
  Mat3 inertia_com_W = Mat3::Zero();  // about the centre of mass, along the axes of W [kg m^2]
  PlacedFrame com;                    // the centre of mass, with the axes that the file prefers
  Vec3 v_W = Vec3::Zero();            // of the centre of mass [m/s]
  Vec3 w_W = Vec3::Zero();            // [rad/s]
  std::vector<DraftShape> shapes;
};

struct DraftJoint {
  std::string name;
  JointKind kind = JointKind::kBall;
  std::size_t a = kWorld, b = 0;  // links; either may be fixed, or the world
  Vec3 anchor_W = Vec3::Zero();   // of a distance joint A's end
  Vec3 end_b_W = Vec3::Zero();    // of a distance joint B's end
  Vec3 axis_W = Vec3::UnitZ();
  // Of the coordinate, counted from the starting position.
  std::optional<JointRange> range;
  double stiffness = 0, damping = 0, rest = 0;
};

struct DraftSpring {
  std::string name;
  std::size_t a = kWorld, b = 0;  // links
  Vec3 end_a_W = Vec3::Zero(), end_b_W = Vec3::Zero();
  double stiffness = 0, damping = 0, length = 0;
};

// Two links whose shapes collide, with the law that the file gives to that pair.
struct DraftContact {
  std::size_t a = 0, b = 0;
  ContactMaterial material;
};

struct WorldDraft {
  std::string format;  // "MJCF"
  std::string title;   // of the model, as the file calls it
  Vec3 gravity = Vec3::Zero();
  std::optional<double> step, duration;  // [s]
  std::optional<Scales> scales;
  std::vector<DraftLink> links;
  std::vector<DraftJoint> joints;
  std::vector<DraftSpring> springs;
  std::vector<DraftContact> contacts;
  std::vector<std::string> losses;  // what the file says of the motion and a scenario cannot
  std::vector<std::string> notes;   // what does not change the motion: lights, names, turned frames
};

struct ImportedWorld {
  Scenario scenario;  // id, about and source too; gates and reference are the text's business
  std::vector<std::string> losses, notes;
};

// Does not throw for what cannot be taken: that is in `losses`, and left out.
ImportedWorld assemble(const WorldDraft& draft);

}  // namespace plumbline
