// A rag doll of rigid bodies (course slide 35; its counterpart made of particles is in constraints/rag_doll.hpp).
//
//                      head
//        forearm-upper arm-trunk-upper arm-forearm     ball joints: neck, shoulders, hips
//                    thigh       thigh                 hinges: elbows, knees
//                    shank       shank
//
// Every segment is a homogeneous box. Shares of the mass: de Leva, Adjustments to Zatsiorsky-Seluyanov's segment
// inertia parameters, J. Biomechanics 29 (1996) 1223, men, with hands in the forearms and feet in the shanks. Sizes and
// ranges are plain choices: neck 0.8 rad, shoulders 2.5, hips 1.2, elbows and knees from 0.05 rad overstretched to 2.4
// bent.
#pragma once

#include <vector>

#include "plumbline/core/joints/joint.hpp"

namespace plumbline {

enum DollSegment : std::size_t {
  kTrunk,
  kHeadSegment,
  kLeftUpperArm,
  kLeftForearm,
  kLeftThigh,
  kLeftShank,
  kRightUpperArm,
  kRightForearm,
  kRightThigh,
  kRightShank,
  kDollSegments
};

struct RigidDoll {
  ArticulatedBody body;           // joint k - 1 carries segment k
  std::vector<BodyState> states;  // upright, facing +x, arms down, at rest, the trunk's centre in the origin
};

// Throws std::invalid_argument for a mass [kg] that is not > 0.
RigidDoll make_rigid_doll(double mass = 73);

}  // namespace plumbline
