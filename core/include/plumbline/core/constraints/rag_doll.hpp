// The rag doll of course slide 35: joints are particles, bones are links, joint angles are three-point angle limits.
//
//                 head
//                  |
//   elbow-shoulder-neck-shoulder-elbow      the trunk is a rigid frame: neck, shoulders and hips, all ten distances of
//    |         \   / \   /         |        which are links; the neck stands out of the plane of the other four, since
//   hand        hip---hip         hand      distances alone do not stiffen a plane figure against folding
//                |     |
//              knee   knee
//                |     |
//              foot   foot
//
// Lengths, shares of the mass and centres of mass of the segments: de Leva, Adjustments to Zatsiorsky-Seluyanov's
// segment inertia parameters, J. Biomechanics 29 (1996) 1223, men (1.741 m). Each bone's mass is split between its two
// joints so that its centre of mass stays where it is; hands and feet sit at the last joint of their limb. Widths of
// shoulders and hips and the ranges of the angles are plain choices.
#pragma once

#include "plumbline/core/constraints/assembly.hpp"

namespace plumbline {

// The doll's particles, in this order.
enum DollJoint : std::size_t {
  kHead,
  kNeck,
  kLeftShoulder,
  kLeftElbow,
  kLeftHand,
  kLeftHip,
  kLeftKnee,
  kLeftFoot,
  kRightShoulder,
  kRightElbow,
  kRightHand,
  kRightHip,
  kRightKnee,
  kRightFoot,
  kDollJoints
};

// The constraints of the list: first the links (kDollLinks of them: bones and frame), then the angle limits.
inline constexpr std::size_t kDollLinks = 19;
inline constexpr std::size_t kDollAngles = 12;

// Standing upright and facing +x, arms spread, knees and elbows a little bent, all constraints met, at rest; feet at
// height 0 below the origin of x and y. Turn or move the positions as you like: no constraint minds. Throws
// std::invalid_argument for a mass [kg] <= 0.
Assembly make_rag_doll(double mass = 73);

}  // namespace plumbline
